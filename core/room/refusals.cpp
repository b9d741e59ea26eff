// Errors of the scene become one of the reasons that pages know.
#include "core/room/refusals.h"

#include <nlohmann/json.hpp>

#include "core/define/codec.h"

namespace bl::room {

Refusal refuse(Reason why, std::string place, std::string text, Json args) {
  return {why, std::move(place), std::move(text), JsonValue::of(std::move(args))};
}

Refusal refusal_of(Reason why, const Error& error) { return refuse(why, error.place, error.message); }

Refusal refusal_of_scene(const Error& error) {
  const bool is_gone = error.code == ErrorCode::not_found;
  const bool is_bad = error.code == ErrorCode::parse || error.code == ErrorCode::wrong_kind ||
                      error.code == ErrorCode::unknown_field || error.code == ErrorCode::unknown_type ||
                      error.code == ErrorCode::missing || error.code == ErrorCode::not_finite;
  const bool is_out_of_range = error.code == ErrorCode::out_of_range;
  return refusal_of(is_gone ? Reason::gone : is_bad ? Reason::bad : is_out_of_range ? Reason::range : Reason::conflict, error);
}

std::optional<std::int64_t> whole_number(const Json& object, const char* field, std::int64_t otherwise) {
  if (!object.is_object() || !object.contains(field)) return otherwise;
  const Json& value = object[field];
  if (!value.is_number_integer()) return std::nullopt;
  return value.get<std::int64_t>();
}

std::optional<Touch> touch_named(const std::string& key) {
  static constexpr std::string_view kParts[] = {"settings", "nodes", "links", "scripts"};
  const std::size_t slash = key.find('/');
  if (slash == std::string::npos) return std::nullopt;
  for (std::size_t k = 0; k < std::size(kParts); ++k) {
    if (key.compare(0, slash, kParts[k]) != 0) continue;
    const std::size_t next = key.find('/', slash + 1);
    Touch touch{static_cast<ScenePart>(k), key.substr(slash + 1, next == std::string::npos ? next : next - slash - 1), {}};
    if (next != std::string::npos) touch.path = key.substr(next + 1);
    return touch;
  }
  return std::nullopt;
}

namespace {

JsonValue json_of_port(const PortValues& values, const PortDefinition& port) {
  const auto set = values.find(port.id);
  return JsonValue::of(value_to_json(set == values.end() ? port.default_value : set->second, port));
}

std::optional<JsonValue> value_of_node(const NodeRecord& node, const Registry& registry, const std::string& path) {
  if (path == "name") return JsonValue::of(node.name);
  if (path.starts_with("locked/")) return JsonValue::of(node.locked.contains(path.substr(7)));
  if (!path.starts_with("types/")) return std::nullopt;
  const std::string rest = path.substr(6);
  const std::size_t slash = rest.find('/');
  const auto type = node.types.find(rest.substr(0, slash));
  const TypificationDefinition* definition = registry.typification(rest.substr(0, slash));
  if (slash == std::string::npos || type == node.types.end() || definition == nullptr) return std::nullopt;
  const PortDefinition* port = definition->find_port(rest.substr(slash + 1));
  return port == nullptr || port->is_computed ? std::nullopt : std::optional(json_of_port(type->second, *port));
}

std::optional<JsonValue> value_of_link(const LinkRecord& link, const Registry& registry, const std::string& path) {
  if (path == "strength") return JsonValue::of(link.strength);
  const LinkDefinition* kind = registry.link(link.kind);
  const PortDefinition* port = path.starts_with("parameters/") && kind != nullptr ? kind->find_port(path.substr(11)) : nullptr;
  return port == nullptr ? std::nullopt : std::optional(json_of_port(link.parameters, *port));
}

}  // namespace

std::optional<JsonValue> value_at(const Scene& scene, const Registry& registry, const Touch& place) {
  if (place.part == ScenePart::node) {
    const auto node = scene.nodes.find(place.id);
    return node == scene.nodes.end() ? std::nullopt : value_of_node(node->second, registry, place.path);
  }
  if (place.part == ScenePart::link) {
    const auto link = scene.links.find(place.id);
    return link == scene.links.end() ? std::nullopt : value_of_link(link->second, scene.scripts.types(registry), place.path);
  }
  const PortDefinition* setting = place.part == ScenePart::setting ? settings_type().find_port(place.id) : nullptr;
  return setting == nullptr ? std::nullopt : std::optional(json_of_port(scene.settings, *setting));
}

namespace {

const std::string* vote_of(const Command& cast_vote) {
  const auto node = cast_vote.arguments.find("node");
  return node == cast_vote.arguments.end() ? nullptr : std::get_if<std::string>(&node->second);
}

}  // namespace

std::optional<Refusal> why_no_ballot(const RoomState& state, const Command& cast_vote) {
  const std::string* vote = vote_of(cast_vote);
  if (vote != nullptr && state.votes.contains(*vote)) return std::nullopt;
  return refuse(Reason::closed, "node", "this vote is not open");
}

bool is_secret(const RoomState& state, const Command& cast_vote) { return state.votes.at(*vote_of(cast_vote)).is_secret; }

}  // namespace bl::room
