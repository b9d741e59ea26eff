// The unit table, and quantities as people type them.
#include "core/base/unit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <string>

namespace bl {
namespace {

TEST(Unit, EveryUnitHasItsOwnRowFirst) {
  for (int i = 0; i <= static_cast<int>(Unit::euro); ++i) {
    const UnitInfo& row = info(static_cast<Unit>(i));
    EXPECT_EQ(row.unit, static_cast<Unit>(i));
    EXPECT_EQ(row.scale, 1) << row.name;
    EXPECT_FALSE(row.name.empty());
  }
}

TEST(Unit, TableIsConsistent) {
  std::set<std::string_view> symbols;
  for (const UnitInfo& row : unit_table()) {
    EXPECT_TRUE(symbols.insert(row.symbol).second) << "twice: " << row.symbol;
    EXPECT_EQ(row.dimension, info(row.unit).dimension) << row.symbol;
    EXPECT_GT(row.scale, 0) << row.symbol;
    if (row.symbol.empty()) continue;
    ASSERT_NE(find_unit(row.symbol), nullptr);
    EXPECT_EQ(find_unit(row.symbol)->name, row.name);
    if (!row.pretty.empty()) { EXPECT_EQ(find_unit(row.pretty)->name, row.name); }
  }
}

TEST(Unit, FindsBySymbolOnly) {
  EXPECT_EQ(find_unit("m²")->unit, Unit::square_metre);
  EXPECT_EQ(find_unit("ha")->scale, 1e4);
  EXPECT_EQ(find_unit("furlong"), nullptr);
  EXPECT_EQ(find_unit("M"), nullptr);
  EXPECT_EQ(find_unit("hectare"), nullptr);
}

TEST(Unit, DimensionsMatchOrNot) {
  EXPECT_TRUE(same_dimension(Unit::ratio, Unit::count));
  EXPECT_TRUE(same_dimension(Unit::none, Unit::ratio));
  EXPECT_TRUE(same_dimension(Unit::metre, Unit::metre));
  EXPECT_FALSE(same_dimension(Unit::metre, Unit::square_metre));
  EXPECT_FALSE(same_dimension(Unit::metre, Unit::per_metre));
  EXPECT_FALSE(same_dimension(Unit::degree, Unit::ratio));
  EXPECT_FALSE(same_dimension(Unit::euro, Unit::count));
}

struct Typed {
  const char* text;
  Unit unit;
  double si;
};

TEST(Unit, ReadsQuantities) {
  const Typed typed[] = {
      {"12 m", Unit::metre, 12},
      {"12m", Unit::metre, 12},
      {"850", Unit::cubic_metre, 850},
      {"  0.4 ha ", Unit::square_metre, 4000},
      {"2 km2", Unit::square_metre, 2e6},
      {"2 km²", Unit::square_metre, 2e6},
      {"35 cm", Unit::metre, 0.35},
      {"1e3 m", Unit::metre, 1000},
      {"-5 mm", Unit::metre, -0.005},
      {"+5 m", Unit::metre, 5},
      {"15 %", Unit::ratio, 0.15},
      {"15%", Unit::ratio, 0.15},
      {"2 h", Unit::second, 7200},
      {"3 min", Unit::second, 180},
      {"36 km/h", Unit::metre_per_second, 10},
      {"45°", Unit::degree, 45},
      {"3 EUR", Unit::euro, 3},
      {"3 €", Unit::euro, 3},
      {"7 count", Unit::ratio, 7},
      {"0.5 1/m", Unit::per_metre, 0.5},
  };
  for (const Typed& t : typed) {
    const auto si = parse_quantity(t.text, t.unit);
    ASSERT_TRUE(si.has_value()) << t.text;
    EXPECT_NEAR(*si, t.si, 1e-12 * std::abs(t.si)) << t.text;
  }
}

TEST(Unit, RefusesWhatIsNoQuantityOfThatDimension) {
  const Typed typed[] = {
      {"", Unit::metre, 0},      {"   ", Unit::metre, 0},    {"m", Unit::metre, 0},      {"12 s", Unit::metre, 0},
      {"12 m2", Unit::metre, 0}, {"12 m m", Unit::metre, 0}, {"1,5 m", Unit::metre, 0},  {"12 yd", Unit::metre, 0},
      {"12 M", Unit::metre, 0},  {"12 %", Unit::degree, 0},  {"12 EUR", Unit::ratio, 0}, {"twelve", Unit::metre, 0},
      {"1 2 m", Unit::metre, 0}, {"12 m/s", Unit::metre, 0}, {"12 1/m", Unit::metre, 0},
  };
  for (const Typed& t : typed) EXPECT_FALSE(parse_quantity(t.text, t.unit).has_value()) << t.text;
}

}  // namespace
}  // namespace bl
