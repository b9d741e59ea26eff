// Schemas by kind of value, put together for types and scenes.
#include "core/define/schema.h"

#include <algorithm>
#include <cmath>

#include <nlohmann/json.hpp>

#include "core/define/codec.h"

namespace bl {

namespace {

Json number_schema(double minimum, double maximum) {
  return {{"type", "number"}, {"minimum", std::max(minimum, -kNumberLimit)}, {"maximum", std::min(maximum, kNumberLimit)}};
}

Json point_schema() {
  const Json coordinate = {{"type", "number"}, {"minimum", -kCoordinateLimit}, {"maximum", kCoordinateLimit}};
  return {{"type", "array"}, {"items", coordinate}, {"minItems", 3}, {"maxItems", 3}};
}

Json text_schema() { return {{"type", "string"}}; }

Json selection_schema(bool may_be_empty) {
  Json list = {{"type", "array"}, {"items", text_schema()}};
  Json query = {
      {"type", "object"},
      {"properties", {{"typification", {{"type", "string"}, {"minLength", 1}}}, {"tag", {{"type", "string"}, {"minLength", 1}}}}},
      {"additionalProperties", false}};
  if (!may_be_empty) {
    list["minItems"] = 1;
    query["minProperties"] = 1;
  }
  return {{"anyOf", Json::array({text_schema(), list, query})}};
}

Json numbers_schema(double minimum, double maximum) { return {{"type", "array"}, {"items", number_schema(minimum, maximum)}}; }

Json column_schema(const ColumnDefinition& column) {
  if (column.is_text) return text_schema();
  if (column.list == ListOf::indices) {
    Json schema = numbers_schema(0, kLargestIndex);
    schema["items"]["type"] = "integer";
    return schema;
  }
  return column.list == ListOf::numbers ? numbers_schema(-kNumberLimit, kNumberLimit)
                                        : number_schema(column.minimum, column.maximum);
}

Json table_schema(const PortDefinition& port) {
  Json properties = Json::object(), required = Json::array();
  for (const ColumnDefinition& column : port.columns) {
    properties[column.id] = column_schema(column);
    properties[column.id]["description"] = column.doc;
    if (column.is_required) required.push_back(column.id);
  }
  Json row = {{"type", "object"}, {"properties", properties}, {"additionalProperties", false}};
  if (!required.empty()) row["required"] = required;
  return {{"type", "array"}, {"items", row}};
}

Json form_of(const PortDefinition& port) {
  switch (port.kind) {
    case ValueKind::boolean: return {{"type", "boolean"}};
    case ValueKind::integer: {
      Json schema = number_schema(port.hard_minimum, port.hard_maximum);
      schema["type"] = "integer";
      return schema;
    }
    case ValueKind::number: return number_schema(port.hard_minimum, port.hard_maximum);
    case ValueKind::text: return text_schema();
    case ValueKind::choice: {
      Json choices = Json::array();
      for (const ChoiceDefinition& choice : port.choices) choices.push_back(choice.id);
      return {{"enum", choices}};
    }
    case ValueKind::port: return {{"type", "string"}, {"pattern", "^([^.]+\\..+)?$"}};
    case ValueKind::json: return Json::object();
    case ValueKind::point: return point_schema();
    case ValueKind::points: return {{"type", "array"}, {"items", point_schema()}};
    case ValueKind::texts: return {{"type", "array"}, {"items", text_schema()}};
    case ValueKind::selection: return selection_schema(true);
    case ValueKind::table: return table_schema(port);
    case ValueKind::numbers: return numbers_schema(-kNumberLimit, kNumberLimit);
    case ValueKind::mesh:
    case ValueKind::made: return {{"not", Json::object()}};
    case ValueKind::commands:
      return {{"type", "array"},
              {"items",
               {{"type", "object"},
                {"properties", {{"command", text_schema()}, {"arguments", {{"type", "object"}}}}},
                {"required", {"command"}},
                {"additionalProperties", false}}}};
  }
  return Json::object();
}

Json settings_properties(const TypeDefinition& type) {
  Json properties = Json::object();
  for (const PortDefinition& port : type.ports)
    if (!port.is_computed && port.of_scene != OfScene::always) properties[port.id] = value_schema(port);
  return properties;
}

Json values_schema(const TypeDefinition& type) {
  return {{"title", type.label},
          {"description", type.doc},
          {"type", "object"},
          {"properties", settings_properties(type)},
          {"additionalProperties", false}};
}

Json id_schema() { return {{"type", "string"}, {"pattern", "^[a-z0-9][a-z0-9_.#-]{0,63}$"}}; }

// Old ids of a type are accepted as well.
template <class Definition>
std::vector<std::string> names_of(const Definition& type) {
  std::vector<std::string> names{type.id};
  names.insert(names.end(), type.aliases.begin(), type.aliases.end());
  return names;
}

Json node_schema(const Registry& registry) {
  Json types = Json::object();
  for (const auto& [id, type] : registry.typifications())
    if (id != kBaseNode)
      for (const std::string& name : names_of(type)) types[name] = {{"$ref", "#/$defs/typification." + id}};
  types[std::string(kBaseNode)] = false;
  Json properties = {{"id", id_schema()}, {"name", text_schema()}};
  properties.update(settings_properties(*registry.typification(kBaseNode)));
  properties["types"] = {{"type", "object"}, {"properties", types}, {"additionalProperties", {{"type", "object"}}}};
  properties["locked"] = {{"type", "array"}, {"items", text_schema()}};
  return {{"type", "object"}, {"properties", properties}, {"required", {"id"}}, {"additionalProperties", false}};
}

Json script_schema() {
  return {{"type", "object"},
          {"properties", {{"id", id_schema()}, {"lines", {{"type", "array"}, {"items", text_schema()}, {"minItems", 1}}}}},
          {"required", {"id", "lines"}},
          {"additionalProperties", false}};
}

// A known kind must have the full form; a link of another kind is kept as it is.
Json link_schema(const Registry& registry) {
  Json known = Json::array(), cases = Json::array();
  for (const auto& [id, kind] : registry.links()) {
    for (const std::string& name : names_of(kind)) known.push_back(name);
    cases.push_back({{"if", {{"properties", {{"kind", {{"enum", names_of(kind)}}}}}, {"required", {"kind"}}}},
                     {"then", {{"properties", {{"parameters", {{"$ref", "#/$defs/link." + id}}}}}}}});
  }
  const Json full = {{"properties",
                      {{"id", true},
                       {"kind", true},
                       {"from", selection_schema(false)},
                       {"to", selection_schema(false)},
                       {"strength", number_schema(0, 1)},
                       {"enabled", {{"type", "boolean"}}},
                       {"muted", {{"type", "boolean"}}},
                       {"parameters", true}}},
                     {"required", {"from", "to"}},
                     {"additionalProperties", false}};
  cases.push_back({{"if", {{"properties", {{"kind", {{"enum", known}}}}}, {"required", {"kind"}}}}, {"then", full}});
  return {{"type", "object"},
          {"properties", {{"id", id_schema()}, {"kind", text_schema()}}},
          {"required", {"id", "kind"}},
          {"allOf", cases}};
}

}  // namespace

Json value_schema(const PortDefinition& port) {
  Json schema = form_of(port);
  std::string text = port.doc;
  if (const UnitInfo& unit = info(port.unit); !unit.symbol.empty()) text += " [" + std::string(unit.symbol) + "]";
  schema["description"] = text;
  if (!is_derived(port.kind) && !port.is_required) schema["default"] = value_to_json(port.default_value, port);
  return schema;
}

Json scene_schema(const Registry& registry, const TypeDefinition& settings, int version) {
  Json definitions = Json::object();
  for (const auto& [id, type] : registry.typifications())
    if (id != kBaseNode) definitions["typification." + id] = values_schema(type);
  for (const auto& [id, kind] : registry.links()) definitions["link." + id] = values_schema(kind);
  const Json tick = {{"type", "integer"}, {"minimum", 0}, {"maximum", std::int64_t{1} << 53}};
  const Json object = {{"type", "object"}};
  const Json objects = {{"type", "object"}, {"additionalProperties", object}};
  const Json state = {{"type", "object"},
                      {"properties",
                       {{"check", {{"type", "string"}}},
                        {"tick", tick},
                        {"calm", tick},
                        {"nodes", objects},
                        {"voices", objects},
                        {"held", objects},  // of older files
                        {"errors", objects},
                        {"link_errors", objects},
                        {"analyses", objects},
                        {"meshes", objects}}},
                      {"additionalProperties", false}};
  const Json properties = {{"format", {{"const", "behaviourlinks"}}},
                           {"version", {{"type", "integer"}, {"minimum", 1}, {"maximum", version}}},
                           {"revisions", {{"type", "object"}, {"additionalProperties", {{"type", "integer"}, {"minimum", 1}}}}},
                           {"settings", values_schema(settings)},
                           {"scripts", {{"type", "array"}, {"items", script_schema()}}},
                           {"nodes", {{"type", "array"}, {"items", node_schema(registry)}}},
                           {"links", {{"type", "array"}, {"items", link_schema(registry)}}},
                           {"state", state},
                           {"view", object}};
  return {{"$schema", "https://json-schema.org/draft/2020-12/schema"},
          {"title", "BehaviourLinks scene"},
          {"type", "object"},
          {"required", {"format", "version"}},
          {"properties", properties},
          {"additionalProperties", false},
          {"$defs", definitions}};
}

}  // namespace bl
