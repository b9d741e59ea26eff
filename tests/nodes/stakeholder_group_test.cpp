// The stakeholder group: goals and money that can be counted by hand.
#include <gtest/gtest.h>

#include "tests/nodes/scene_text.h"
#include "tests/support/world.h"

namespace bl {
namespace {

TEST(StakeholderGroup, CountsItsGoals) {
  World world = World::from_text(scene_text(
      R"({"id": "a", "types": {"indicator": {"value": 5, "target": 4}}}, {"id": "b", "types": {"indicator": {"value": 1, "target": 4}}},
         {"id": "c", "types": {"indicator": {"value": 3, "target": 4}}},
         {"id": "it", "types": {"stakeholder_group": {"goals": ["a", "b", "c"]}}}, {"id": "idle", "types": {"stakeholder_group": {}}})"));
  world.tick(2);
  EXPECT_EQ(world.number("it", "stakeholder_group.goal_count"), 3);
  EXPECT_DOUBLE_EQ(world.number("it", "stakeholder_group.goals_met"), 1.0 / 3);
  EXPECT_DOUBLE_EQ(world.number("it", "stakeholder_group.mean_score"), (1 + 0.25 + 0.75) / 3);
  EXPECT_EQ(world.number("idle", "stakeholder_group.goal_count"), 0);
  EXPECT_EQ(world.number("idle", "stakeholder_group.goals_met"), 1);
}

TEST(StakeholderGroup, AGoalThatFailsIsNotMet) {
  World world = World::from_text(scene_text(
      R"({"id": "a", "types": {"indicator": {"value": 5, "target": 4, "unit": "ha"}}}, {"id": "it", "types": {"stakeholder_group": {"goals": ["a"]}}})"));
  world.tick(3);
  EXPECT_NE(world.node_error("a", "indicator"), "");
  EXPECT_EQ(world.number("it", "stakeholder_group.goals_met"), 0);
  EXPECT_EQ(world.number("it", "stakeholder_group.mean_score"), 0);
}

TEST(StakeholderGroup, CountsItsMoney) {
  World world = World::from_text(one_node("stakeholder_group", R"("budget": 100, "spent": 100)"));
  world.tick();
  EXPECT_EQ(world.number("it", "stakeholder_group.budget_left"), 0);
  EXPECT_EQ(world.number("it", "stakeholder_group.is_within_budget"), 1);
  World over = World::from_text(one_node("stakeholder_group", R"("budget": 100, "spent": 130)"));
  over.tick();
  EXPECT_EQ(over.number("it", "stakeholder_group.budget_left"), -30);
  EXPECT_EQ(over.number("it", "stakeholder_group.is_within_budget"), 0);
}

TEST(StakeholderGroup, SceneIsWhatItSays) {
  World world = World::from_file("scenes/nodes/stakeholder_group.json");
  EXPECT_TRUE(world.settle(20));
  EXPECT_EQ(world.number("residents", "stakeholder_group.goals_met"), 0.5);
  EXPECT_NEAR(world.number("residents", "stakeholder_group.mean_score"), 0.875, 1e-12);
  EXPECT_EQ(world.number("investor", "stakeholder_group.budget_left"), -2000000);
}

}  // namespace
}  // namespace bl
