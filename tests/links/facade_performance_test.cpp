// Façade performance: the curve by hand, and a house that follows it.
#include "tests/links/link_case.h"

namespace bl {
namespace {

double glazing_at(double value) {
  LinkCase link("facade_performance");
  link.read(End::from, "source", {value});
  EXPECT_EQ(link.run(), "");
  return link.number(End::to, "facade.glazing");
}

TEST(FacadePerformance, FollowsTheCurve) {
  EXPECT_EQ(glazing_at(-5), 1.4);
  EXPECT_NEAR(glazing_at(7200), 1.2, 1e-12);
  EXPECT_NEAR(glazing_at(14400), 1, 1e-12);
  EXPECT_NEAR(glazing_at(21600), 0.8, 1e-12);
  EXPECT_EQ(glazing_at(1e6), 0.6);
}

TEST(FacadePerformance, WantsAscendingValues) {
  LinkCase link("facade_performance");
  link.set("curve", Shared<Table>(Table{{"value", "glazing"}, {{1.0, 1.0}, {1.0, 2.0}}})).read(End::from, "source", {0.5});
  EXPECT_NE(link.run().find("curve/1/value"), std::string::npos);
  link.set("curve", Shared<Table>(Table{{"value", "glazing"}, {}}));
  EXPECT_NE(link.run().find("at least one point"), std::string::npos);
}

TEST(FacadePerformance, SceneTakesGlassAway) {
  World world = World::from_file("scenes/links/facade_performance.json");
  ASSERT_TRUE(world.settle());
  EXPECT_NEAR(world.number("house", "facade.glazing"), 0.8, 1e-12);
  EXPECT_NEAR(world.number("house", "facade.glazing_ratio"), 0.32, 0.01);
}

}  // namespace
}  // namespace bl
