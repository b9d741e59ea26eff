// The frame of a scene file: format, version, upgrades, settings, records and saved state.
#include "core/file/scene_file.h"

#include <algorithm>
#include <charconv>

#include <nlohmann/json.hpp>

#include "core/base/text.h"
#include "core/define/codec.h"
#include "core/file/mesh_json.h"

namespace bl {

bool SceneReading::is_usable() const {
  return std::none_of(problems.begin(), problems.end(), [](const Problem& p) { return p.is_error; });
}

const Error& SceneReading::first_error() const {
  return std::find_if(problems.begin(), problems.end(), [](const Problem& p) { return p.is_error; })->error;
}

namespace {

// Brings the values of one type, saved under an older revision, to the current one.
Result<void> upgrade_values(const TypeDefinition& type, std::int64_t revision, Json& values, const std::string& place) {
  if (revision > type.revision)
    return Error{ErrorCode::version, place,
                 "`" + type.id + "` was saved by a newer version of the program (revision " + std::to_string(revision) + ")"};
  for (const UpgradeDefinition& step : type.upgrades) {
    if (step.from_revision < revision) continue;
    auto text = step.upgrade(write_json_line(values));
    if (!text) return text.error().within(place);
    auto changed = parse_json(*text);
    if (!changed) return changed.error().within(place);
    values = std::move(*changed);
  }
  return {};
}

std::string joined_lines(const Json& lines) {
  std::string text;
  for (const Json& line : lines) text += (&line == &lines.front() ? "" : "\n") + line.get<std::string>();
  return text;
}

class Reader {
 public:
  explicit Reader(const Registry& program) : program_(program), registry_(&program) {}

  SceneReading run(std::string_view text) {
    auto json = parse_json(text);
    if (!json) fail(json.error());
    else read(*json);
    return std::move(reading_);
  }

 private:
  void fail(Error error) { reading_.problems.push_back({true, std::move(error)}); }
  template <class T>
  bool note(const Result<T>& result) {
    if (!result) fail(result.error());
    return result.ok();
  }

  void read(Json& file) {
    if (!file.is_object() || file.value("format", Json()) != "behaviourlinks")
      return fail({ErrorCode::parse, "format",
                   "this is not a scene: a scene starts with {\"format\": \"behaviourlinks\", \"version\": 1, ...}"});
    const auto version = file.find("version");
    if (version == file.end()) return fail({ErrorCode::missing, "version", "the version number is missing"});
    if (!version->is_number_integer())
      return fail({ErrorCode::wrong_kind, "version", "expects a whole number, found " + version->dump()});
    if (*version > kSceneVersion)
      return fail({ErrorCode::version, "version",
                   "the file has version " + version->dump() + ", this program reads up to " + std::to_string(kSceneVersion) +
                       "; get a newer program"});
    if (*version < 1) return fail({ErrorCode::version, "version", "there is no version " + version->dump()});
    note(check_keys(file, {"format", "version", "revisions", "settings", "scripts", "nodes", "links", "state", "view"}, ""));
    read_revisions(file);
    if (const auto it = file.find("settings"); it != file.end())
      if (auto settings = ports_from_json(settings_type(), *it, "settings"); note(settings))
        reading_.scene.settings = std::move(*settings);
    read_scripts(file);
    read_records(file, "nodes",
                 [this](Json& json, const std::string& id, const std::string& place) { read_node(json, id, place); });
    settle_what_nodes_said();
    read_records(file, "links",
                 [this](Json& json, const std::string& id, const std::string& place) { read_link(json, id, place); });
    if (const auto it = file.find("view"); it != file.end()) {
      if (it->is_object()) reading_.scene.view = write_json_line(*it);
      else fail({ErrorCode::wrong_kind, "view", "expects an object"});
    }
    if (reading_.is_usable())
      for (Problem& problem : check_scene(reading_.scene, program_)) reading_.problems.push_back(std::move(problem));
    if (const auto it = file.find("state"); it != file.end() && reading_.is_usable()) read_state(*it);
  }

  void read_revisions(const Json& file) {
    const auto it = file.find("revisions");
    if (it == file.end()) return;
    if (!it->is_object()) return fail({ErrorCode::wrong_kind, "revisions", "expects {\"type\": revision, ...}"});
    for (const auto& [id, number] : it->items())
      if (number.is_number_integer() && number >= 1) revisions_[id] = number.get<std::int64_t>();
      else fail({ErrorCode::wrong_kind, "revisions/" + id, "expects a whole number from 1"});
  }

  std::int64_t revision_of(const std::string& id) const {
    const auto it = revisions_.find(id);
    return it == revisions_.end() ? 1 : it->second;
  }

  template <class Read>
  void read_records(Json& file, const std::string& key, Read read_one) {
    const auto list = file.find(key);
    if (list == file.end()) return;
    if (!list->is_array()) return fail({ErrorCode::wrong_kind, key, "expects a list"});
    for (std::size_t i = 0; i < list->size(); ++i) {
      const std::string number = key + "/" + std::to_string(i);
      const Json& record = (*list)[i];
      if (!record.is_object() || !record.contains("id") || !record["id"].is_string()) {
        fail({ErrorCode::missing, number, "`id` is missing"});
        continue;
      }
      const std::string id = record["id"].get<std::string>();
      if (!is_identifier(id))
        fail({ErrorCode::wrong_kind, number + "/id", "`" + id.substr(0, 80) + "` is no id: use 1 to 64 of a-z 0-9 _ - . #"});
      else read_one((*list)[i], id, key + "/" + id);
    }
  }

  // Before the links, because it is the scripts that make their kinds known.
  void read_scripts(Json& file) {
    std::map<std::string, std::string> texts;
    read_records(file, "scripts", [&](const Json& json, const std::string& id, const std::string& place) {
      if (!note(check_keys(json, {"id", "lines"}, place))) return;
      const auto lines = json.find("lines");
      if (lines == json.end() || !lines->is_array() || lines->empty() ||
          !std::all_of(lines->begin(), lines->end(), [](const Json& line) { return line.is_string(); }))
        return fail({ErrorCode::wrong_kind, place + "/lines", "expects the lines of the script, a list of texts"});
      if (!texts.emplace(id, joined_lines(*lines)).second)
        fail({ErrorCode::duplicate, place, "two scripts have the id `" + id + "`; ids must be unique"});
    });
    reading_.scene.scripts = Scripts::read(std::move(texts), program_);
    registry_ = &reading_.scene.scripts.types(program_);
  }

  void read_node(Json& json, const std::string& id, const std::string& place) {
    if (reading_.scene.nodes.contains(id))
      return fail({ErrorCode::duplicate, place, "two nodes have the id `" + id + "`; ids must be unique"});
    if (const auto types = json.find("types"); types != json.end() && types->is_object())
      for (auto& [type_id, values] : types->items())
        if (const TypificationDefinition* type = registry_->typification(type_id))
          if (!note(upgrade_values(*type, revision_of(type_id), values, place + "/types/" + type_id)) ||
              !take_over(*type, values, place + "/types/" + type_id))
            return;
    if (auto node = node_from_json(json, *registry_, place); note(node)) {
      for (const auto& [type_id, values] : node->types)
        for (const PortDefinition& port : registry_->typification(type_id)->ports)
          if (port.of_scene == OfScene::always) node->locked.erase(type_id + "." + port.id);  // nobody could change it anyway
      reading_.scene.nodes.emplace(id, std::move(*node));
    }
  }

  // Older files say at a node what now is said once for the scene.
  bool take_over(const TypificationDefinition& type, Json& values, const std::string& place) {
    for (const PortDefinition& port : type.ports) {
      if (port.of_scene != OfScene::always || !values.is_object() || !values.contains(port.id)) continue;
      auto value = value_from_json(port, values[port.id], place + "/" + port.id);
      if (!note(value)) return false;
      values.erase(port.id);
      said_at_nodes_.try_emplace({port.id, place + "/" + port.id}, std::move(*value));
    }
    return true;
  }

  // The first place that says something becomes the setting where there is none, whatever the order in the file; others are told.
  void settle_what_nodes_said() {
    for (const auto& [where, value] : said_at_nodes_) {
      const auto& [port, place] = where;
      const PortDefinition& setting = *settings_type().find_port(port);
      PortValues& settings = reading_.scene.settings;
      const bool is_taken = !settings.contains(port) && value != setting.default_value;
      if (is_taken) settings[port] = value;
      const bool is_so = set_value(settings, {}, setting) == value;
      if (!is_taken && is_so) continue;
      reading_.problems.push_back(
          {false,
           {ErrorCode::conflict, place,
            is_taken ? "is said once for the scene now: this became its setting, and holds for all nodes"
                     : "the scene's setting `" + port +
                           "` holds instead; it is said once for all nodes and differs from what stood here"}});
    }
  }

  void read_link(Json& json, const std::string& id, const std::string& place) {
    if (reading_.scene.links.contains(id))
      return fail({ErrorCode::duplicate, place, "two links have the id `" + id + "`; ids must be unique"});
    if (const auto kind = json.find("kind"); kind != json.end() && kind->is_string())
      if (const LinkDefinition* type = registry_->link(kind->get_ref<const std::string&>()); type && json.contains("parameters"))
        if (!note(upgrade_values(*type, revision_of(kind->get<std::string>()), json["parameters"], place + "/parameters")))
          return;
    if (auto link = link_from_json(json, *registry_, place); note(link)) reading_.scene.links.emplace(id, std::move(*link));
  }

  Result<Value> state_value(const std::string& node, const std::string& path, const Json& json, const std::string& place) const {
    const auto parsed = parse_port_path(path);
    const auto record = reading_.scene.nodes.find(node);
    if (record == reading_.scene.nodes.end()) return Error{ErrorCode::not_found, place, "there is no node `" + node + "`"};
    if (!parsed) return Error{ErrorCode::wrong_kind, place, "expects \"typification.port\""};
    const auto port = registry_->port(*parsed);
    if (!port) return port.error().within(place);
    if (!record->second.types.contains(parsed->typification))
      return Error{ErrorCode::not_found, place, "the node is not a `" + parsed->typification + "`"};
    return running_value_from_json(**port, json, place);
  }

  // A known typification had this port once. Running figures follow from the rest, so that a scene is not lost for one of them.
  bool is_of_older_program(const std::string& path) const {
    const auto parsed = parse_port_path(path);
    const TypificationDefinition* type = parsed ? registry_->typification(parsed->typification) : nullptr;
    return type != nullptr && type->find_port(parsed->port) == nullptr;
  }

  void read_state(const Json& json) {
    if (!json.is_object()) return fail({ErrorCode::wrong_kind, "state", "expects an object"});
    if (!note(check_keys(json, {"tick", "calm", "nodes", "held", "analyses", "meshes"}, "state"))) return;
    SavedState state;
    if (!read_tick(json, "tick", "state", state.tick) || !read_tick(json, "calm", "state", state.calm)) return;
    const Json nodes = json.value("nodes", Json::object());
    const bool is_read = read_values(nodes, "state/nodes", [&](const std::string& node, const std::string& path, Value&& value) {
      state.nodes[node][path] = std::move(value);
    });
    if (!is_read || !read_held(json.value("held", Json::object()), state)) return;
    if (!read_analyses(json.value("analyses", Json::object()), state)) return;
    if (!read_meshes(json.value("meshes", Json::object()), state)) return;
    reading_.state = std::move(state);
  }

  bool read_tick(const Json& json, const char* key, const std::string& place, std::int64_t& tick) {
    const auto it = json.find(key);
    if (it == json.end()) return true;
    const bool is_good = it->is_number_integer() && *it >= 0 && *it <= (std::int64_t{1} << 53);
    if (is_good) tick = it->get<std::int64_t>();
    else fail({ErrorCode::wrong_kind, place + "/" + key, "expects a whole number from 0"});
    return is_good;
  }

  // {"node": {"typification.port": value, ...}, ...}
  template <class Take>
  bool read_values(const Json& nodes, const std::string& place, Take&& take) {
    if (!nodes.is_object()) {
      fail({ErrorCode::wrong_kind, place, "expects an object"});
      return false;
    }
    for (const auto& [node, values] : nodes.items()) {
      if (!values.is_object()) {
        fail({ErrorCode::wrong_kind, place + "/" + node, "expects an object"});
        return false;
      }
      for (const auto& [path, content] : values.items()) {
        const std::string here = place + "/" + node + "/" + path;
        if (is_of_older_program(path)) {
          reading_.problems.push_back(
              {false,
               {ErrorCode::not_found, here, "this program keeps no such figure; what follows from it is worked out again"}});
          continue;
        }
        auto value = state_value(node, path, content, here);
        if (!note(value)) return false;
        take(node, path, std::move(*value));
      }
    }
    return true;
  }

  // {"node/typification": {"as_of": ..., "inputs": ..., "begun": ..., "due": ..., "running": ..., "outputs": {...}}, ...}
  bool read_analyses(const Json& analyses, SavedState& state) {
    if (!analyses.is_object()) {
      fail({ErrorCode::wrong_kind, "state/analyses", "expects an object"});
      return false;
    }
    for (const auto& [name, json] : analyses.items()) {
      const std::string place = "state/analyses/" + name;
      const std::size_t slash = name.find('/');
      if (slash == std::string::npos || !json.is_object()) {
        fail({ErrorCode::wrong_kind, place, "expects the results of `node/typification`"});
        return false;
      }
      if (!note(check_keys(json, {"as_of", "taken", "inputs", "begun", "due", "running", "error", "outputs"}, place)))
        return false;
      SavedAnalysis& saved = state.analyses[{name.substr(0, slash), name.substr(slash + 1)}];
      if (!read_tick(json, "as_of", place, saved.as_of) || !read_tick(json, "taken", place, saved.taken) ||
          !read_tick(json, "begun", place, saved.begun) || !read_tick(json, "due", place, saved.due) ||
          !read_digest(json, "inputs", place, saved.inputs) || !read_digest(json, "running", place, saved.running_inputs))
        return false;
      if (const auto error = json.find("error"); error != json.end() && error->is_string())
        saved.result.error = Error{ErrorCode::internal, "", error->get<std::string>()};
      const bool is_read = read_values(json.value("outputs", Json::object()), place + "/outputs",
                                       [&](const std::string& node, const std::string& path, Value&& value) {
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
    fail({ErrorCode::wrong_kind, place + "/" + key, "expects sixteen hexadecimal digits"});
    return false;
  }

  bool read_held(const Json& held, SavedState& state) {
    if (!held.is_object()) {
      fail({ErrorCode::wrong_kind, "state/held", "expects an object"});
      return false;
    }
    for (const auto& [link, voices] : held.items()) {
      const std::string place = "state/held/" + link;
      if (!reading_.scene.links.contains(link) || !voices.is_object()) {
        fail({ErrorCode::not_found, place, "expects the wanted values of a link of this scene"});
        return false;
      }
      for (const auto& [target, content] : voices.items()) {
        const std::size_t slash = target.find('/');
        const std::string node = target.substr(0, slash), path = slash == std::string::npos ? "" : target.substr(slash + 1);
        auto value = state_value(node, path, content, place + "/" + target);
        if (!note(value)) return false;
        state.held[link].push_back({{node, path}, Voice{{}, std::move(*value), 0, reading_.scene.links.at(link).strength}});
      }
    }
    return true;
  }

  // {"node": {"typification.port": {"vertices": [[x, y, z], ...], "triangles": [[a, b, c], ...]}}, ...}
  bool read_meshes(const Json& nodes, SavedState& state) {
    const std::string place = "state/meshes";
    bool is_good = nodes.is_object();
    for (auto node = nodes.begin(); is_good && node != nodes.end(); ++node) {
      is_good = node->is_object();
      for (auto path = node->begin(); is_good && path != node->end(); ++path) {
        MeshPointer mesh = mesh_from_json(*path);
        is_good = mesh != nullptr;
        state.meshes[{node.key(), path.key()}] = std::move(mesh);
      }
    }
    if (!is_good) fail({ErrorCode::wrong_kind, place, "expects meshes with `vertices` and `triangles` by node and port"});
    return is_good;
  }

  const Registry& program_;
  const Registry* registry_;  // with the kinds of the scene's scripts
  SceneReading reading_;
  std::map<std::string, std::int64_t> revisions_;
  std::map<std::pair<std::string, std::string>, Value> said_at_nodes_;  // by setting and place
};

// One line per element, so that a diff shows the lines that changed.
Json scripts_to_json(const Scripts& scripts) {
  Json list = Json::array();
  for (const auto& [name, text] : scripts.texts()) {
    Json lines = Json::array();
    for (std::size_t begin = 0;;) {
      const std::size_t end = text.find('\n', begin);
      lines.push_back(text.substr(begin, end == std::string::npos ? end : end - begin));
      if (end == std::string::npos) break;
      begin = end + 1;
    }
    list.push_back({{"id", name}, {"lines", std::move(lines)}});
  }
  return list;
}

Json revisions_of(const Scene& scene, const Registry& registry) {
  std::map<std::string, int> revisions;
  for (const auto& [id, node] : scene.nodes)
    for (const auto& [type, values] : node.types)
      if (const int revision = registry.typification(type)->revision; revision > 1) revisions[type] = revision;
  for (const auto& [id, link] : scene.links)
    if (link.ghost.empty())
      if (const int revision = registry.link(link.kind)->revision; revision > 1) revisions[link.kind] = revision;
  return revisions.empty() ? Json::object() : Json(revisions);
}

Json state_to_json(const SavedState& state, const Registry& registry) {
  auto port_of = [&](const std::string& path) -> const PortDefinition& { return **registry.port(*parse_port_path(path)); };
  Json json = Json::object();
  json["tick"] = state.tick;
  json["calm"] = state.calm;
  Json& nodes = json["nodes"] = Json::object();
  for (const auto& [node, values] : state.nodes)
    for (const auto& [path, value] : values) nodes[node][path] = value_to_json(value, port_of(path));
  for (const auto& [link, voices] : state.held)
    for (const auto& [target, voice] : voices)
      json["held"][link][target.first + "/" + target.second] = value_to_json(voice.value, port_of(target.second));
  for (const auto& [name, saved] : state.analyses) {
    Json& analysis = json["analyses"][name.first + "/" + name.second] = Json::object();
    if (saved.as_of >= 0) analysis["as_of"] = saved.as_of;
    if (saved.as_of >= 0) analysis["taken"] = saved.taken;
    if (saved.as_of >= 0) analysis["inputs"] = hex_digits(saved.inputs);
    if (saved.due < 0) continue;
    analysis["begun"] = saved.begun;
    analysis["due"] = saved.due;
    analysis["running"] = hex_digits(saved.running_inputs);
    if (saved.result.error) analysis["error"] = saved.result.error->text();
    for (const AnalysisOutput& output : saved.result.outputs)
      if (port_of(output.path).kind != ValueKind::mesh)
        analysis["outputs"][output.node][output.path] = value_to_json(output.value, port_of(output.path));
  }
  for (const auto& [target, mesh] : state.meshes) json["meshes"][target.first][target.second] = mesh_to_json(*mesh);
  return json;
}

}  // namespace

SceneReading read_scene(std::string_view text, const Registry& registry) { return Reader(registry).run(text); }

std::string write_scene(const Scene& scene, const Registry& program, const SavedState* state) {
  const Registry& registry = scene.scripts.types(program);
  Json file = Json::object();
  file["format"] = "behaviourlinks";
  file["version"] = kSceneVersion;
  if (Json revisions = revisions_of(scene, registry); !revisions.empty()) file["revisions"] = std::move(revisions);
  if (Json settings = ports_to_json(settings_type(), scene.settings); !settings.empty()) file["settings"] = std::move(settings);
  if (Json scripts = scripts_to_json(scene.scripts); !scripts.empty()) file["scripts"] = std::move(scripts);
  file["nodes"] = Json::array();
  for (const auto& [id, node] : scene.nodes) {
    Json record = {{"id", id}};
    record.update(node_to_json(node, registry));
    file["nodes"].push_back(std::move(record));
  }
  file["links"] = Json::array();
  for (const auto& [id, link] : scene.links) {
    Json record = {{"id", id}};
    record.update(link_to_json(link, registry));
    file["links"].push_back(std::move(record));
  }
  if (state != nullptr && state->tick > 0) file["state"] = state_to_json(*state, registry);
  if (!scene.view.empty()) file["view"] = Json::parse(scene.view, nullptr, false);
  return write_json(file, 2) + "\n";
}

}  // namespace bl
