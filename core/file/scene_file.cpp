// The frame of a scene file: format, version, upgrades, settings, records and saved state.
#include "core/file/scene_file.h"

#include <algorithm>

#include <nlohmann/json.hpp>

#include "core/base/hash.h"
#include "core/base/packed_kind.h"
#include "core/base/text.h"
#include "core/define/bounded_json.h"
#include "core/define/codec.h"
#include "core/define/json_text.h"
#include "core/file/state_json.h"

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

constexpr const char* kBeginning = "starts with {\"format\": \"behaviourlinks\", \"version\": 1, ...}";

// What is no JSON at all, such as a table, is told as what it is not, and what is empty as that. Of archives the parser says
// more.
std::optional<Error> why_no_scene(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t\r\n", text.starts_with("\xEF\xBB\xBF") ? 3 : 0);
  if (first == std::string_view::npos)
    return Error{ErrorCode::parse, "", std::string("the file is empty; a scene ") + kBeginning};
  if (text[first] == '{' || text[first] == '[' || text[first] == '\0' || !packed_kind(text).empty()) return std::nullopt;
  return Error{ErrorCode::parse, place_in_text(text, first),
               std::string("this is not a scene, which is JSON text: it ") + kBeginning};
}

// A digest of what a running state belongs to, and of the state itself but for its `check`. Whoever edits a saved file with
// another program means what they have written, and not the figures of before.
std::string check_of(const Json& file, const Json& state) {
  Hash hash;
  for (const char* key : {"settings", "scripts", "nodes", "links"})
    if (const auto part = file.find(key); part != file.end()) hash.add(write_json_line(*part));
  for (const auto& [key, part] : state.items())
    if (key != "check") hash.add(std::string_view(key)), hash.add(write_json_line(part));
  return hex_digits(hash.value());
}

// Files of older programs have no check.
bool fits_its_state(const Json& file) {
  const auto state = file.find("state");
  if (state == file.end() || !state->is_object() || !state->contains("check")) return true;
  return (*state)["check"] == check_of(file, *state);
}

class Reader {
 public:
  explicit Reader(const Registry& program) : program_(program), registry_(&program) {}

  SceneReading run(std::string_view text) {
    auto json = parse_json(text);
    if (const auto none = why_no_scene(text)) fail(*none);
    else if (!json) fail(json.error());
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
      return fail({ErrorCode::parse, "format", std::string("this is not a scene: a scene ") + kBeginning});
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
    const bool is_as_saved = fits_its_state(file);  // before records are read, which takes them out of the file
    read_revisions(file);
    if (const auto it = file.find("settings"); it != file.end())
      if (auto settings = ports_from_json(settings_type(), *it, "settings"); note(settings))
        reading_.scene.settings = std::move(*settings);
    read_scripts(file);
    read_records(file, "nodes",
                 [this](Json& json, const std::string& id, const std::string& place) { read_node(json, id, place); });
    merge_node_settings();
    read_records(file, "links",
                 [this](Json& json, const std::string& id, const std::string& place) { read_link(json, id, place); });
    if (const auto it = file.find("view"); it != file.end()) {
      if (it->is_object()) reading_.scene.view = write_json_line(*it);
      else fail({ErrorCode::wrong_kind, "view", "expects an object"});
    }
    if (reading_.is_usable())
      for (Problem& problem : check_scene(reading_.scene, program_)) reading_.problems.push_back(std::move(problem));
    const auto state = file.find("state");
    if (state == file.end() || !reading_.is_usable()) return;
    if (is_as_saved) reading_.state = state_from_json(*state, reading_.scene, *registry_, reading_.problems);
    else
      reading_.problems.push_back(
          {false,
           {ErrorCode::conflict, "state",
            "the file was edited after this running state was saved: it is left out, and the scene starts anew"}});
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
      node_settings_.try_emplace({port.id, place + "/" + port.id}, std::move(*value));
    }
    return true;
  }

  // The first place that says something becomes the setting where there is none, whatever the order in the file; others are told.
  void merge_node_settings() {
    for (const auto& [where, value] : node_settings_) {
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
            is_taken ? "became a setting of the scene, which applies to all nodes"
                     : "the scene's setting `" + port +
                           "` is used instead: it applies to all nodes, and its value differs from the one here"}});
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

  const Registry& program_;
  const Registry* registry_;  // with the kinds of the scene's scripts
  SceneReading reading_;
  std::map<std::string, std::int64_t> revisions_;
  std::map<std::pair<std::string, std::string>, Value> node_settings_;  // by setting and place
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
  Json& nodes = append_field(file, "nodes") = Json::array();
  for (const auto& [id, node] : scene.nodes) {
    Json record = {{"id", id}};
    append_fields(record, node_to_json(node, registry));
    nodes.push_back(std::move(record));
  }
  Json& links = append_field(file, "links") = Json::array();
  for (const auto& [id, link] : scene.links) {
    Json record = {{"id", id}};
    append_fields(record, link_to_json(link, registry));
    links.push_back(std::move(record));
  }
  if (state != nullptr && state->tick > 0) {
    Json running = state_to_json(*state, registry);
    running["check"] = check_of(file, running);
    file["state"] = std::move(running);
  }
  if (!scene.view.empty()) {
    // Ours, because the library's own builder takes n² for the boxes of n nodes; but it reads no more once a stop is wished.
    auto view = parse_json(scene.view);
    file["view"] = view ? std::move(*view) : Json::parse(scene.view, nullptr, false);
  }
  return write_json(file, 2) + "\n";
}

}  // namespace bl
