// A plain comparison of two scenes, member by member.
#include "tests/support/scene_differences.h"

#include <map>
#include <string>

#include <nlohmann/json.hpp>

#include "core/define/json_text.h"
#include "core/define/registry.h"

namespace bl {

namespace {

// Calls `both` for what is in both maps, and notes what is in one only.
template <class Map, class Both>
void compare(const Map& before, const Map& after, ScenePart part, const std::string& id, const std::string& path,
             std::set<Touch>& found, const Both& both) {
  const auto place = [&](const std::string& key) {
    return path.empty() && id.empty() ? Touch{part, key, ""} : Touch{part, id, path + key};
  };
  for (const auto& [key, value] : before)
    if (!after.contains(key)) found.insert(place(key));
  for (const auto& [key, value] : after) {
    const auto old = before.find(key);
    if (old == before.end()) found.insert(place(key));
    else both(place(key), old->second, value);
  }
}

// The rows of a table by the text of their key column, with each row's number; nothing where a name does not stand for one row.
std::map<std::string, std::size_t> names_of(const Table& table, std::size_t key) {
  std::map<std::string, std::size_t> names;
  for (std::size_t r = 0; r < table.rows.size(); ++r) names[std::get<std::string>(table.rows[r][key])] = r;
  if (names.size() != table.rows.size() || names.contains("")) names.clear();
  return names;
}

// Rows and fields of tables whose rows have names; all of the table where that does not say it.
std::set<std::string> table_paths(const PortDefinition& port, const Table& before, const Table& after) {
  std::size_t key = 0;
  while (key < port.columns.size() && !port.columns[key].is_key) ++key;
  if (key == port.columns.size()) return {""};
  const auto old = names_of(before, key), fresh = names_of(after, key);
  if (old.size() != before.rows.size() || fresh.size() != after.rows.size()) return {""};
  std::set<std::string> paths;
  for (const auto& [name, row] : old)
    if (!fresh.contains(name)) paths.insert(name);
  for (const auto& [name, row] : fresh) {
    if (!old.contains(name)) {
      paths.insert(name);
      continue;
    }
    for (const auto& [other, place] : fresh)
      if (old.contains(other) && (place < row) != (old.at(other) < old.at(name))) return {""};
    for (std::size_t c = 0; c < port.columns.size(); ++c)
      if (before.rows[old.at(name)][c] != after.rows[row][c]) paths.insert(name + "/" + port.columns[c].id);
  }
  return paths;
}

void compare_values(const std::string& type, const std::string& node, const PortValues& before, const PortValues& after,
                    std::set<Touch>& found) {
  for (const PortDefinition& port : full_registry().typification(type)->ports) {
    const auto old = before.find(port.id), fresh = after.find(port.id);
    if (old == before.end() && fresh == after.end()) continue;
    if (old != before.end() && fresh != after.end() && old->second == fresh->second) continue;
    const std::string path = "types/" + type + "/" + port.id;
    std::set<std::string> inner{""};
    if (port.kind == ValueKind::table)
      inner = table_paths(port, *std::get<Shared<Table>>(old == before.end() ? port.default_value : old->second),
                          *std::get<Shared<Table>>(fresh == after.end() ? port.default_value : fresh->second));
    if (inner.empty()) inner.insert("");
    for (const std::string& step : inner) found.insert({ScenePart::node, node, step.empty() ? path : path + "/" + step});
  }
}

void compare_nodes(const Touch& place, const NodeRecord& before, const NodeRecord& after, std::set<Touch>& found) {
  if (before.name != after.name) found.insert({place.part, place.id, "name"});
  const auto same = [&found](const Touch& at, const auto& old, const auto& fresh) {
    if (!(old == fresh)) found.insert(at);
  };
  compare(before.types, after.types, place.part, place.id, "types/", found,
          [&](const Touch& type, const PortValues& old, const PortValues& fresh) {
            const std::string id = type.path.substr(6);
            compare_values(id, place.id, old, fresh, found);
          });
  compare(before.ghosts, after.ghosts, place.part, place.id, "types/", found, same);
  for (const std::string& path : before.locked)
    if (!after.locked.contains(path)) found.insert({place.part, place.id, "locked/" + path});
  for (const std::string& path : after.locked)
    if (!before.locked.contains(path)) found.insert({place.part, place.id, "locked/" + path});
}

void compare_links(const Touch& place, const LinkRecord& before, const LinkRecord& after, std::set<Touch>& found) {
  if (before.kind != after.kind || before.ghost != after.ghost) {
    found.insert(place);
    return;
  }
  const auto note = [&](bool is_same, const char* path) {
    if (!is_same) found.insert({place.part, place.id, path});
  };
  note(before.from == after.from, "from");
  note(before.to == after.to, "to");
  note(before.is_enabled == after.is_enabled, "enabled");
  note(before.is_muted == after.is_muted, "muted");
  note(before.strength == after.strength, "strength");
  compare(before.parameters, after.parameters, place.part, place.id, "parameters/", found,
          [&](const Touch& at, const Value& old, const Value& fresh) {
            if (!(old == fresh)) found.insert(at);
          });
}

void compare_views(const Json& before, const Json& after, const std::string& path, std::set<Touch>& found) {
  const bool is_branch = (before.is_object() || before.is_null()) && (after.is_object() || after.is_null());
  if (!is_branch) {
    if (before != after) found.insert({ScenePart::view, "", path});
    return;
  }
  std::set<std::string> keys;
  for (const Json* view : {&before, &after})
    for (const auto& item : view->items())
      if (view->is_object()) keys.insert(item.key());
  for (const std::string& key : keys)
    compare_views(before.is_object() ? before.value(key, Json()) : Json(), after.is_object() ? after.value(key, Json()) : Json(),
                  path.empty() ? key : path + "/" + key, found);
}

Json view_of(const Scene& scene) { return scene.view.empty() ? Json::object() : Json::parse(scene.view); }

}  // namespace

std::set<Touch> differences(const Scene& before, const Scene& after) {
  std::set<Touch> found;
  const auto same = [&found](const Touch& at, const auto& old, const auto& fresh) {
    if (!(old == fresh)) found.insert(at);
  };
  compare(before.settings, after.settings, ScenePart::setting, "", "", found, same);
  compare(before.scripts.texts(), after.scripts.texts(), ScenePart::script, "", "", found, same);
  compare(before.nodes, after.nodes, ScenePart::node, "", "", found,
          [&](const Touch& at, const NodeRecord& old, const NodeRecord& fresh) { compare_nodes(at, old, fresh, found); });
  compare(before.links, after.links, ScenePart::link, "", "", found,
          [&](const Touch& at, const LinkRecord& old, const LinkRecord& fresh) { compare_links(at, old, fresh, found); });
  compare_views(view_of(before), view_of(after), "", found);
  if (before.view != after.view && (found.empty() || found.rbegin()->part != ScenePart::view))
    found.insert({ScenePart::view, "", ""});
  return found;
}

}  // namespace bl
