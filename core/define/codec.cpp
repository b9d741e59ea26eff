// The JSON codec of values: one function for each kind, picked by the declaration.
#include "core/define/codec.h"

#include <algorithm>
#include <cmath>

#include <nlohmann/json.hpp>

#include "core/base/text.h"
#include "core/define/list_json.h"

namespace bl {

namespace {

std::string shown(const Json& json) {
  std::string text = write_json_line(json);
  return text.size() > 60 ? text.substr(0, 57) + "..." : text;
}

std::string in_unit(Unit unit) {
  const UnitInfo& row = info(unit);
  return row.pretty.empty() ? "" : " in " + std::string(row.pretty);
}

Error wrong_kind(const PortDefinition& port, const Json& json, const std::string& place) {
  std::string hint;
  if (json.is_string() && port.kind == ValueKind::number) {
    const std::string& text = json.get_ref<const std::string&>();
    if (const auto quantity = parse_quantity(text, port.unit); quantity)
      return {ErrorCode::wrong_kind, place,
              "expects a number" + in_unit(port.unit) + ", found the text " + shown(json) + "; write " + shortest(*quantity)};
    std::size_t number_end = text.size();
    while (number_end > 0 && !parse_number(text.substr(0, number_end))) --number_end;
    const std::size_t symbol = number_end == 0 ? std::string::npos : text.find_first_not_of(' ', number_end);
    const UnitInfo* found = symbol == std::string::npos ? nullptr : find_unit(text.substr(symbol));
    if (found != nullptr)
      return {ErrorCode::wrong_unit, place,
              "expects a number" + in_unit(port.unit) + ", found " + shown(json) + ", which is in " + std::string(found->name) +
                  "s; convert it and write the plain number"};
  }
  return {ErrorCode::wrong_kind, place,
          "expects " + std::string(name_of(port.kind)) + (port.kind == ValueKind::number ? in_unit(port.unit) : "") + ", found " +
              shown(json)};
}

Result<Vector3> vector_from_json(const Json& json, const std::string& place) {
  if (!json.is_array() || json.size() != 3 || !json[0].is_number() || !json[1].is_number() || !json[2].is_number())
    return Error{ErrorCode::wrong_kind, place, "expects a point [x, y, z] in m, found " + shown(json)};
  const Vector3 v{json[0].get<double>(), json[1].get<double>(), json[2].get<double>()};
  if (!is_finite(v)) return Error{ErrorCode::not_finite, place, "the coordinates must be finite numbers"};
  return v;
}

Json vector_to_json(const Vector3& v) { return Json::array({v.x, v.y, v.z}); }

Result<Shared<std::vector<std::string>>> texts_from_json(const PortDefinition& port, const Json& json, const std::string& place) {
  if (!json.is_array()) return wrong_kind(port, json, place);
  std::vector<std::string> texts;
  for (const Json& text : json) {
    if (!text.is_string()) return wrong_kind(port, json, place);
    texts.push_back(text.get<std::string>());
  }
  return Shared<std::vector<std::string>>(std::move(texts));
}

Result<Shared<std::vector<Point3>>> points_from_json(const PortDefinition& port, const Json& json, const std::string& place) {
  if (!json.is_array()) return wrong_kind(port, json, place);
  std::vector<Point3> points;
  for (std::size_t i = 0; i < json.size(); ++i) {
    auto point = vector_from_json(json[i], place + "/" + std::to_string(i));
    if (!point) return point.error();
    points.push_back(*point);
  }
  return Shared<std::vector<Point3>>(std::move(points));
}

std::vector<std::string> column_ids(const PortDefinition& port) {
  std::vector<std::string> ids;
  for (const ColumnDefinition& column : port.columns) ids.push_back(column.id);
  return ids;
}

using ReadNumber = Result<Value> (*)(const PortDefinition&, const Json&, const std::string&);

Result<Scalar> field_from_json(const ColumnDefinition& column, const Json& json, const std::string& place, ReadNumber read) {
  if (column.is_text) {
    if (!json.is_string()) return Error{ErrorCode::wrong_kind, place, "expects a text, found " + shown(json)};
    return Scalar(json.get<std::string>());
  }
  PortDefinition port;
  if (column.list == ListOf::indices) {
    auto indices = indices_in(json);
    if (indices) return Scalar(std::move(*indices));
    return Error{ErrorCode::wrong_kind, place,
                 "expects a list of whole numbers from 0 to " + std::to_string(kLargestIndex) + ", found " + shown(json)};
  }
  port.kind = column.list == ListOf::numbers ? ValueKind::numbers : ValueKind::number;
  port.unit = column.unit;
  port.hard_minimum = column.minimum;
  port.hard_maximum = column.maximum;
  auto number = read(port, json, place);
  if (!number) return number.error();
  if (port.kind == ValueKind::numbers) return Scalar(std::get<Numbers>(std::move(*number)));
  return Scalar(std::get<double>(*number));
}

Result<TableRow> read_row(const PortDefinition& port, const std::vector<std::string>& columns, const Json& json,
                          const std::string& place, ReadNumber read) {
  if (!json.is_object())
    return Error{ErrorCode::wrong_kind, place, "expects a row {\"column\": value, ...}, found " + shown(json)};
  if (auto keys = check_keys(json, columns, place); !keys) return keys.error();
  TableRow row;
  for (const ColumnDefinition& column : port.columns) {
    const auto it = json.find(column.id);
    if (it == json.end()) {
      if (column.is_required) return Error{ErrorCode::missing, place, "the column `" + column.id + "` is missing"};
      row.push_back(column.default_value);
      continue;
    }
    auto field = field_from_json(column, *it, place + "/" + column.id, read);
    if (!field) return field.error();
    row.push_back(std::move(*field));
  }
  return row;
}

Result<Shared<Table>> table_from_json(const PortDefinition& port, const Json& json, const std::string& place, ReadNumber read) {
  if (!json.is_array()) return wrong_kind(port, json, place);
  Table table;
  table.columns = column_ids(port);
  for (std::size_t r = 0; r < json.size(); ++r) {
    auto row = read_row(port, table.columns, json[r], place + "/" + std::to_string(r), read);
    if (!row) return row.error();
    table.rows.push_back(std::move(*row));
  }
  return Shared<Table>(std::move(table));
}

// Kinds whose values look alike in JSON and in memory.
Result<Value> text_like(const PortDefinition& port, const Json& json, const std::string& place) {
  if (!json.is_string()) return wrong_kind(port, json, place);
  return Value(json.get<std::string>());
}

template <class T>
Result<Value> as_value(Result<T> result) {
  if (!result) return result.error();
  return Value(std::move(*result));
}

Result<Value> decode_kind(const PortDefinition& port, const Json& json, const std::string& place) {
  switch (port.kind) {
    case ValueKind::boolean:
      if (!json.is_boolean()) return wrong_kind(port, json, place);
      return Value(json.get<bool>());
    case ValueKind::integer:
      if (!json.is_number_integer() || (json.is_number_unsigned() && json.get<std::uint64_t>() > (1ull << 53)))
        return wrong_kind(port, json, place);
      return Value(json.get<std::int64_t>());
    case ValueKind::number:
      if (!json.is_number()) return wrong_kind(port, json, place);
      return Value(json.get<double>());
    case ValueKind::text:
    case ValueKind::choice:
    case ValueKind::port: return text_like(port, json, place);
    case ValueKind::json: return Value(JsonValue::of(json));
    case ValueKind::point: return as_value(vector_from_json(json, place));
    case ValueKind::points: return as_value(points_from_json(port, json, place));
    case ValueKind::texts: return as_value(texts_from_json(port, json, place));
    case ValueKind::selection: {
      auto selection = selection_from_json(json, place);
      if (!selection) return selection.error();
      return Value(Shared<Selection>(std::move(*selection)));
    }
    case ValueKind::table: return as_value(table_from_json(port, json, place, value_from_json));
    case ValueKind::numbers: {
      auto numbers = numbers_in(json);
      return numbers ? Result<Value>(Value(std::move(*numbers))) : wrong_kind(port, json, place);
    }
    case ValueKind::commands: return Error{ErrorCode::wrong_kind, place, "only commands hold commands"};
    case ValueKind::mesh:
    case ValueKind::made: break;
  }
  return Error{ErrorCode::wrong_kind, place, "meshes and made objects are computed and cannot be set"};
}

Result<Value> decode(const PortDefinition& port, const Json& json, const std::string& place) {
  auto value = decode_kind(port, json, place);
  if (value && !make_storable(*value)) return Error{ErrorCode::not_finite, place, "must be a finite number"};
  return value;
}

}  // namespace

Json selection_to_json(const Selection& selection) {
  if (selection.is_query()) {
    Json query = Json::object();
    if (!selection.typification.empty()) query["typification"] = selection.typification;
    if (!selection.tag.empty()) query["tag"] = selection.tag;
    return query;
  }
  if (selection.ids.size() == 1) return selection.ids.front();
  return selection.ids;
}

Result<Selection> selection_from_json(const Json& json, const std::string& place) {
  Selection selection;
  if (json.is_string()) {
    selection.ids.push_back(json.get<std::string>());
  } else if (json.is_array() && std::all_of(json.begin(), json.end(), [](const Json& id) { return id.is_string(); })) {
    for (const Json& id : json) selection.ids.push_back(id.get<std::string>());
    std::sort(selection.ids.begin(), selection.ids.end());
    selection.ids.erase(std::unique(selection.ids.begin(), selection.ids.end()), selection.ids.end());
  } else if (json.is_object()) {
    if (auto keys = check_keys(json, {"typification", "tag"}, place); !keys) return keys.error();
    for (const auto& [key, text] : json.items()) {
      if (!text.is_string() || text.get_ref<const std::string&>().empty())
        return Error{ErrorCode::wrong_kind, place + "/" + key, "expects a text, found " + shown(text)};
      (key == "tag" ? selection.tag : selection.typification) = text.get<std::string>();
    }
  } else {
    return Error{ErrorCode::wrong_kind, place,
                 "expects " + std::string(name_of(ValueKind::selection)) + ", found " + shown(json)};
  }
  return selection;
}

namespace {

template <class Names>
Result<void> check_keys_among(const Json& json, const Names& known, const std::string& place) {
  if (!json.is_object()) return {};
  for (const auto& [key, value] : json.get_ref<const Json::object_t&>())
    if (std::find(known.begin(), known.end(), key) == known.end())
      return Error{ErrorCode::unknown_field, place.empty() ? key : place + "/" + key,
                   "unknown field `" + key + "`" + did_you_mean(key, std::vector<std::string>(known.begin(), known.end()))};
  return {};
}

}  // namespace

Result<void> check_keys(const Json& json, const std::vector<std::string>& known, const std::string& place) {
  return check_keys_among(json, known, place);
}

Result<void> check_keys(const Json& json, std::initializer_list<std::string_view> known, const std::string& place) {
  return check_keys_among(json, known, place);
}

Json row_to_json(const PortDefinition& port, const TableRow& row) {
  const auto& columns = port.columns;
  Json object = Json::object();
  for (std::size_t c = 0; c < row.size() && c < columns.size(); ++c) {
    if (!columns[c].is_required && row[c] == columns[c].default_value) continue;
    object[columns[c].id] = field_to_json(row[c]);
  }
  return object;
}

Result<TableRow> row_from_json(const PortDefinition& port, const Json& json, const std::string& place) {
  return read_row(port, column_ids(port), json, place, value_from_json);
}

namespace {

Json table_to_json(const Table& table, const PortDefinition& port) {
  Json rows = Json::array();
  for (const TableRow& row : table.rows) rows.push_back(row_to_json(port, row));
  return rows;
}

}  // namespace

Json value_to_json(const Value& value, const PortDefinition& port) {
  if (const auto* payload = std::get_if<JsonValue>(&value)) {
    const auto json = payload->read();
    return json ? **json : Json();
  }
  if (const auto* flag = std::get_if<bool>(&value)) return *flag;
  if (const auto* integer = std::get_if<std::int64_t>(&value)) return *integer;
  if (const auto* number = std::get_if<double>(&value)) return *number;
  if (const auto* text = std::get_if<std::string>(&value)) return *text;
  if (const auto* vector = std::get_if<Vector3>(&value)) return vector_to_json(*vector);
  if (const auto* texts = std::get_if<Shared<std::vector<std::string>>>(&value)) return **texts;
  if (const auto* selection = std::get_if<Shared<Selection>>(&value)) return selection_to_json(**selection);
  if (const auto* table = std::get_if<Shared<Table>>(&value)) return table_to_json(**table, port);
  if (const auto* numbers = std::get_if<Numbers>(&value)) return **numbers;
  if (const auto* points = std::get_if<Shared<std::vector<Point3>>>(&value)) {
    Json list = Json::array();
    for (const Point3& p : **points) list.push_back(vector_to_json(p));
    return list;
  }
  return nullptr;
}

namespace {

bool is_within_reach(const Vector3& v) {
  return std::abs(v.x) <= kCoordinateLimit && std::abs(v.y) <= kCoordinateLimit && std::abs(v.z) <= kCoordinateLimit;
}

Error too_large(const std::string& place, double number) {
  return {ErrorCode::out_of_range, place, "must be between -1e15 and 1e15, found " + shortest(number)};
}

Error far_away(const std::string& place) {
  return {ErrorCode::out_of_range, place, "lies farther than 10 000 km from the origin; use local metric coordinates"};
}

}  // namespace

Result<void> check_value(const PortDefinition& port, const Value& value, const std::string& place) {
  if (!is_finite(value)) return Error{ErrorCode::not_finite, place, "must be a finite number"};
  if (const auto* point = std::get_if<Vector3>(&value); point && !is_within_reach(*point)) return far_away(place);
  if (const auto* points = std::get_if<Shared<std::vector<Point3>>>(&value))
    for (std::size_t i = 0; i < (*points)->size(); ++i)
      if (!is_within_reach((**points)[i])) return far_away(place + "/" + std::to_string(i));
  if (const auto* numbers = std::get_if<Numbers>(&value))
    if (const auto far =
            std::find_if((*numbers)->begin(), (*numbers)->end(), [](double x) { return std::abs(x) > kNumberLimit; });
        far != (*numbers)->end())
      return too_large(place + "/" + std::to_string(far - (*numbers)->begin()), *far);
  if (port.kind == ValueKind::number || port.kind == ValueKind::integer) {
    const double number = as_number(value);
    if (std::abs(number) > kNumberLimit) return too_large(place, number);
    if (number < port.hard_minimum || number > port.hard_maximum) {
      const std::string unit(info(port.unit).pretty.empty() ? "" : " " + std::string(info(port.unit).pretty));
      std::string range = std::isinf(port.hard_maximum) ? "at least " + shortest(port.hard_minimum)
                          : std::isinf(port.hard_minimum)
                              ? "at most " + shortest(port.hard_maximum)
                              : "between " + shortest(port.hard_minimum) + " and " + shortest(port.hard_maximum);
      return Error{ErrorCode::out_of_range, place, "must be " + range + unit + ", found " + shortest(number)};
    }
  }
  if (port.kind == ValueKind::choice) {
    std::vector<std::string> known;
    for (const ChoiceDefinition& choice : port.choices) known.push_back(choice.id);
    const auto& text = std::get<std::string>(value);
    if (std::find(known.begin(), known.end(), text) == known.end()) {
      std::string list;
      for (const std::string& choice : known) list += (list.empty() ? "`" : ", `") + choice + "`";
      return Error{ErrorCode::out_of_range, place, "`" + text + "` is none of " + list + did_you_mean(text, known)};
    }
  }
  if (port.kind == ValueKind::port && !parse_port_path(std::get<std::string>(value)) && !std::get<std::string>(value).empty())
    return Error{ErrorCode::wrong_kind, place,
                 "expects a port written `typification.port`, found `" + std::get<std::string>(value) + "`"};
  return {};
}

bool is_kept(const PortDefinition& port, const Value& value) {
  return port.is_required || port.keeps_default || value != port.default_value;
}

std::string why_unsettable(const PortDefinition& port) {
  if (port.of_scene == OfScene::always) return "`" + port.id + "` applies to the whole scene: set it in the scene's settings";
  return port.is_computed ? "`" + port.id + "` is computed and cannot be set" : "";
}

Result<Value> value_from_json(const PortDefinition& port, const Json& json, const std::string& place) {
  auto value = decode(port, json, place);
  if (!value) return value;
  if (auto check = check_value(port, *value, place); !check) return check.error();
  return value;
}

Result<Value> running_value_from_json(const PortDefinition& port, const Json& json, const std::string& place) {
  if (port.kind == ValueKind::table) {
    auto table = table_from_json(port, json, place, running_value_from_json);
    return table ? Result<Value>(Value(std::move(*table))) : Result<Value>(table.error());
  }
  const bool has_range = port.kind == ValueKind::number || port.kind == ValueKind::integer || port.kind == ValueKind::point ||
                         port.kind == ValueKind::points || port.kind == ValueKind::numbers;
  if (!has_range) return value_from_json(port, json, place);
  return decode(port, json, place);
}

namespace {

Error unknown_port(const TypeDefinition& type, const std::string& key, const std::string& place) {
  std::vector<std::string> settings;
  for (const PortDefinition& port : type.ports)
    if (!port.is_computed && port.of_scene != OfScene::always) settings.push_back(port.id);
  return {ErrorCode::unknown_field, place, "`" + type.id + "` has no `" + key + "`" + did_you_mean(key, settings)};
}

}  // namespace

Result<std::map<std::string, Value>> ports_from_json(const TypeDefinition& type, const Json& json, const std::string& place,
                                                     std::span<const std::string_view> beside) {
  if (!json.is_object()) return Error{ErrorCode::wrong_kind, place, "expects {\"port\": value, ...}, found " + shown(json)};
  std::map<std::string, Value> values;
  const auto is_beside = [&](const std::string& key) { return std::find(beside.begin(), beside.end(), key) != beside.end(); };
  for (const auto& [key, content] : json.get_ref<const Json::object_t&>()) {
    if (is_beside(key)) continue;
    const std::string here = place.empty() ? key : place + "/" + key;
    const PortDefinition* port = type.find_port(key);
    if (port == nullptr) return unknown_port(type, key, here);
    if (auto reason = why_unsettable(*port); !reason.empty()) return Error{ErrorCode::conflict, here, std::move(reason)};
    auto value = value_from_json(*port, content, here);
    if (!value) return value.error();
    if (is_kept(*port, *value)) values[key] = std::move(*value);
  }
  for (const PortDefinition& port : type.ports)
    if (port.is_required && !values.contains(port.id) && !is_beside(port.id))
      return Error{ErrorCode::missing, place, "`" + type.id + "` needs `" + port.id + "`"};
  return values;
}

Json ports_to_json(const TypeDefinition& type, const std::map<std::string, Value>& values) {
  Json json = Json::object();
  for (const PortDefinition& port : type.ports)
    if (const auto it = values.find(port.id); it != values.end() && is_kept(port, it->second))
      append_field(json, port.id) = value_to_json(it->second, port);
  return json;
}

}  // namespace bl
