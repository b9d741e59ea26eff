// Goal pressure: steps by hand, limits, and houses that grow until there is enough.
#include <nlohmann/json.hpp>

#include "tests/links/link_case.h"

namespace bl {
namespace {

LinkCase pressed(double pressure, double value) {
  LinkCase link("goal_pressure");
  link.set("gain", 0.1).set("lowest", 0.0).set("highest", 5000.0);
  link.from("indicator.pressure", pressure).from("node.id", std::string("goal")).to("target", value);
  return link;
}

TEST(GoalPressure, ChangesByAShareOfItself) {
  auto more = pressed(0.5, 2000);
  ASSERT_EQ(more.run(), "");
  EXPECT_NEAR(more.number(End::to, "target"), 2100, 1e-9);
  EXPECT_EQ(more.remarked(LinkRemark::at_work), "the goal of `goal` is not met");
  auto less = pressed(-1, 2000);
  ASSERT_EQ(less.run(), "");
  EXPECT_NEAR(less.number(End::to, "target"), 1800, 1e-9);
  auto turned = pressed(-1, 2000);
  ASSERT_EQ(turned.set("gain", -0.1).run(), "");
  EXPECT_NEAR(turned.number(End::to, "target"), 2200, 1e-9);
}

TEST(GoalPressure, LeavesNothingByItsScale) {
  auto stuck = pressed(1, 0);
  ASSERT_EQ(stuck.run(), "");
  EXPECT_EQ(stuck.number(End::to, "target"), 0);
  EXPECT_EQ(stuck.remarked(LinkRemark::short_of),
            "scale: the goal of `goal` is not met, and the link changes nothing: the number is 0, so that it needs a `scale` to "
            "grow by");
  auto idle = pressed(1, 2000);
  ASSERT_EQ(idle.set("gain", 0.0).run(), "");
  EXPECT_EQ(idle.remarked(LinkRemark::short_of),
            "gain: the goal of `goal` is not met, and the link changes nothing: give it a `gain`");
  auto grows = pressed(1, 0);
  ASSERT_EQ(grows.set("scale", 500.0).run(), "");
  EXPECT_NEAR(grows.number(End::to, "target"), 50, 1e-9);
}

TEST(GoalPressure, AMetGoalIsLeftAlone) {
  auto met = pressed(0, 2000);
  ASSERT_EQ(met.run(), "");
  EXPECT_EQ(met.number(End::to, "target"), 2000);
  EXPECT_EQ(met.remarked(LinkRemark::at_work), "");
}

TEST(GoalPressure, SaysWhichLimitKeepsTheGoalFromBeingMet) {
  auto high = pressed(1, 4900);
  ASSERT_EQ(high.run(), "");
  EXPECT_EQ(high.number(End::to, "target"), 5000);
  EXPECT_EQ(high.remarked(LinkRemark::short_of),
            "highest: the goal of `goal` is not met, and the link may ask for no more than 5000: change that limit, or the goal");
  auto low = pressed(-1, 1000);
  ASSERT_EQ(low.set("lowest", 950.0).run(), "");
  EXPECT_EQ(low.number(End::to, "target"), 950);
  EXPECT_NE(low.remarked(LinkRemark::short_of).find("no less than 950"), std::string::npos);
  EXPECT_EQ(pressed(1, 1).set("lowest", 5000.0).run(), "highest: the highest value (5000) has to lie above the lowest (5000)");
}

// A port that people have set too is blended, and may stay beyond a limit.
TEST(GoalPressure, ALimitInItsBackIsNoObstacle) {
  auto link = pressed(1, 1500);
  ASSERT_EQ(link.set("lowest", 2000.0).run(), "");
  EXPECT_EQ(link.number(End::to, "target"), 2000);
  EXPECT_EQ(link.remarked(LinkRemark::short_of), "");
  EXPECT_EQ(link.remarked(LinkRemark::at_work), "the goal of `goal` is not met");
}

TEST(GoalPressure, SceneGrowsUntilTheGoalIsMet) {
  World world = World::from_file("scenes/links/goal_pressure.json");
  world.tick(5);
  EXPECT_EQ(world.text("goal", "indicator.status"), "far");
  ASSERT_TRUE(world.settle());
  EXPECT_EQ(world.text("goal", "indicator.status"), "met");
  EXPECT_NEAR(world.number("total", "statistics.sum"), 3000, 60);
  EXPECT_EQ(world.link_error("l2_pressure"), "");
  EXPECT_NEAR(world.number("house_1", "smart_volume.demand"), world.number("house_3", "smart_volume.demand"), 1e-9);
}

// Where the houses may not grow any more the scene rests, and says why.
TEST(GoalPressure, AGoalOutOfReachIsNamed) {
  World world = World::from_file("scenes/links/goal_pressure.json");
  ASSERT_EQ(world.submit(command<SetLinkParameter>({"l2_pressure", "highest", JsonValue::of(Json(2000.0))})), "");
  ASSERT_TRUE(world.settle());
  EXPECT_EQ(world.number("house_1", "smart_volume.demand"), 2000);
  EXPECT_NE(world.link_error("l2_pressure").find("may ask for no more than 2000"), std::string::npos)
      << world.link_error("l2_pressure");
}

}  // namespace
}  // namespace bl
