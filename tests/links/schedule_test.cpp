// Schedule: a day read off by hand, across midnight, and a market that grows until noon.
#include "tests/links/link_case.h"

namespace bl {
namespace {

Table hours(const std::vector<std::pair<double, double>>& points) {
  Table table{{"time", "value"}, {}};
  for (const auto& [hour, value] : points) table.rows.push_back({3600 * hour, value});
  return table;
}
double scheduled(double hour, const std::string& shape = "linear") {
  LinkCase link("schedule");
  link.set("curve", Shared<Table>(hours({{6, 100.0}, {12, 400.0}, {18, 200.0}}))).set("shape", shape);
  EXPECT_EQ(link.from("clock.time_of_day", 3600 * hour).run(), "");
  return link.number(End::to, "target");
}

TEST(Schedule, IsLinearBetweenPointsAndAcrossMidnight) {
  EXPECT_EQ(scheduled(6), 100);
  EXPECT_NEAR(scheduled(8), 200, 1e-9);
  EXPECT_EQ(scheduled(12), 400);
  EXPECT_NEAR(scheduled(15), 300, 1e-9);
  // From 18 hours to 6 hours of the next day: 200 to 100 in twelve hours.
  EXPECT_NEAR(scheduled(21), 175, 1e-9);
  EXPECT_NEAR(scheduled(0), 150, 1e-9);
  EXPECT_NEAR(scheduled(3), 125, 1e-9);
}

TEST(Schedule, HoldsInSteps) {
  for (const auto& [hour, value] :
       {std::pair{6.0, 100.0}, {11.9, 100.0}, {12.0, 400.0}, {17.0, 400.0}, {23.0, 200.0}, {5.0, 200.0}})
    EXPECT_EQ(scheduled(hour, "steps"), value) << hour;
}

TEST(Schedule, OnePointHoldsAllDayAndSoDoPointsAtBothEnds) {
  LinkCase link("schedule");
  for (const double hour : {0.0, 9.0, 23.0}) {
    ASSERT_EQ(link.set("curve", Shared<Table>(hours({{9, 7.0}}))).from("clock.time_of_day", 3600 * hour).run(), "");
    EXPECT_EQ(link.number(End::to, "target"), 7) << hour;
  }
  ASSERT_EQ(link.set("curve", Shared<Table>(hours({{0, 1.0}, {24, 3.0}}))).from("clock.time_of_day", 43200.0).run(), "");
  EXPECT_EQ(link.number(End::to, "target"), 2);
  ASSERT_EQ(link.from("clock.time_of_day", 0.0).run(), "");
  EXPECT_EQ(link.number(End::to, "target"), 1);
}

// To the last bit: else what follows the hours would be evaluated in every tick of the night.
TEST(Schedule, ALevelStretchIsLevel) {
  LinkCase link("schedule");
  link.set("curve", Shared<Table>(hours({{6, 0.3}, {9, 7.0}, {18, 7.0}, {22, 0.3}})));
  for (double hour = 0; hour < 24; hour += 0.01) {
    ASSERT_EQ(link.from("clock.time_of_day", 3600 * hour).run(), "");
    if (hour >= 9 && hour <= 18) { EXPECT_EQ(link.number(End::to, "target"), 7.0) << hour; }
    if (hour < 6 || hour >= 22) { EXPECT_EQ(link.number(End::to, "target"), 0.3) << hour; }
  }
}

TEST(Schedule, PointsMustAscendAndExist) {
  LinkCase link("schedule");
  link.from("clock.time_of_day", 0.0);
  EXPECT_EQ(link.set("curve", Shared<Table>(hours({}))).run(), "curve: the curve needs at least one point");
  EXPECT_EQ(link.set("curve", Shared<Table>(hours({{6, 1.0}, {6, 2.0}}))).run(),
            "curve/1/time: the times have to ascend: each larger than the one before");
}

TEST(Schedule, SceneFollowsTheHours) {
  World world = World::from_file("scenes/links/schedule.json");
  world.tick(2);
  EXPECT_EQ(world.number("market", "smart_volume.demand"), 2000);
  EXPECT_EQ(world.number("garage", "smart_volume.demand"), 1000);
  ASSERT_TRUE(world.settle());
  EXPECT_EQ(world.number("clock", "clock.time_of_day"), 43200);
  EXPECT_EQ(world.number("market", "smart_volume.demand"), 8000);
  EXPECT_EQ(world.number("garage", "smart_volume.demand"), 6000);
  EXPECT_NEAR(world.number("market", "smart_volume.volume"), 8000, 80);
}

}  // namespace
}  // namespace bl
