// Values, voices, errors, analyses and meshes of a run to JSON and back.
#include "core/file/state_json.h"

#include <charconv>
#include <set>

#include <nlohmann/json.hpp>

#include "core/base/text.h"
#include "core/define/codec.h"
#include "core/file/mesh_json.h"

namespace bl {

namespace {

Json error_to_json(const Error& error) {
  Json json = {{"code", name_of(error.code)}};
  if (!error.place.empty()) json["place"] = error.place;
  json["message"] = error.message;
  return json;
}

// Nothing where a newer program has another one.
std::optional<ErrorCode> error_code_of(std::string_view name) {
  for (int code = 0; code <= static_cast<int>(ErrorCode::internal); ++code)
    if (name_of(static_cast<ErrorCode>(code)) == name) return static_cast<ErrorCode>(code);
  return std::nullopt;
}

// "node/typification" in its two halves; ids hold no slash.
std::optional<std::pair<std::string, std::string>> type_name_of(const std::string& name) {
  const std::size_t slash = name.find('/');
  if (slash == std::string::npos) return std::nullopt;
  return std::pair{name.substr(0, slash), name.substr(slash + 1)};
}

class StateReader {
 public:
  StateReader(const Scene& scene, const Registry& types, std::vector<Problem>& problems)
      : scene_(scene), types_(types), problems_(problems) {}

  bool read(const Json& json) {
    if (!json.is_object()) return fail({ErrorCode::wrong_kind, "state", "expects an object"});
    if (!note(check_keys(
            json, {"check", "tick", "calm", "nodes", "voices", "held", "errors", "link_errors", "analyses", "meshes"}, "state")))
      return false;
    if (!read_tick(json, "tick", "state", state.tick) || !read_tick(json, "calm", "state", state.calm)) return false;
    const auto read_nodes = [&](const Json& nodes) {
      return read_values(nodes, "state/nodes", [&](const std::string& node, const std::string& path, Value&& value) {
        state.nodes[node][path] = std::move(value);
      });
    };
    return read_part(json, "nodes", read_nodes) &&
           read_part(json, "voices", [&](const Json& part) { return read_voices(part, "state/voices", false); }) &&
           read_part(json, "held", [&](const Json& part) { return read_voices(part, "state/held", true); }) &&
           read_part(json, "errors", [&](const Json& part) { return read_errors(part); }) &&
           read_part(json, "link_errors", [&](const Json& part) { return read_link_errors(part); }) &&
           read_part(json, "analyses", [&](const Json& part) { return read_analyses(part); }) &&
           read_part(json, "meshes", [&](const Json& part) { return read_meshes(part); });
  }

  SavedState state;

 private:
  bool fail(Error error) {
    problems_.push_back({true, std::move(error)});
    return false;
  }
  template <class T>
  bool note(const Result<T>& result) {
    return result ? true : fail(result.error());
  }

  // An object of the state; where there is none there is nothing to read.
  template <class Read>
  bool read_part(const Json& json, const char* key, const Read& read_it) {
    const auto part = json.find(key);
    if (part == json.end()) return true;
    if (!part->is_object()) return fail({ErrorCode::wrong_kind, std::string("state/") + key, "expects an object"});
    return read_it(*part);
  }

  Result<Value> value_of(const std::string& node, const std::string& path, const Json& json, const std::string& place) const {
    const auto parsed = parse_port_path(path);
    const auto record = scene_.nodes.find(node);
    if (record == scene_.nodes.end()) return Error{ErrorCode::not_found, place, "there is no node `" + node + "`"};
    if (!parsed) return Error{ErrorCode::wrong_kind, place, "expects \"typification.port\""};
    const auto port = types_.port(*parsed);
    if (!port) return port.error().within(place);
    if (!record->second.types.contains(parsed->typification))
      return Error{ErrorCode::not_found, place, "the node is not a `" + parsed->typification + "`"};
    return running_value_from_json(**port, json, place);
  }

  // A known typification had this port once. Running figures follow from the rest, so that a scene is not lost for one of them.
  bool is_of_older_program(const std::string& path) const {
    const auto parsed = parse_port_path(path);
    const TypificationDefinition* type = parsed ? types_.typification(parsed->typification) : nullptr;
    return type != nullptr && type->find_port(parsed->port) == nullptr;
  }

  // A typification that this program keeps as a ghost: nothing here could go on with what a run has made of it. Told once for
  // each of them.
  bool is_of_a_ghost(const std::string& node, const std::string& typification, const std::string& place) {
    const auto record = scene_.nodes.find(node);
    if (record == scene_.nodes.end() || !record->second.ghosts.contains(typification)) return false;
    if (told_ghosts_.insert(typification).second)
      problems_.push_back(
          {false,
           {ErrorCode::unknown_type, place,
            "`" + typification +
                "` is unknown to this program, so its results are left out: keep the file for the program that knows it"}});
    return true;
  }
  bool is_port_of_a_ghost(const std::string& node, const std::string& path, const std::string& place) {
    const auto parsed = parse_port_path(path);
    return parsed && is_of_a_ghost(node, parsed->typification, place);
  }

  bool read_tick(const Json& json, const char* key, const std::string& place, std::int64_t& tick) {
    const auto it = json.find(key);
    if (it == json.end()) return true;
    const bool is_good = it->is_number_integer() && *it >= 0 && *it <= (std::int64_t{1} << 53);
    if (!is_good) return fail({ErrorCode::wrong_kind, place + "/" + key, "expects a whole number from 0"});
    tick = it->get<std::int64_t>();
    return true;
  }

  // {"node": {"typification.port": value, ...}, ...}
  template <class Take>
  bool read_values(const Json& nodes, const std::string& place, const Take& take) {
    for (const auto& [node, values] : nodes.items()) {
      if (!values.is_object()) return fail({ErrorCode::wrong_kind, place + "/" + node, "expects an object"});
      for (const auto& [path, content] : values.items()) {
        const std::string here = place + "/" + node + "/" + path;
        if (is_port_of_a_ghost(node, path, here)) continue;
        if (is_of_older_program(path)) {
          problems_.push_back({false, {ErrorCode::not_found, here, "this program keeps no such value; it is computed again"}});
          continue;
        }
        auto value = value_of(node, path, content, here);
        if (!note(value)) return false;
        take(node, path, std::move(*value));
      }
    }
    return true;
  }

  // {"link": {"node/typification.port": value, ...}, ...}; older files kept those of failing links alone.
  bool read_voices(const Json& links, const std::string& part, bool are_failing) {
    for (const auto& [link, voices] : links.items()) {
      const std::string place = part + "/" + link;
      if (!scene_.links.contains(link) || !voices.is_object())
        return fail({ErrorCode::not_found, place, "expects the wanted values of a link of this scene"});
      for (const auto& [target, content] : voices.items()) {
        const std::size_t slash = target.find('/');
        const std::string node = target.substr(0, slash), path = slash == std::string::npos ? "" : target.substr(slash + 1);
        if (is_port_of_a_ghost(node, path, place + "/" + target)) continue;
        auto value = value_of(node, path, content, place + "/" + target);
        if (!note(value)) return false;
        state.voices[link].push_back({node, path, std::move(*value)});
      }
      if (are_failing) state.link_errors[link] = {ErrorCode::internal, "links/" + link, "held since before the scene was saved"};
    }
    return true;
  }

  // {"code": ..., "place": ..., "message": ...}
  bool read_error(const Json& json, const std::string& place, Error& error) {
    const auto text_of = [&](const char* key) {
      const auto it = json.find(key);
      return it != json.end() && it->is_string() ? it->get<std::string>() : std::string();
    };
    if (!json.is_object() || !json.contains("message") || !json["message"].is_string())
      return fail({ErrorCode::wrong_kind, place, "expects {\"code\": ..., \"place\": ..., \"message\": ...}"});
    if (!note(check_keys(json, {"code", "place", "message"}, place))) return false;
    error = {error_code_of(text_of("code")).value_or(ErrorCode::internal), text_of("place"), text_of("message")};
    return true;
  }

  // {"node/typification": error, ...}
  bool read_errors(const Json& errors) {
    for (const auto& [name, json] : errors.items()) {
      const std::string place = "state/errors/" + name;
      const auto type = type_name_of(name);
      if (type && is_of_a_ghost(type->first, type->second, place)) continue;
      const auto record = type ? scene_.nodes.find(type->first) : scene_.nodes.end();
      if (record == scene_.nodes.end() || !record->second.types.contains(type->second))
        return fail({ErrorCode::not_found, place, "expects `node/typification` of a node of this scene"});
      if (!read_error(json, place, state.errors[*type])) return false;
    }
    return true;
  }

  // {"link": error, ...}
  bool read_link_errors(const Json& errors) {
    for (const auto& [link, json] : errors.items()) {
      const std::string place = "state/link_errors/" + link;
      if (!scene_.links.contains(link)) return fail({ErrorCode::not_found, place, "there is no link `" + link + "`"});
      if (!read_error(json, place, state.link_errors[link])) return false;
    }
    return true;
  }

  // {"node/typification": {"as_of": ..., "inputs": ..., "begun": ..., "due": ..., "running": ..., "outputs": {...}}, ...}
  bool read_analyses(const Json& analyses) {
    for (const auto& [name, json] : analyses.items()) {
      const std::string place = "state/analyses/" + name;
      const auto type = type_name_of(name);
      if (type && is_of_a_ghost(type->first, type->second, place)) continue;
      if (!type || !json.is_object()) return fail({ErrorCode::wrong_kind, place, "expects the results of `node/typification`"});
      if (!note(check_keys(json, {"as_of", "taken", "inputs", "begun", "due", "running", "error", "outputs"}, place)))
        return false;
      SavedAnalysis& saved = state.analyses[*type];
      if (!read_tick(json, "as_of", place, saved.as_of) || !read_tick(json, "taken", place, saved.taken) ||
          !read_tick(json, "begun", place, saved.begun) || !read_tick(json, "due", place, saved.due) ||
          !read_digest(json, "inputs", place, saved.inputs) || !read_digest(json, "running", place, saved.running_inputs))
        return false;
      if (const auto error = json.find("error"); error != json.end()) {
        Error& kept = saved.result.error.emplace();
        // Older files have its text alone.
        if (error->is_string()) kept = {ErrorCode::internal, "", error->get<std::string>()};
        else if (!read_error(*error, place + "/error", kept)) return false;
      }
      const auto outputs = json.find("outputs");
      if (outputs == json.end()) continue;
      if (!outputs->is_object()) return fail({ErrorCode::wrong_kind, place + "/outputs", "expects an object"});
      const bool is_read =
          read_values(*outputs, place + "/outputs", [&](const std::string& node, const std::string& path, Value&& value) {
            saved.result.outputs.push_back({node, path, std::move(value)});
          });
      if (!is_read) return false;
    }
    return true;
  }

  bool read_digest(const Json& json, const char* key, const std::string& place, std::uint64_t& digest) {
    const auto it = json.find(key);
    if (it == json.end()) return true;
    const std::string text = it->is_string() ? it->get<std::string>() : "";
    const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), digest, 16);
    if (code == std::errc() && end == text.data() + text.size() && !text.empty()) return true;
    return fail({ErrorCode::wrong_kind, place + "/" + key, "expects sixteen hexadecimal digits"});
  }

  // {"node": {"typification.port": {"vertices": [[x, y, z], ...], "triangles": [[a, b, c], ...]}}, ...}
  bool read_meshes(const Json& nodes) {
    for (auto node = nodes.begin(); node != nodes.end(); ++node) {
      bool is_good = node->is_object();
      for (auto path = node->begin(); is_good && path != node->end(); ++path) {
        if (node->is_object() && is_port_of_a_ghost(node.key(), path.key(), "state/meshes/" + node.key() + "/" + path.key()))
          continue;
        MeshPointer mesh = mesh_from_json(*path);
        is_good = mesh != nullptr;
        state.meshes[{node.key(), path.key()}] = std::move(mesh);
      }
      if (!is_good)
        return fail({ErrorCode::wrong_kind, "state/meshes", "expects meshes with `vertices` and `triangles` by node and port"});
    }
    return true;
  }

  const Scene& scene_;
  const Registry& types_;
  std::vector<Problem>& problems_;
  std::set<std::string> told_ghosts_;
};

Json analysis_to_json(const SavedAnalysis& saved, const Registry& types) {
  Json json = Json::object();
  if (saved.as_of >= 0) {
    json["as_of"] = saved.as_of;
    json["taken"] = saved.taken;
    json["inputs"] = hex_digits(saved.inputs);
  }
  if (saved.due < 0) return json;
  json["begun"] = saved.begun;
  json["due"] = saved.due;
  json["running"] = hex_digits(saved.running_inputs);
  if (saved.result.error) json["error"] = error_to_json(*saved.result.error);
  for (const AnalysisOutput& output : saved.result.outputs)
    if (const PortDefinition& port = **types.port(*parse_port_path(output.path)); !is_derived(port.kind))
      json["outputs"][output.node][output.path] = value_to_json(output.value, port);
  return json;
}

}  // namespace

Json state_to_json(const SavedState& state, const Registry& types) {
  const auto port_of = [&](const std::string& path) -> const PortDefinition& { return **types.port(*parse_port_path(path)); };
  Json json = Json::object();
  json["tick"] = state.tick;
  json["calm"] = state.calm;
  Json& nodes = json["nodes"] = Json::object();
  for (const auto& [id, values] : state.nodes) {
    Json& node = append_field(nodes, id) = Json::object();
    for (const auto& [path, value] : values) append_field(node, path) = value_to_json(value, port_of(path));
  }
  if (!state.voices.empty()) {
    Json& links = json["voices"] = Json::object();
    for (const auto& [id, voices] : state.voices) {
      Json& link = append_field(links, id) = Json::object();
      for (const SavedVoice& voice : voices)
        append_field(link, voice.node + "/" + voice.path) = value_to_json(voice.value, port_of(voice.path));
    }
  }
  if (!state.errors.empty()) {
    Json& errors = json["errors"] = Json::object();
    for (const auto& [name, error] : state.errors) append_field(errors, name.first + "/" + name.second) = error_to_json(error);
  }
  if (!state.link_errors.empty()) {
    Json& errors = json["link_errors"] = Json::object();
    for (const auto& [link, error] : state.link_errors) append_field(errors, link) = error_to_json(error);
  }
  for (const auto& [name, saved] : state.analyses)
    json["analyses"][name.first + "/" + name.second] = analysis_to_json(saved, types);
  for (const auto& [target, mesh] : state.meshes) json["meshes"][target.first][target.second] = mesh_to_json(*mesh);
  return json;
}

std::optional<SavedState> state_from_json(const Json& json, const Scene& scene, const Registry& types,
                                          std::vector<Problem>& problems) {
  StateReader reader(scene, types, problems);
  if (!reader.read(json)) return std::nullopt;
  return std::move(reader.state);
}

}  // namespace bl
