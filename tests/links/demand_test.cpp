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

TEST(Demand, AVolumeWithoutARowTakesPartInNothingAndIsNamed) {
  auto link = dealt({kA, kB, kC}, {kHousing, kSchool, std::string("housin")});
  ASSERT_EQ(link.run(), "");
  EXPECT_EQ(
      link.remarked(LinkRemark::short_of),
      "`c` has the use `housin`, for which the programme has no row: change the use or add the row, did you mean `housing`?");
  EXPECT_NEAR(link.number(End::to, "smart_volume.demand", 0), 7200, 1e-9) << "all of the housing, as `c` is none";
  EXPECT_NEAR(link.number(End::to, "smart_volume.demand", 1), 3240, 1e-9);
  for (const char* port : {"demand", "demand_min", "demand_limit", "storey_height"})
    EXPECT_FALSE(link.proposed(End::to, std::string("smart_volume.") + port, 2).has_value()) << port;
  auto empty = dealt({kA, kB, kC}, {kHousing, kSchool, std::string()});
  ASSERT_EQ(empty.run(), "");
  EXPECT_EQ(empty.remarked(LinkRemark::short_of),
            "`c` has no use, so it gets no demand from the programme: give it a use of the programme");
  EXPECT_NEAR(empty.number(End::to, "smart_volume.demand", 0), 7200, 1e-9);
}

TEST(Demand, AUseWithoutAVolumeIsShortAndAllOthersGoOn) {
  auto link = dealt({kA}, {kHousing});
  ASSERT_EQ(link.run(), "");
  EXPECT_EQ(link.remarked(LinkRemark::short_of),
            "no volume has the use `school`, so all of the 900 m² that it asks for are missing: give a volume that use, add one, "
            "or remove the row");
  EXPECT_NEAR(link.number(End::to, "smart_volume.demand", 0), 7200, 1e-9);
  ASSERT_EQ(link.set("every_row", false).run(), "");
  EXPECT_EQ(link.remarked(LinkRemark::short_of), "");
}

TEST(Demand, OpenSpaceIsForNoVolume) {
  auto link = dealt({kA, kB}, {kHousing, kSchool});
  link.from("programme.open_uses", Shared<std::vector<std::string>>({"school"}));
  ASSERT_EQ(link.run(), "");
  EXPECT_EQ(link.remarked(LinkRemark::short_of),
            "`b` has the use `school`, which is open space that no volume has: give it another use");
  EXPECT_FALSE(link.proposed(End::to, "smart_volume.demand", 1).has_value());
  EXPECT_NEAR(link.number(End::to, "smart_volume.demand", 0), 7200, 1e-9);
  auto alone = dealt({kA}, {kHousing});
  alone.from("programme.open_uses", Shared<std::vector<std::string>>({"school"}));
  ASSERT_EQ(alone.run(), "");
  EXPECT_EQ(alone.remarked(LinkRemark::short_of), "") << "nobody has to have a volume for it";
  EXPECT_EQ(alone.set("use", kSchool).run(), "use: the use `school` is open space, which no volume shares: choose another one");
}

TEST(Demand, AnEmptyProgrammeNamesTheVolumes) {
  auto link = dealt({kA}, {kHousing});
  ASSERT_EQ(link.from("programme.rows", Shared<Table>(Table{})).run(), "");
  EXPECT_NE(link.remarked(LinkRemark::short_of).find("`a`"), std::string::npos);
}

// The programme says itself that the row has no use; nobody's volumes are meant by it.
TEST(Demand, ARowWithoutAUseIsForNobody) {
  Table rows{{"use", "floor_area", "floor_area_min", "floor_area_max", "storey_height", "count", "note"}, {}};
  rows.rows = {{std::string(), 500.0, 0.0, 0.0, 3.0, 1.0, std::string()},
               {std::string("housing"), 100.0, 0.0, 0.0, 3.0, 1.0, std::string()}};
  auto link = dealt({kA, kB}, {std::string(), kHousing});
  ASSERT_EQ(link.from("programme.rows", Shared<Table>(rows)).run(), "");
  EXPECT_FALSE(link.proposed(End::to, "smart_volume.demand", 0).has_value());
  EXPECT_NEAR(link.number(End::to, "smart_volume.demand", 1), 300, 1e-9);
}

// One deletion or one new volume must not unplug the programme from all others.
TEST(Demand, AQuarterWithoutItsHotelAndWithANewVolumeStillFollowsItsBrief) {
  World world = World::from_file("scenes/start/quarter.json");
  world.tick(30);
  ASSERT_EQ(world.submit(command<RemoveNode>({.id = "hotel"})), "");
  ASSERT_EQ(world.submit(command<AddNode>({.id = "new", .node = {R"({"position": [30, 45, 8]})"}})), "");
  ASSERT_EQ(world.submit(command<Typify>({.node = "new", .typification = "smart_volume", .values = {"{}"}})), "");
  ASSERT_EQ(world.submit(command<SetPort>({.node = "programme", .port = {"programme.rows"}, .value = {R"([
      {"use": "housing", "floor_area": 4200, "storey_height": 3, "count": 4},
      {"use": "office", "floor_area": 9000, "storey_height": 3.6, "count": 2},
      {"use": "hotel", "floor_area": 4400}])"}})),
            "");
  world.tick(3);
  EXPECT_EQ(world.number("office-1", "smart_volume.demand"), 9000 * 3.6) << "what is edited in the brief arrives";
  const std::string said = world.link_error("brief");
  EXPECT_NE(said.find("no volume has the use `hotel`, so all of the 4400 m² that it asks for are missing"), std::string::npos)
      << said;
  EXPECT_NE(said.find("`new` has no use"), std::string::npos) << said;
  EXPECT_NE(said.find("`cafe` has the use `cafe`, for which the programme has no row"), std::string::npos) << said;
  EXPECT_FALSE(has_failure(world.state())) << "who goes without keeps nobody from settling";
}

TEST(Demand, SceneDealsTheBriefOut) {
  World world = World::from_file("scenes/links/demand.json");
  ASSERT_TRUE(world.settle());
  for (const char* house : {"house_1", "house_2", "house_3"})
    EXPECT_NEAR(world.number(house, "smart_volume.fitted"), 2400, 24) << house;
  EXPECT_NEAR(world.number("school", "smart_volume.fitted"), 3240, 32.4);
  EXPECT_NEAR(world.number("school", "smart_volume.floor_area") * world.number("school", "smart_volume.storey_height"), 3240,
              32.4)
      << "it gets the square metres that the brief asks for";
  EXPECT_EQ(world.number("school", "smart_volume.demand_limit"), 3600);
  EXPECT_EQ(world.number("shop", "smart_volume.storey_height"), 4.5);
}

}  // namespace
}  // namespace bl
