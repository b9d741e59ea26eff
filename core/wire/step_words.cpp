// Ids become names: of nodes, of links by their kind and ends, of values as a role card calls them.
#include "core/wire/step_words.h"

#include <algorithm>
#include <vector>

#include <nlohmann/json.hpp>

#include "core/base/unit.h"
#include "core/define/codec.h"
#include "core/reading/figures.h"
#include "core/reading/views/people.h"
#include "core/room/refusals.h"

namespace bl::wire {

namespace {

constexpr std::size_t kMostNames = 3;  // of the nodes at one end of a link

std::string name_of_node(const Scene& scene, const std::string& id) {
  const auto node = scene.nodes.find(id);
  return node == scene.nodes.end() || node->second.name.empty() ? id : node->second.name;
}

// The names of nodes, or what a set of them has in common.
std::string name_of_end(const Scene& scene, const Selection& end) {
  if (end.is_query()) {
    const TypificationDefinition* type = full_registry().typification(end.typification);
    const std::string role = type == nullptr ? end.typification : type->label;
    return end.tag.empty() ? role : "#" + end.tag + (role.empty() ? "" : ", " + role);
  }
  std::string names;
  for (std::size_t k = 0; k < end.ids.size() && k < kMostNames; ++k)
    names += (k == 0 ? "" : ", ") + name_of_node(scene, end.ids[k]);
  return names + (end.ids.size() > kMostNames ? ", \xE2\x80\xA6" : "");
}

std::string label_of_kind(const Scene& scene, const std::string& kind) {
  const LinkDefinition* definition = scene.scripts.types(full_registry()).link(kind);
  return definition == nullptr || definition->label.empty() ? kind : definition->label;
}

Json link_in_parts(const Scene& scene, const std::string& kind, const Selection& from, const Selection& to) {
  return {{"kind", label_of_kind(scene, kind)}, {"from", name_of_end(scene, from)}, {"to", name_of_end(scene, to)}};
}

// A link of the scene in parts; its id as it is where it is not there.
Json link_of(const Scene& scene, const std::string& id) {
  const auto link = scene.links.find(id);
  return link == scene.links.end() ? Json(id) : link_in_parts(scene, link->second.kind, link->second.from, link->second.to);
}

std::string text_in(const Command& step, const char* name) {
  const auto found = step.arguments.find(name);
  const auto* value = found == step.arguments.end() ? nullptr : std::get_if<std::string>(&found->second);
  return value == nullptr ? std::string() : *value;
}

Json json_in(const Command& step, const char* name) {
  const auto found = step.arguments.find(name);
  const auto* value = found == step.arguments.end() ? nullptr : std::get_if<JsonValue>(&found->second);
  const auto json = value == nullptr ? Result<const Json*>(nullptr) : value->read();
  return json && *json != nullptr ? **json : Json();
}

bool is_off(const Command& step, const char* name) {
  const auto found = step.arguments.find(name);
  const auto* value = found == step.arguments.end() ? nullptr : std::get_if<bool>(&found->second);
  return value != nullptr && !*value;
}

// What people read at a glance: a number, a text, a place; nothing of tables and lists.
Json plain(const Json& value) {
  if (value.is_number() || value.is_boolean() || value.is_string()) return value;
  const bool is_place = value.is_array() && !value.empty() && value.size() <= 3 &&
                        std::all_of(value.begin(), value.end(), [](const Json& one) { return one.is_number(); });
  return is_place ? value : Json();
}

// How a role card calls a value: that of whoever has made the draft before those of others.
std::string label_on_card(const ViewSources& sources, const room::Draft& draft, const std::string& node,
                          const std::string& port) {
  const room::Seat* owner = sources.room.state().seat(draft.seat());
  std::string found;
  for (const auto& row : reading::rows<reading::GroupFigures>(sources.state)) {
    const Table& controls = *row.figures.controls;
    for (std::size_t k = 0; k < controls.rows.size(); ++k) {
      if (controls.text(k, "node") != node || controls.text(k, "port") != port || controls.text(k, "label").empty()) continue;
      if (owner != nullptr && owner->card == sources.state.plan->nodes[row.node].id) return controls.text(k, "label");
      if (found.empty()) found = controls.text(k, "label");
    }
  }
  return found;
}

Json what_of(const ViewSources& sources, const room::Draft& draft, const std::string& node, const std::string& port) {
  Json what = {{"port", port.substr(port.find('.') + 1)}};
  if (const std::string label = label_on_card(sources, draft, node, port); !label.empty()) what["label"] = label;
  return what;
}

// From what the room has to what the step sets, where that can be said in short.
void put_values(Json& said, const ViewSources& sources, const Touch& place, const Json& after, std::string_view unit) {
  const Json to = plain(after);
  if (to.is_null()) return;
  const auto before = room::value_at(sources.room.scene(), full_registry(), place);
  const Json from = before ? plain(**before->read()) : Json();
  const bool is_alike = from.type() == to.type() || (from.is_number() && to.is_number());
  if (is_alike && from != to) said["from"] = from;
  said["to"] = to;
  if (!unit.empty()) said["unit"] = unit;
}

void say_port(Json& said, const ViewSources& sources, const room::Draft& draft, const Command& step) {
  const std::string node = text_in(step, "node"), port = text_in(step, "port");
  said["what"] = what_of(sources, draft, node, port);
  const auto path = parse_port_path(port);
  const TypificationDefinition* type = path ? full_registry().typification(path->typification) : nullptr;
  const PortDefinition* definition = type == nullptr ? nullptr : type->find_port(path->port);
  const auto record = sources.room.scene().nodes.find(node);
  if (step.id != "set_port" || definition == nullptr || record == sources.room.scene().nodes.end()) return;
  put_values(said, sources, {ScenePart::node, node, "types/" + step_of(type->id) + "/" + step_of(definition->id)},
             json_in(step, "value"), info(unit_of(full_registry(), record->second, *type, *definition)).symbol);
}

void say_link_value(Json& said, const ViewSources& sources, const room::Draft& draft, const Command& step) {
  const std::string id = text_in(step, "id");
  if (step.id == "set_link_strength") {
    const auto strength = step.arguments.find("strength");
    said["what"] = what_of(sources, draft, id, "strength");
    if (strength != step.arguments.end())
      put_values(said, sources, {ScenePart::link, id, "strength"}, std::get<double>(strength->second), "");
    return;
  }
  const std::string parameter = text_in(step, "parameter");
  said["what"] = what_of(sources, draft, id, parameter);
  const Scene& scene = sources.room.scene();
  const auto link = scene.links.find(id);
  const LinkDefinition* kind = link == scene.links.end() ? nullptr : scene.scripts.types(full_registry()).link(link->second.kind);
  const PortDefinition* port = kind == nullptr ? nullptr : kind->find_port(parameter);
  if (port != nullptr)
    put_values(said, sources, {ScenePart::link, id, "parameters/" + step_of(parameter)}, json_in(step, "value"),
               info(port->unit).symbol);
}

// The name that a new node has in its command; its id where it has none.
std::string name_of_new(const Command& step) {
  const Json node = json_in(step, "node");
  const bool is_named = node.is_object() && node.contains("name") && node["name"].is_string();
  return is_named && node["name"] != "" ? node["name"].get<std::string>() : text_in(step, "id");
}

Json link_of_new(const Scene& scene, const Command& step) {
  const Json link = json_in(step, "link");
  const auto end = [&](const char* name) {
    const auto read =
        link.is_object() && link.contains(name) ? selection_from_json(link[name], "") : Result<Selection>(Selection{});
    return read ? *read : Selection{};
  };
  if (!link.is_object() || !link.contains("kind") || !link["kind"].is_string()) return text_in(step, "id");
  return link_in_parts(scene, link["kind"].get<std::string>(), end("from"), end("to"));
}

Json said_of_one(const ViewSources& sources, const room::Draft& draft, const Command& step) {
  const Scene& scene = sources.room.scene();
  const bool is_undone =
      (step.id == "mute_link" && is_off(step, "muted")) || (step.id == "enable_link" && is_off(step, "enabled"));
  Json said = {{"id", is_undone                                                     ? "not_" + step.id
                      : step.id == "cast_vote" && json_in(step, "ballot").is_null() ? "not_cast_vote"
                                                                                    : step.id}};
  const bool is_of_link = step.id.ends_with("_link") || step.id.starts_with("set_link_");
  if (step.id == "add_node") said["of"] = name_of_new(step);
  else if (step.id == "add_link") said["of"] = link_of_new(scene, step);
  else if (is_of_link) said["of"] = link_of(scene, text_in(step, "id"));
  else if (!text_in(step, "node").empty()) said["of"] = name_of_node(scene, text_in(step, "node"));
  else if (step.id == "set_setting") said["of"] = text_in(step, "setting");
  else if (!text_in(step, "id").empty()) said["of"] = name_of_node(scene, text_in(step, "id"));
  if (!text_in(step, "port").empty()) say_port(said, sources, draft, step);
  if (step.id == "set_link_strength" || step.id == "set_link_parameter") say_link_value(said, sources, draft, step);
  if (step.id == "set_setting")
    put_values(said, sources, {ScenePart::setting, text_in(step, "setting"), ""}, json_in(step, "value"), "");
  if (step.id == "rename_node") said["to"] = text_in(step, "name");
  if (const std::string role = text_in(step, "typification"); !role.empty()) {
    const TypificationDefinition* type = full_registry().typification(role);
    said["to"] = type == nullptr ? role : type->label;
  }
  return said;
}

}  // namespace

// Of a batch the first command that people would name: nodes come and go with their links, and where things stand on the canvas
// is said by what is done.
Json said_of_step(const ViewSources& sources, const room::Draft& draft, const Command& step) {
  if (step.id != "batch") return said_of_one(sources, draft, step);
  const auto list = step.arguments.find("commands");
  const auto* held = list == step.arguments.end() ? nullptr : std::get_if<CommandList>(&list->second);
  std::vector<Command> commands = held == nullptr ? std::vector<Command>() : **held;
  const auto is_view = [](const Command& one) { return one.id == "set_view"; };
  if (!std::all_of(commands.begin(), commands.end(), is_view)) std::erase_if(commands, is_view);
  if (commands.empty()) return {{"id", "batch"}};
  for (const char* id : {"add_node", "remove_node"}) {
    const auto is_it = [id](const Command& one) { return one.id == id; };
    const auto count = std::count_if(commands.begin(), commands.end(), is_it);
    if (count > 1) return {{"id", std::string(id) + "s"}, {"n", count}};
    if (count == 1) return said_of_one(sources, draft, *std::find_if(commands.begin(), commands.end(), is_it));
  }
  Json said = said_of_one(sources, draft, commands.front());
  if (commands.size() > 1) said["n"] = commands.size() - 1;
  return said;
}

Json said_of_place(const ViewSources& sources, const room::Draft& draft, const Touch& place) {
  const Scene& scene = sources.room.scene();
  const bool is_node = place.part == ScenePart::node, is_link = place.part == ScenePart::link;
  Json said = {{"of", is_node ? Json(name_of_node(scene, place.id)) : is_link ? link_of(scene, place.id) : Json(place.id)}};
  std::string path = place.path;
  for (const char* begin : {"types/", "parameters/"})
    if (path.starts_with(begin)) path.erase(0, std::string(begin).size());
  if (path.empty()) return said;
  if (is_node) std::replace(path.begin(), path.end(), '/', '.');
  said["what"] = what_of(sources, draft, place.id, path);
  return said;
}

std::string name_of_link(const Scene& scene, const std::string& id) {
  const Json link = link_of(scene, id);
  if (!link.is_object()) return id;
  return link["kind"].get<std::string>() + ", " + link["from"].get<std::string>() + " \xE2\x80\x93 " +
         link["to"].get<std::string>();
}

}  // namespace bl::wire
