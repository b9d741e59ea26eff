// Buildings that several volumes share, as rows of tables and as rules of height read them.
#include "core/demand/shared_storeys.h"

#include <cmath>

#include <gtest/gtest.h>

namespace bl::demand {
namespace {

const Building kBuilding{"shops", 7, 2, 6, 3.2, 4, 23, 19.5, 0.25, "flats"};

TEST(SharedStoreys, ATableHoldsThem) {
  EXPECT_EQ(building_in(Shared<Table>(table_of(kBuilding))), kBuilding);
  EXPECT_EQ(building_in(Shared<Table>(table_of(std::nullopt))), std::nullopt);
  EXPECT_EQ(building_in(std::nullopt), std::nullopt);
}

TEST(SharedStoreys, AnyNumbersOfATableCanBeReckonedWith) {
  Table table = table_of(kBuilding);
  for (std::size_t column = 1; column + 1 < table.columns.size(); ++column)
    for (const double number : {-1e308, 0.0, 1e308}) {
      Table odd = table;
      odd.rows.front()[column] = number;
      const auto building = building_in(Shared<Table>(odd));
      ASSERT_TRUE(building.has_value());
      const StandingVolume seen = standing_in({3, 4, 1, 4.5, 1e6, false}, building);
      for (const auto& limit : {lower_limit(seen, 0.1, 0.2), higher_limit(seen), kept_limit(seen), limit_at(seen, 20, 0.2)})
        if (limit) { EXPECT_TRUE(std::isfinite(*limit)) << table.columns[column] << " " << number; }
    }
}

TEST(SharedStoreys, RulesSeeTheBuildingAndTheirOwnLock) {
  const StandingVolume own{3, 4, 1, 4.5, 1e6, true}, seen = standing_in(own, kBuilding), alone = standing_in(own, std::nullopt);
  EXPECT_EQ(seen.built, 6);
  EXPECT_EQ(seen.wished, 7);
  EXPECT_EQ(seen.least, 2);
  EXPECT_EQ(seen.storey_height, 3.2);
  EXPECT_EQ(seen.limit, 19.5);
  EXPECT_TRUE(seen.is_locked);
  EXPECT_EQ(alone.built, 3);
  EXPECT_EQ(alone.storey_height, 4.5);
  EXPECT_EQ(ground_below(kBuilding, 9), 4);
  EXPECT_EQ(ground_below(std::nullopt, 9), 9);
}

TEST(SharedStoreys, SentencesNameTheHost) {
  EXPECT_EQ(holder_of(kBuilding, "flats"), "shops");
  EXPECT_EQ(holder_of(std::nullopt, "flats"), "flats");
  EXPECT_EQ(named_holder(kBuilding, "flats"), "the building of `shops`");
  EXPECT_EQ(named_holder(std::nullopt, "flats"), "`flats`");
  EXPECT_EQ(why_it_stays(kBuilding, "flats"), "`flats` stands where `shops` does, whose footprint it shares");
  EXPECT_EQ(why_it_stays(kBuilding, "shops"), "");
  EXPECT_EQ(why_it_stays(std::nullopt, "flats"), "");
}

}  // namespace
}  // namespace bl::demand
