// Shared steps of the commands.
#include "core/session/support.h"

#include <algorithm>

#include <nlohmann/json.hpp>

#include "core/base/near_names.h"
#include "core/base/text.h"
#include "core/define/codec.h"

namespace bl {

JsonValue json_of(const Value& value, const PortDefinition& port) { return JsonValue::of(value_to_json(value, port)); }

Result<Value> argument_value(const TypeDefinition& type, const std::string& port_id, const JsonValue& json,
                             const std::string& place) {
  const PortDefinition* port = type.find_port(port_id);
  if (port == nullptr)
    return Error{ErrorCode::unknown_field, place,
                 "`" + type.id + "` has no `" + port_id + "`" + did_you_mean(port_id, port_ids(type))};
  if (auto reason = why_unsettable(*port); !reason.empty()) return Error{ErrorCode::conflict, place, std::move(reason)};
  const auto value = json.read();
  if (!value) return value.error().within(place);
  if ((*value)->is_null()) return port->default_value;
  return value_from_json(*port, **value, place);
}

Result<void> check_references(const SceneEdit& edit, const TypeDefinition& type, const PortValues& values,
                              const std::string& self, const std::string& place) {
  for (const auto& [id, value] : values) {
    const PortDefinition* port = type.find_port(id);
    if (const auto* selection = std::get_if<Shared<Selection>>(&value))
      for (const std::string& node : (*selection)->ids)
        if (node != self && !edit.scene().nodes.contains(node))
          return Error{ErrorCode::not_found, place + "/" + id,
                       "there is no node `" + node + "`" + did_you_mean_among(node, edit.scene().nodes)};
    if (port == nullptr || port->kind != ValueKind::port) continue;
    const auto path = parse_port_path(std::get<std::string>(value));
    if (!path || (path->typification == kBaseNode && path->port == "id")) continue;
    if (const auto found = edit.registry().port(*path); !found) return found.error().within(place + "/" + id);
  }
  return {};
}

void assign(PortValues& values, const PortDefinition& port, const Value& value) {
  if (is_kept(port, value)) values[port.id] = value;
  else values.erase(port.id);
}

JsonValue current_value(const PortValues& values, const PortDefinition& port) {
  const auto it = values.find(port.id);
  return it == values.end() ? JsonValue::null() : json_of(it->second, port);
}

Result<PortSite> find_setting(const SceneEdit& edit, const std::string& node_id, const PortChoice& choice) {
  auto node = edit.node(node_id);
  if (!node) return node.error();
  const std::string place = "nodes/" + node_id;
  const auto path = parse_port_path(choice.path);
  if (!path)
    return Error{ErrorCode::wrong_kind, place, "expects a port written `typification.port`, found `" + choice.path + "`"};
  const auto port = edit.registry().port(*path);
  if (!port) return port.error().within(place);
  const TypificationDefinition* type = edit.registry().typification(path->typification);
  if (!(*node)->types.contains(type->id))
    return Error{ErrorCode::conflict, place, "the node is not a `" + type->id + "`; typify it first"};
  if (auto reason = why_unsettable(**port); !reason.empty())
    return Error{ErrorCode::conflict, place + "/" + choice.path, std::move(reason)};
  return PortSite{*node, type, *port};
}

Result<void> check_selection(const Scene& scene, const Selection& selection, const std::string& place) {
  if (selection.is_empty()) return Error{ErrorCode::missing, place, "names no node"};
  for (const std::string& id : selection.ids)
    if (!scene.nodes.contains(id))
      return Error{ErrorCode::not_found, place, "there is no node `" + id + "`" + did_you_mean_among(id, scene.nodes)};
  return {};
}

bool drop(Selection& selection, const std::string& id) { return std::erase(selection.ids, id) > 0; }

Result<void> check_new_id(const std::string& id, bool is_taken, const std::string& place) {
  if (!is_identifier(id))
    return Error{ErrorCode::wrong_kind, place, "`" + id.substr(0, 80) + "` is no id: use 1 to 64 of a-z 0-9 _ - . #"};
  if (is_taken) return Error{ErrorCode::duplicate, place + "/" + id, "the id `" + id + "` is taken"};
  return {};
}

}  // namespace bl
