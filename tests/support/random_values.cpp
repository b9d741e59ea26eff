// Random values by kind.
#include "tests/support/random_values.h"

#include <algorithm>
#include <cmath>

#include "core/define/registry.h"
#include "tests/support/world.h"

namespace bl {

namespace {

double random_number(double low, double high, std::optional<double> soft_low, std::optional<double> soft_high, Random& random) {
  low = std::max(low, -1e6);
  high = std::min(high, std::max(1e6, low));
  switch (random.below(8)) {
    case 0: return low;
    case 1: return high;
    case 2: return random.uniform(low, high);
    case 3: return std::clamp(0.0, low, high);
    default:
      return std::clamp(random.uniform(soft_low.value_or(std::max(low, -100.0)), soft_high.value_or(std::min(high, 100.0))), low,
                        high);
  }
}

Vector3 random_point(Random& random) {
  const double reach = random.below(10) == 0 ? 1e5 : 50;
  return {random.uniform(-reach, reach), random.uniform(-reach, reach), random.uniform(0, reach)};
}

std::string random_word(Random& random) {
  static const char* kWords[] = {"", "a", "b", "tower", "housing", "ä ö", "\"quoted\"", "a, b", "m2", "smart_volume.volume"};
  return kWords[random.below(std::size(kWords))];
}

Numbers random_numbers(Random& random) {
  std::vector<double> numbers(random.below(60));
  for (double& number : numbers) number = random_number(-1e15, 1e15, std::nullopt, std::nullopt, random);
  return numbers;
}

Indices random_indices(Random& random) {
  std::vector<std::uint32_t> indices(random.below(100));
  for (std::uint32_t& index : indices) index = static_cast<std::uint32_t>(random.below(kLargestIndex + 1));
  return indices;
}

// What the port's typification makes of random settings, now and then of none.
Value random_object(const PortDefinition& port, Random& random) {
  for (const auto& [id, type] : full_registry().typifications()) {
    const std::size_t place = type.port_index(port.id);
    if (place == type.ports.size() || !(type.ports[place].made == port.made)) continue;
    std::vector<Value> values;
    for (const PortDefinition& one : type.ports)
      values.push_back(one.is_computed || random.below(2) == 0 ? one.default_value : random_value(one, random));
    std::vector<SetValues> sets(type.sets.size());
    if (random.below(8) == 0 || !type.evaluate(values, sets, Tick{})) return port.default_value;
    make_objects(type, values, {});
    return values[place];
  }
  return Made();
}

Table random_table(const PortDefinition& port, Random& random) {
  Table table;
  for (const ColumnDefinition& column : port.columns) table.columns.push_back(column.id);
  for (std::uint64_t r = random.below(5); r > 0; --r) {
    auto& row = table.rows.emplace_back();
    for (const ColumnDefinition& column : port.columns)
      if (column.is_text) row.push_back(random_word(random));
      else if (column.list == ListOf::numbers) row.push_back(random_numbers(random));
      else if (column.list == ListOf::indices) row.push_back(random_indices(random));
      else row.push_back(random_number(column.minimum, column.maximum, std::nullopt, std::nullopt, random));
  }
  return table;
}

}  // namespace

Value random_value(const PortDefinition& port, Random& random) {
  switch (port.kind) {
    case ValueKind::boolean: return random.below(2) == 1;
    case ValueKind::integer:
      return static_cast<std::int64_t>(
          random_number(port.hard_minimum, port.hard_maximum, port.soft_minimum, port.soft_maximum, random));
    case ValueKind::number:
      return random_number(port.hard_minimum, port.hard_maximum, port.soft_minimum, port.soft_maximum, random);
    case ValueKind::choice: return port.choices[random.below(port.choices.size())].id;
    case ValueKind::port: return std::string(random.below(2) == 0 ? "smart_volume.volume" : "node.position");
    case ValueKind::json: return JsonValue();
    case ValueKind::commands: return CommandList();
    case ValueKind::text: return random_word(random);
    case ValueKind::point: return random_point(random);
    case ValueKind::points: {
      std::vector<Point3> points;
      for (std::uint64_t i = random.below(9); i > 0; --i) points.push_back(random_point(random));
      return Shared<std::vector<Point3>>(std::move(points));
    }
    case ValueKind::texts: return Shared<std::vector<std::string>>(std::vector<std::string>{random_word(random), "x"});
    case ValueKind::selection: return Shared<Selection>(Selection{{"a"}, "", ""});
    case ValueKind::table: return Shared<Table>(random_table(port, random));
    case ValueKind::mesh: return MeshPointer{};
    case ValueKind::numbers: return random_numbers(random);
    case ValueKind::made: return random_object(port, random);
  }
  return 0.0;
}

}  // namespace bl
