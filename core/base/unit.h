// Units: a symbol, a dimension and a scale to SI. Values inside the program are always SI.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "core/base/result.h"

namespace bl {

/// Exponents of the base dimensions length, time, angle and money.
struct Dimension {
  std::int8_t length = 0, time = 0, angle = 0, money = 0;
  bool operator==(const Dimension&) const = default;
};

/// The units that declarations use; each is the SI unit of its dimension, or a plain number.
enum class Unit {
  none,
  ratio,
  count,
  metre,
  square_metre,
  cubic_metre,
  per_metre,
  degree,
  second,
  metre_per_second,
  per_hour,
  euro
};

/// One row of the unit table.
struct UnitInfo {
  Unit unit;                ///< the SI unit that values are kept in
  std::string_view symbol;  ///< as typed and shown: "m2", "ha", "min"
  std::string_view pretty;  ///< as printed to people: "m²"
  std::string_view name;    ///< "square metre"
  Dimension dimension;
  double scale;  ///< value in SI = scale · value in this unit
};

/// All units and their everyday multiples (ha, cm, min, ...); the first row of a Unit is the unit itself.
std::span<const UnitInfo> unit_table();
const UnitInfo& info(Unit unit);
/// The row with that symbol, or nothing.
const UnitInfo* find_unit(std::string_view symbol);
/// The same for the unit of a stored value: an error where the symbol is unknown, or that of a multiple, such as `ha`.
Result<const UnitInfo*> stored_unit(std::string_view symbol);
/// Do quantities in the two units add up? Ratio, count and none do with each other.
bool same_dimension(Unit a, Unit b);
/// "12 m", "0.4 ha", "850": a quantity as typed by people, in SI; nothing where it is none or of another dimension.
std::optional<double> parse_quantity(std::string_view text, Unit expected);

}  // namespace bl
