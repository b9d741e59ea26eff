// Buildings that several volumes share, as rows of tables and as rules of height read them.
#include "core/demand/shared_storeys.h"

#include <gtest/gtest.h>

namespace bl::demand {
namespace {

const Building kBuilding{"shops", 7, 2, 6, 3.2, 4, 23, 19.5, 0.25, "flats"};

TEST(SharedStoreys, ATableHoldsThem) {
  EXPECT_EQ(building_in(Shared<Table>(table_of(kBuilding))), kBuilding);
  EXPECT_EQ(building_in(Shared<Table>(table_of(std::nullopt))), std::nullopt);
  EXPECT_EQ(building_in(std::nullopt), std::nullopt);
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
