// The scenario: its figures, rows that cannot be, and that nothing follows from it.
#include <gtest/gtest.h>

#include "tests/nodes/scene_text.h"
#include "tests/support/world.h"

namespace bl {
namespace {

std::string scenario_error(const std::string& figures) {
  World world = World::from_text(one_node("scenario", R"("figures": [)" + figures + "]"));
  world.tick();
  return world.node_error("it", "scenario");
}

TEST(Scenario, FiguresHaveANameOfTheirOwnAndAUnit) {
  EXPECT_EQ(scenario_error(R"({"figure": "cost", "unit": "EUR", "value": 3}, {"figure": "seats"})"), "");
  EXPECT_EQ(scenario_error(R"({"figure": ""})"),
            "nodes/it/scenario/figures/0/figure: the figure has no name: say what was measured");
  EXPECT_EQ(scenario_error(R"({"figure": "cost"}, {"figure": "cost"})"),
            "nodes/it/scenario/figures/1/figure: the figure `cost` stands in an earlier row too: name one of them otherwise");
  EXPECT_NE(scenario_error(R"({"figure": "cost", "unit": "ell"})").find("nodes/it/scenario/figures/0/unit: "), std::string::npos);
}

TEST(Scenario, SceneRestsAtOnce) {
  World world = World::from_file("scenes/nodes/scenario.json");
  world.tick(2);
  EXPECT_TRUE(world.state().due.is_nothing()) << "no tick acts on it";
  EXPECT_TRUE(world.settle(20));
  EXPECT_EQ(world.number("compact", "scenario.figure_count"), 2);
}

}  // namespace
}  // namespace bl
