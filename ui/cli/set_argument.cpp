// Reads what people type after --set.
#include "ui/cli/set_argument.h"

#include <cmath>

#include <nlohmann/json.hpp>

#include "core/base/text.h"
#include "core/define/json_text.h"

namespace bl::cli {

namespace {

bool holds_text(ValueKind kind) { return kind == ValueKind::text || kind == ValueKind::choice || kind == ValueKind::port; }

// The unit that a scene gives to a port; a node that is not there is left to the command to complain about.
Unit unit_at(const Scene& scene, const Registry& registry, const std::string& node, const PortPath& path,
             const PortDefinition& port) {
  const auto record = scene.nodes.find(node);
  const TypificationDefinition* type = registry.typification(path.typification);
  return record == scene.nodes.end() || type == nullptr ? port.unit : unit_of(registry, record->second, *type, port);
}

Result<std::string> value_text(const PortDefinition& port, Unit unit, const std::string& text, const std::string& place) {
  const bool is_number = port.kind == ValueKind::number || port.kind == ValueKind::integer;
  if (is_number)
    if (const auto quantity = parse_quantity(text, unit)) {
      // Beyond that a number has no place for halves, and soon none in an integer.
      const bool is_whole = std::abs(*quantity) < 9e15 && std::floor(*quantity) == *quantity;
      return port.kind == ValueKind::integer && is_whole ? std::to_string(static_cast<long long>(*quantity))
                                                         : shortest(*quantity);
    }
  if (auto json = parse_json(text); json && !(holds_text(port.kind) && !json->is_string() && !json->is_null()))
    return write_json_line(*json);
  if (holds_text(port.kind)) return write_json_line(Json(text));
  if (is_number) {
    const std::string_view pretty = info(unit).pretty;
    return Error{
        ErrorCode::wrong_unit, place,
        "`" + text + "` is no number" + (pretty.empty() ? "" : " or quantity in " + std::string(pretty) + " or its multiples")};
  }
  return Error{ErrorCode::parse, place,
               "`" + text + "` is no value of the kind " + std::string(name_of(port.kind)) + "; write it as in a scene file"};
}

}  // namespace

Result<Command> set_command(const Scene& scene, const Registry& registry, const std::string& argument) {
  const std::size_t slash = argument.find('/'), equals = argument.find('=');
  if (slash == std::string::npos || equals == std::string::npos || slash > equals || slash == 0)
    return Error{ErrorCode::parse, "--set", "expects NODE/TYPIFICATION.PORT=VALUE, found `" + argument + "`"};
  const std::string node = argument.substr(0, slash), port_text = argument.substr(slash + 1, equals - slash - 1);
  const std::string place = "--set " + argument.substr(0, equals);
  const auto path = parse_port_path(port_text);
  if (!path)
    if (const auto link = scene.links.find(node); link != scene.links.end()) {
      const LinkDefinition* kind = scene.scripts.types(registry).link(link->second.kind);
      if (kind == nullptr) return Error{ErrorCode::unknown_type, place, "the link is of the unknown kind `" + link->second.kind + "`"};
      const PortDefinition* parameter = kind->find_port(port_text);
      if (parameter == nullptr)
        return Error{ErrorCode::unknown_field, place, "`" + kind->id + "` has no `" + port_text + "`" + did_you_mean(port_text, port_ids(*kind))};
      auto value = value_text(*parameter, parameter->unit, argument.substr(equals + 1), place);
      if (!value) return value.error();
      return command<SetLinkParameter>({node, port_text, {*value}});
    }
  if (!path) return Error{ErrorCode::parse, "--set", "expects a port written TYPIFICATION.PORT, found `" + port_text + "`"};
  const auto port = registry.port(*path);
  if (!port) return port.error().within(place);
  auto value = value_text(**port, unit_at(scene, registry, node, *path, **port), argument.substr(equals + 1), place);
  if (!value) return value.error();
  return command<SetPort>({node, {port_text}, {*value}});
}

}  // namespace bl::cli
