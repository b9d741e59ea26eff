// Checks of a scene as a whole, beyond the form of its file.
#include <algorithm>
#include <cmath>

#include "core/base/near_names.h"
#include "core/base/text.h"
#include "core/graph/plan.h"

namespace bl {

namespace {

void check_selection(const Scene& scene, const Selection& selection, const std::string& place, const Registry& registry,
                     std::vector<Problem>& problems) {
  for (const std::string& id : selection.ids)
    if (!scene.nodes.contains(id))
      problems.push_back(
          {true, {ErrorCode::not_found, place, "there is no node `" + id + "`" + did_you_mean_among(id, scene.nodes)}});
  if (!selection.typification.empty() && registry.typification(selection.typification) == nullptr)
    problems.push_back({false,
                        {ErrorCode::unknown_type, place,
                         "unknown typification `" + selection.typification + "`" +
                             did_you_mean(selection.typification, keys_of(registry.typifications()))}});
}

// The strength of a link, or a parameter of its kind; a ghost may have any.
std::string why_no_part_of_link(const LinkRecord& link, const std::string& name, const Registry& registry) {
  const LinkDefinition* kind = registry.link(link.kind);
  if (name == "strength" || kind == nullptr || kind->find_port(name) != nullptr) return "";
  return "a link `" + link.kind + "` has no `" + name + "`" + did_you_mean(name, port_ids(*kind));
}

// What one field of a table names, and why that is not there; empty where it is. `node` is the node or link that the row names,
// if any.
std::string why_not_there(const Scene& scene, const ColumnDefinition& column, const std::string& name, const std::string& node,
                          const Registry& registry) {
  if (column.names == NameOf::node && !scene.nodes.contains(name) && !scene.links.contains(name))
    return "there is no node `" + name + "`" + did_you_mean_among(name, scene.nodes);
  if (column.names == NameOf::command && registry.command(name) == nullptr)
    return "unknown command `" + name + "`" + did_you_mean(name, keys_of(registry.commands()));
  if (column.names != NameOf::port) return "";
  if (const auto link = scene.links.find(node); link != scene.links.end() && !scene.nodes.contains(node))
    return why_no_part_of_link(link->second, name, scene.scripts.types(registry));
  const auto path = parse_port_path(name);
  if (!path) return "expects a port written `typification.port`, found `" + name + "`";
  if (const auto found = registry.port(*path); !found) return found.error().message;
  const auto named = scene.nodes.find(node);
  if (named == scene.nodes.end() || path->typification == kBaseNode || named->second.types.contains(path->typification))
    return "";
  return "the node `" + node + "` is not a `" + path->typification + "`, and has no such port";
}

// How far a number of a scene can be set at all.
struct Reach {
  double least = 0, most = 1;
  Unit unit = Unit::none;
  std::string what;
};

// Of a port of a node, or of a link its strength or a parameter. Nothing where it is not there, or holds no number.
std::optional<Reach> reach_of(const Scene& scene, const std::string& node, const std::string& name, const Registry& registry) {
  const PortDefinition* port = nullptr;
  if (const auto link = scene.links.find(node); link != scene.links.end() && !scene.nodes.contains(node)) {
    if (name == "strength") return Reach{.what = "the strength of a link"};
    const LinkDefinition* kind = scene.scripts.types(registry).link(link->second.kind);
    if (kind != nullptr) port = kind->find_port(name);
  } else if (const auto path = parse_port_path(name)) {
    if (const auto found = registry.port(*path)) port = *found;
  }
  if (port == nullptr || (port->kind != ValueKind::number && port->kind != ValueKind::integer)) return std::nullopt;
  return Reach{port->hard_minimum, port->hard_maximum, port->unit, "`" + name + "`"};
}

// Of a table whose rows name ports, such as a role card: how far the port of the row may be set.
bool is_bound(const ColumnDefinition& column) { return !column.is_text && (column.id == "minimum" || column.id == "maximum"); }

// Whoever sets what a row allows and the port does not is refused, in the middle of a session.
std::string why_beyond(const Reach& reach, double bound) {
  const auto words = [&](double number) {
    const std::string_view unit = info(reach.unit).pretty;
    return shortest(number) + (unit.empty() ? "" : " " + std::string(unit));
  };
  if (bound > reach.most)
    return "allows " + words(bound) + ", but " + reach.what + " goes to " + words(reach.most) + " only: what is above is refused";
  if (bound < reach.least)
    return "allows " + words(bound) + ", but " + reach.what + " begins at " + words(reach.least) + ": what is below is refused";
  return "";
}

// Rows stay when what they name goes: a name of nothing is told and refuses no file.
void check_table(const Scene& scene, const PortDefinition& port, const Table& table, const std::string& place,
                 const Registry& registry, std::vector<Problem>& problems) {
  const auto column_of = [&](NameOf names) {
    return std::find_if(port.columns.begin(), port.columns.end(), [&](const auto& column) { return column.names == names; });
  };
  const auto node = column_of(NameOf::node), named = column_of(NameOf::port);
  for (std::size_t row = 0; row < table.rows.size(); ++row)
    for (const ColumnDefinition& column : port.columns) {
      const std::string field = place + "/" + std::to_string(row) + "/" + column.id;
      const std::string of_row = node == port.columns.end() ? std::string() : table.text(row, node->id);
      if (is_bound(column) && named != port.columns.end())
        if (const auto reach = reach_of(scene, of_row, table.text(row, named->id), registry))
          if (std::string why = why_beyond(*reach, table.number(row, column.id)); !why.empty())
            problems.push_back({false, {ErrorCode::out_of_range, field, std::move(why)}});
      if (column.names == NameOf::nothing) continue;
      const std::string& name = table.text(row, column.id);
      if (name.empty()) continue;
      if (std::string why = why_not_there(scene, column, name, of_row, registry); !why.empty())
        problems.push_back({false, {ErrorCode::not_found, field, std::move(why)}});
    }
}

void check_node(const Scene& scene, const std::string& id, const NodeRecord& node, const Registry& registry,
                std::vector<Problem>& problems) {
  for (const auto& [type_id, text] : node.ghosts)
    problems.push_back({false,
                        {ErrorCode::unknown_type, "nodes/" + id + "/" + type_id,
                         "unknown typification `" + type_id + "`: kept as it is and saved back, not run" +
                             did_you_mean(type_id, keys_of(registry.typifications()))}});
  for (const auto& [type_id, values] : node.types) {
    const TypificationDefinition* type = registry.typification(type_id);
    if (type == nullptr) continue;
    for (const auto& [port, value] : values) {
      const std::string place = "nodes/" + id + "/" + type_id + "/" + port;
      if (const auto* selection = std::get_if<Shared<Selection>>(&value))
        check_selection(scene, **selection, place, registry, problems);
      const PortDefinition* definition = type->find_port(port);
      if (const auto* table = std::get_if<Shared<Table>>(&value); table != nullptr && definition != nullptr)
        check_table(scene, *definition, **table, place, registry, problems);
      if (definition != nullptr && definition->kind == ValueKind::port) {
        const auto path = parse_port_path(std::get<std::string>(value));
        if (path && !(path->typification == kBaseNode && path->port == "id"))
          if (const auto found = registry.port(*path); !found)
            // A port of an unknown typification may come back with it; a misspelt one of a known typification is a mistake.
            problems.push_back({found.error().code != ErrorCode::unknown_type, found.error().within(place)});
      }
    }
  }
  for (const std::string& path : node.locked) {
    const auto parsed = parse_port_path(path);
    if (parsed && node.ghosts.contains(parsed->typification)) continue;  // kept with its ghost
    const bool is_there = parsed && node.types.contains(parsed->typification) && registry.port(*parsed).ok();
    if (!is_there)
      problems.push_back({true, {ErrorCode::not_found, "nodes/" + id + "/locked", "the node has no port `" + path + "`"}});
  }
}

// A node that says for itself what a setting of the scene says as well, such as where it lies on Earth, should say the same.
void check_settings(const Scene& scene, const std::string& id, const NodeRecord& node, const TypificationDefinition& type,
                    std::vector<Problem>& problems) {
  const PortValues& said = node.types.at(type.id);
  for (const PortDefinition& port : type.ports) {
    if (port.of_scene != OfScene::unless_set || port.kind != ValueKind::number || !said.contains(port.id)) continue;
    const auto setting = scene.settings.find(port.id);
    if (setting == scene.settings.end()) continue;
    const double own = as_number(set_value(scene, node, type, port)), of_all = as_number(setting->second);
    if (std::abs(own - of_all) <= port.setting_tolerance) continue;
    const std::string unit(info(port.unit).pretty);
    problems.push_back({false,
                        {ErrorCode::conflict, "nodes/" + id + "/" + type.id + "/" + port.id,
                         "is " + shortest(own) + unit + ", and the setting `" + port.id + "` of the scene is " +
                             shortest(of_all) + unit + ": make them one, unless the node is to tell of another place"}});
  }
}

}  // namespace

std::vector<Problem> check_scene(const Scene& scene, const Registry& registry) {
  std::vector<Problem> problems;
  for (const auto& [id, node] : scene.nodes) {
    check_node(scene, id, node, registry, problems);
    for (const auto& [type_id, values] : node.types)
      if (const TypificationDefinition* type = registry.typification(type_id)) check_settings(scene, id, node, *type, problems);
  }
  for (const auto& [id, link] : scene.links) {
    check_selection(scene, link.from, "links/" + id + "/from", registry, problems);
    check_selection(scene, link.to, "links/" + id + "/to", registry, problems);
  }
  for (const auto& [name, error] : scene.scripts.errors()) problems.push_back({false, error.within("scripts/" + name)});
  const bool has_errors = std::any_of(problems.begin(), problems.end(), [](const Problem& p) { return p.is_error; });
  if (has_errors) return problems;
  const auto plan = compile(scene, registry);
  for (const LinkPlan& link : plan->links)
    if (link.error) problems.push_back({false, *link.error});
  for (const SetPlan& set : plan->sets)
    if (set.error) problems.push_back({false, *set.error});
  return problems;
}

}  // namespace bl
