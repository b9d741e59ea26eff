// The unit table, in one place.
#include "core/base/unit.h"

#include <cassert>
#include <vector>

#include "core/base/text.h"

namespace bl {

namespace {

constexpr Dimension kNumber{}, kLength{1}, kArea{2}, kVolume{3}, kPerLength{-1}, kTime{0, 1}, kAngle{0, 0, 1}, kSpeed{1, -1},
    kRate{0, -1}, kMoney{0, 0, 0, 1};

constexpr std::array kTable = {
    UnitInfo{Unit::none, "", "", "number", kNumber, 1},
    UnitInfo{Unit::ratio, "ratio", "", "ratio", kNumber, 1},
    UnitInfo{Unit::ratio, "%", "%", "per cent", kNumber, 0.01},
    UnitInfo{Unit::count, "count", "", "count", kNumber, 1},
    UnitInfo{Unit::metre, "m", "m", "metre", kLength, 1},
    UnitInfo{Unit::metre, "mm", "mm", "millimetre", kLength, 1e-3},
    UnitInfo{Unit::metre, "cm", "cm", "centimetre", kLength, 1e-2},
    UnitInfo{Unit::metre, "km", "km", "kilometre", kLength, 1e3},
    UnitInfo{Unit::square_metre, "m2", "m²", "square metre", kArea, 1},
    UnitInfo{Unit::square_metre, "ha", "ha", "hectare", kArea, 1e4},
    UnitInfo{Unit::square_metre, "km2", "km²", "square kilometre", kArea, 1e6},
    UnitInfo{Unit::cubic_metre, "m3", "m³", "cubic metre", kVolume, 1},
    UnitInfo{Unit::per_metre, "1/m", "1/m", "per metre", kPerLength, 1},
    UnitInfo{Unit::degree, "deg", "°", "degree", kAngle, 1},
    UnitInfo{Unit::second, "s", "s", "second", kTime, 1},
    UnitInfo{Unit::second, "min", "min", "minute", kTime, 60},
    UnitInfo{Unit::second, "h", "h", "hour", kTime, 3600},
    UnitInfo{Unit::metre_per_second, "m/s", "m/s", "metre per second", kSpeed, 1},
    UnitInfo{Unit::metre_per_second, "km/h", "km/h", "kilometre per hour", kSpeed, 1 / 3.6},
    UnitInfo{Unit::per_hour, "1/h", "1/h", "per hour", kRate, 1},
    UnitInfo{Unit::euro, "EUR", "€", "euro", kMoney, 1},
};

}  // namespace

std::span<const UnitInfo> unit_table() { return kTable; }

const UnitInfo& info(Unit unit) {
  for (const UnitInfo& row : kTable)
    if (row.unit == unit) return row;
  assert(false);
  return kTable[0];
}

const UnitInfo* find_unit(std::string_view symbol) {
  for (const UnitInfo& row : kTable)
    if (row.symbol == symbol || (row.pretty == symbol && !symbol.empty())) return &row;
  return nullptr;
}

// "; known are `m`, `m2`, ...": those in which values are kept.
static std::string kept_units() {
  std::string list;
  for (const UnitInfo& row : kTable)
    if (row.scale == 1 && !row.symbol.empty()) list += (list.empty() ? "; known are `" : ", `") + std::string(row.symbol) + "`";
  return list;
}

Result<const UnitInfo*> stored_unit(std::string_view symbol) {
  const UnitInfo* found = find_unit(symbol);
  const std::string text(symbol);
  if (found == nullptr) {
    std::vector<std::string> known;
    for (const UnitInfo& row : kTable) known.emplace_back(row.symbol);
    std::string help = did_you_mean(symbol, known);
    if (help.empty()) help = kept_units();
    return Error{ErrorCode::wrong_unit, "", "`" + text + "` is no unit that is known" + help};
  }
  if (found->scale == 1) return found;
  return Error{
      ErrorCode::wrong_unit, "",
      "values are not kept in `" + text + "`: write `" + std::string(info(found->unit).symbol) + "`, and the numbers in it"};
}

bool same_dimension(Unit a, Unit b) { return info(a).dimension == info(b).dimension; }

std::optional<double> parse_quantity(std::string_view text, Unit expected) {
  while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
  while (!text.empty() && text.back() == ' ') text.remove_suffix(1);
  std::size_t split = text.size();
  // The number is the longest prefix that reads as one; "1e3 m" must not stop at the e.
  while (split > 0 && !parse_number(text.substr(0, split))) --split;
  if (split == 0) return std::nullopt;
  const double number = *parse_number(text.substr(0, split));
  std::string_view symbol = text.substr(split);
  while (!symbol.empty() && symbol.front() == ' ') symbol.remove_prefix(1);
  if (symbol.empty()) return number;
  const UnitInfo* unit = find_unit(symbol);
  if (unit == nullptr || !(unit->dimension == info(expected).dimension)) return std::nullopt;
  return number * unit->scale;
}

}  // namespace bl
