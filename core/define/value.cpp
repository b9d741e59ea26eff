// Finite-checks, hashing and table look-ups of values.
#include "core/define/value.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/define/command_builder.h"

namespace bl {

std::size_t Table::column(std::string_view name) const {
  return static_cast<std::size_t>(std::find(columns.begin(), columns.end(), name) - columns.begin());
}

std::size_t Table::row_of(std::string_view column_name, std::string_view content) const {
  std::size_t row = 0;
  while (row < rows.size() && text(row, column_name) != content) ++row;
  return row;
}

template <class T>
const T& Table::field(std::size_t row, std::string_view name) const {
  static const T kNothing{};
  const std::size_t c = column(name);
  if (row >= rows.size() || c >= rows[row].size()) return kNothing;
  const T* content = std::get_if<T>(&rows[row][c]);
  return content ? *content : kNothing;
}

double Table::number(std::size_t row, std::string_view name) const { return field<double>(row, name); }
const std::string& Table::text(std::size_t row, std::string_view name) const { return field<std::string>(row, name); }
const Numbers& Table::numbers(std::size_t row, std::string_view name) const { return field<Numbers>(row, name); }
const Indices& Table::indices(std::size_t row, std::string_view name) const { return field<Indices>(row, name); }

bool is_same_content(const Value& a, const Value& b) { return std::operator==(a, b); }

std::vector<Value> copied(const std::vector<Value>& values) {
  std::vector<Value> copies;
  copies.reserve(values.size());
  for (const Value& value : values) {
    if (const auto* number = std::get_if<double>(&value)) copies.emplace_back(std::in_place_type<double>, *number);
    else if (const auto* text = std::get_if<std::string>(&value)) copies.emplace_back(std::in_place_type<std::string>, *text);
    else if (const auto* flag = std::get_if<bool>(&value)) copies.emplace_back(std::in_place_type<bool>, *flag);
    else copies.push_back(value);
  }
  return copies;
}

std::string_view name_of(ValueKind kind) {
  switch (kind) {
    case ValueKind::boolean: return "true or false";
    case ValueKind::integer: return "a whole number";
    case ValueKind::number: return "a number";
    case ValueKind::text: return "a text";
    case ValueKind::choice: return "one of its choices";
    case ValueKind::port: return "a port written `typification.port`";
    case ValueKind::json: return "a JSON object";
    case ValueKind::commands: return "a list of commands";
    case ValueKind::point: return "a point [x, y, z]";
    case ValueKind::points: return "a list of points [[x, y, z], ...]";
    case ValueKind::texts: return "a list of texts";
    case ValueKind::selection: return "a node id, a list of node ids, or {\"typification\": ..., \"tag\": ...}";
    case ValueKind::table: return "a list of rows";
    case ValueKind::mesh: return "a mesh";
    case ValueKind::numbers: return "a list of numbers";
    case ValueKind::made: return "a made object";
  }
  return "a value";
}

bool is_derived(ValueKind kind) { return kind == ValueKind::mesh || kind == ValueKind::made; }

bool is_proposable(ValueKind kind) { return kind == ValueKind::number || kind == ValueKind::point || kind == ValueKind::texts; }

namespace {

double number_of(const Numbers& numbers) { return numbers.is_finite() ? 0 : std::numeric_limits<double>::infinity(); }

double number_of(const Scalar& field) {
  if (const double* number = std::get_if<double>(&field)) return *number;
  const Numbers* numbers = std::get_if<Numbers>(&field);
  return numbers ? number_of(*numbers) : 0;
}

// Shows `see` every number in a value that a run may keep, until it says no. Meshes and made objects are not among them: they
// follow from the rest. Lists have looked at theirs before: of one that is not finite, `see` is shown infinity.
template <class See>
bool all_numbers(const Value& value, const See& see) {
  const auto see_point = [&](const Vector3& v) { return see(v.x) && see(v.y) && see(v.z); };
  if (const auto* number = std::get_if<double>(&value)) return see(*number);
  if (const auto* vector = std::get_if<Vector3>(&value)) return see_point(*vector);
  if (const auto* points = std::get_if<Shared<std::vector<Point3>>>(&value))
    return std::all_of((*points)->begin(), (*points)->end(), see_point);
  if (const auto* table = std::get_if<Shared<Table>>(&value)) {
    for (const auto& row : (*table)->rows)
      for (const Scalar& field : row)
        if (!see(number_of(field))) return false;
  }
  if (const auto* numbers = std::get_if<Numbers>(&value)) return see(number_of(*numbers));
  return true;
}

bool is_negative_zero(double number) { return number == 0 && std::signbit(number); }

void take_signs_off(double& number) { number = number == 0 ? 0.0 : number; }
void take_signs_off(Point3& point) {
  take_signs_off(point.x);
  take_signs_off(point.y);
  take_signs_off(point.z);
}

// Only what holds such a zero is copied: everything else stays shared.
void take_signs_off(Value& value) {
  if (auto* number = std::get_if<double>(&value)) return take_signs_off(*number);
  if (auto* vector = std::get_if<Vector3>(&value)) return take_signs_off(*vector);
  if (auto* points = std::get_if<Shared<std::vector<Point3>>>(&value)) {
    std::vector<Point3> plain = **points;
    for (Point3& point : plain) take_signs_off(point);
    *points = std::move(plain);
  } else if (auto* table = std::get_if<Shared<Table>>(&value)) {
    Table plain = **table;
    for (auto& row : plain.rows)
      for (Scalar& field : row)
        if (double* number = std::get_if<double>(&field)) take_signs_off(*number);
    *table = std::move(plain);
  }
}

}  // namespace

bool is_finite(const Value& value) {
  return all_numbers(value, [](double number) { return std::isfinite(number); });
}

bool make_storable(Value& value) {
  bool is_plain = true;
  const bool is_sound = all_numbers(value, [&](double number) {
    is_plain = is_plain && !is_negative_zero(number);
    return std::isfinite(number);
  });
  if (is_sound && !is_plain) take_signs_off(value);
  return is_sound;
}

namespace {

struct FieldAdder {
  Hash& hash;
  void operator()(double number) const { hash.add(number); }
  void operator()(const std::string& text) const { add_table_text(hash, text); }
  void operator()(const Numbers& numbers) const { numbers.add_to(hash); }
  void operator()(const Indices& indices) const { indices.add_to(hash); }
};

struct Adder {
  Hash& hash;
  void operator()(bool flag) const { hash.add(std::uint64_t{flag ? 1u : 0u}); }
  void operator()(std::int64_t number) const { hash.add(static_cast<std::uint64_t>(number)); }
  void operator()(double number) const { hash.add(number); }
  void operator()(const std::string& text) const { hash.add(std::string_view(text)); }
  void operator()(const Vector3& v) const { hash.add(v); }
  void operator()(const Shared<std::vector<Point3>>& points) const {
    hash.add(std::uint64_t{points->size()});
    for (const Point3& p : *points) hash.add(p);
  }
  void operator()(const Shared<std::vector<std::string>>& texts) const {
    hash.add(std::uint64_t{texts->size()});
    for (const std::string& text : *texts) hash.add(std::string_view(text));
  }
  void operator()(const Shared<Selection>& selection) const {
    hash.add(std::uint64_t{selection->ids.size()});
    for (const std::string& id : selection->ids) hash.add(std::string_view(id));
    hash.add(std::string_view(selection->typification));
    hash.add(std::string_view(selection->tag));
  }
  void operator()(const Shared<Table>& table) const {
    hash.add(std::uint64_t{table->rows.size()});
    for (const auto& row : table->rows)
      for (const Scalar& field : row) std::visit(FieldAdder{hash}, field);
  }
  void operator()(const MeshPointer&) const {}
  void operator()(const Numbers& numbers) const { numbers.add_to(hash); }
  void operator()(const Made&) const {}
  void operator()(const JsonValue& json) const { hash.add(std::string_view(json.text())); }
  void operator()(const CommandList& commands) const {
    hash.add(std::uint64_t{commands->size()});
    for (const Command& command : *commands) {
      hash.add(std::string_view(command.id));
      for (const auto& [name, value] : command.arguments) {
        hash.add(std::string_view(name));
        add_to(hash, value);
      }
    }
  }
};

}  // namespace

void add_to(Hash& hash, const Value& value) {
  if (std::holds_alternative<Made>(value)) return;
  hash.add(std::uint64_t{value.index()});
  // What most ports hold goes without a look into the table of a visit.
  const Adder add{hash};
  if (const auto* number = std::get_if<double>(&value)) return add(*number);
  if (const auto* text = std::get_if<std::string>(&value)) return add(*text);
  if (const auto* flag = std::get_if<bool>(&value)) return add(*flag);
  std::visit(add, value);
}

double as_number(const Value& value) {
  if (const auto* number = std::get_if<double>(&value)) return *number;
  if (const auto* integer = std::get_if<std::int64_t>(&value)) return static_cast<double>(*integer);
  if (const auto* flag = std::get_if<bool>(&value)) return *flag ? 1 : 0;
  return 0;
}

}  // namespace bl
