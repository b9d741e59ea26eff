// Demand: shares by hand, rows and volumes that do not meet, and a brief dealt out.
#include "tests/links/link_case.h"

namespace bl {
namespace {

Value brief() {
  Table rows{{"use", "floor_area", "floor_area_min", "floor_area_max", "storey_height", "count", "note"}, {}};
  rows.rows = {{std::string("housing"), 60.0, 0.0, 0.0, 3.0, 40.0, std::string()},
               {std::string("school"), 900.0, 700.0, 1000.0, 3.6, 1.0, std::string()}};
  return Shared<Table>(rows);
}

LinkCase dealt(std::vector<Value> ids, std::vector<Value> uses) {
  LinkCase link("demand");
  link.from("programme.rows", brief())
      .read(End::to, "node.id", std::move(ids))
      .read(End::to, "smart_volume.use", std::move(uses));
  return link;
}

const Value kA = std::string("a"), kB = std::string("b"), kC = std::string("c");
const Value kHousing = std::string("housing"), kSchool = std::string("school");

TEST(Demand, SharesARowEquallyAndKeepsItsLimits) {
  auto link = dealt({kA, kB, kC}, {kHousing, kSchool, kHousing});
  ASSERT_EQ(link.run(), "");
  EXPECT_NEAR(link.number(End::to, "smart_volume.demand", 0), 3600, 1e-9);  // 60 m² · 40 · 3 m / 2
  EXPECT_NEAR(link.number(End::to, "smart_volume.demand", 2), 3600, 1e-9);
  EXPECT_EQ(link.number(End::to, "smart_volume.storey_height", 0), 3);
  EXPECT_FALSE(link.proposed(End::to, "smart_volume.demand_min", 0).has_value());
  EXPECT_FALSE(link.proposed(End::to, "smart_volume.demand_limit", 0).has_value());
  EXPECT_NEAR(link.number(End::to, "smart_volume.demand", 1), 3240, 1e-9);
  EXPECT_NEAR(link.number(End::to, "smart_volume.demand_min", 1), 2520, 1e-9);
  EXPECT_NEAR(link.number(End::to, "smart_volume.demand_limit", 1), 3600, 1e-9);
}

TEST(Demand, AGivenUseIsSharedWhateverTheVolumesSay) {
  auto link = dealt({kA, kB}, {std::string(), kSchool});
  ASSERT_EQ(link.set("use", kHousing).run(), "");
  EXPECT_NEAR(link.number(End::to, "smart_volume.demand", 1), 3600, 1e-9);
  EXPECT_EQ(link.set("use", std::string("scool")).run(),
            "use: the programme has no row of the use `scool`, did you mean `school`?");
}

TEST(Demand, NothingIsLeftOutSilently) {
  EXPECT_EQ(
      dealt({kA, kB, kC}, {kHousing, kSchool, std::string("housin")}).run(),
      "to: the programme has no row for the use of `c` (use `housin`, did you mean `housing`?); add the rows or change the uses");
  auto link = dealt({kA}, {kHousing});
  EXPECT_EQ(link.run(), "from: no volume of this link has the use `school`; give one that use or turn `every_row` off");
  EXPECT_EQ(link.set("every_row", false).run(), "");
}

TEST(Demand, AnEmptyProgrammeNamesTheVolumes) {
  auto link = dealt({kA}, {kHousing});
  EXPECT_NE(link.from("programme.rows", Shared<Table>(Table{})).run().find("`a`"), std::string::npos);
}

TEST(Demand, SceneDealsTheBriefOut) {
  World world = World::from_file("scenes/links/demand.json");
  ASSERT_TRUE(world.settle());
  for (const char* house : {"house_1", "house_2", "house_3"})
    EXPECT_NEAR(world.number(house, "smart_volume.volume"), 2400, 24) << house;
  EXPECT_NEAR(world.number("school", "smart_volume.volume"), 3240, 32.4);
  EXPECT_EQ(world.number("school", "smart_volume.demand_limit"), 3600);
  EXPECT_EQ(world.number("shop", "smart_volume.storey_height"), 4.5);
}

}  // namespace
}  // namespace bl
