// The indicator: scores and gaps that can be checked by hand, for goals in each direction.
#include <gtest/gtest.h>

#include "tests/nodes/scene_text.h"
#include "tests/support/world.h"

namespace bl {
namespace {

World indicator(const std::string& ports) {
  World world = World::from_text(one_node("indicator", ports));
  world.tick();
  return world;
}
double of_indicator(const World& world, const std::string& port) { return world.number("it", "indicator." + port); }

TEST(Indicator, AtLeast) {
  const World enough = indicator(R"("value": 3200, "target": 3000)");
  EXPECT_EQ(of_indicator(enough, "score"), 1);
  EXPECT_EQ(of_indicator(enough, "gap"), 0);
  EXPECT_EQ(enough.text("it", "indicator.status"), "met");
  const World half = indicator(R"("value": 1800, "target": 3000)");
  EXPECT_EQ(of_indicator(half, "gap"), 1200);
  EXPECT_NEAR(of_indicator(half, "score"), 0.6, 1e-15);
  EXPECT_NEAR(of_indicator(half, "pressure"), 0.4, 1e-15);
  EXPECT_EQ(half.text("it", "indicator.status"), "close");
  EXPECT_EQ(indicator(R"("value": 1200, "target": 3000)").text("it", "indicator.status"), "far");
}

TEST(Indicator, AtMostAndNear) {
  const World dear = indicator(R"("value": 36, "target": 30, "direction": "at_most")");
  EXPECT_EQ(of_indicator(dear, "gap"), -6);
  EXPECT_NEAR(of_indicator(dear, "pressure"), -0.2, 1e-15);
  EXPECT_NEAR(of_indicator(dear, "score"), 0.8, 1e-15);
  EXPECT_EQ(indicator(R"("value": 12, "target": 30, "direction": "at_most")").text("it", "indicator.status"), "met");
  for (const char* value : {"24", "36"}) {
    const World off = indicator(R"("target": 30, "direction": "near", "value": )" + std::string(value));
    EXPECT_NEAR(of_indicator(off, "score"), 0.8, 1e-15) << value;
  }
}

TEST(Indicator, IsMetWithinItsToleranceAndAimsAtTheTarget) {
  EXPECT_EQ(of_indicator(indicator(R"("value": 2970, "target": 3000)"), "gap"), 0) << "a hundredth of the target";
  EXPECT_EQ(of_indicator(indicator(R"("value": 2969, "target": 3000)"), "gap"), 31);
  EXPECT_EQ(of_indicator(indicator(R"("value": 2950, "target": 3000, "tolerance": 50)"), "gap"), 0);
  EXPECT_EQ(of_indicator(indicator(R"("value": 2949, "target": 3000, "tolerance": 50)"), "gap"), 51);
}

TEST(Indicator, TheSpanSaysWhereTheScoreIsNothing) {
  const World world = indicator(R"("value": 900, "target": 400, "direction": "near", "span": 250)");
  EXPECT_EQ(of_indicator(world, "score"), 0);
  EXPECT_EQ(of_indicator(world, "pressure"), -1);
  EXPECT_EQ(of_indicator(world, "gap"), -500);
  EXPECT_NEAR(of_indicator(indicator(R"("value": 0.25, "direction": "at_most")"), "score"), 0.75, 1e-15) << "a target of 0";
}

TEST(Indicator, KnowsItsUnits) {
  EXPECT_EQ(indicator(R"("unit": "ha")").node_error("it", "indicator"),
            "nodes/it/indicator/unit: values are not kept in `ha`: write `m2`, and the numbers in it");
}

TEST(Indicator, SceneIsWhatItSays) {
  World world = World::from_file("scenes/nodes/indicator.json");
  EXPECT_TRUE(world.settle(20));
  EXPECT_EQ(world.text("area", "indicator.status"), "met");
  EXPECT_NEAR(world.number("cost", "indicator.score"), 0.8, 1e-12);
  EXPECT_EQ(world.text("walk", "indicator.status"), "far");
}

}  // namespace
}  // namespace bl
