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

TEST(StakeholderGroup, ARoleCardHasRangesThatCanBe) {
  const auto fault = [](const std::string& rows) {
    World world = World::from_text(one_node("stakeholder_group", R"("controls": [)" + rows + "]"));
    world.tick();
    return world.node_error("it", "stakeholder_group");
  };
  const std::string budget = R"({"node": "it", "port": "stakeholder_group.budget", "maximum": )";
  EXPECT_EQ(fault(budget + R"(9, "step": 3})"), "");
  EXPECT_EQ(fault(budget + "0}"),
            "nodes/it/stakeholder_group/controls/0/maximum: the maximum (0) has to lie above the minimum (0)");
  EXPECT_EQ(
      fault(budget + R"(9, "step": 10})"),
      "nodes/it/stakeholder_group/controls/0/step: the step (10) is larger than the range (9): make it smaller, or 0 for none");
  EXPECT_EQ(fault(budget + "9}, " + budget + "8}"),
            "nodes/it/stakeholder_group/controls/1/port: this port of `it` stands in an earlier row too: keep one of them");
}

TEST(StakeholderGroup, ARoleCardNamesWhatIsThere) {
  const auto problems = [](const std::string& card) {
    const SceneReading reading =
        read_scene(scene_text(R"({"id": "house", "types": {"smart_volume": {}}}, {"id": "it", "types": {"stakeholder_group": {)" +
                              card + "}}}"),
                   full_registry());
    EXPECT_TRUE(reading.is_usable()) << "what is named may come and go";
    std::string all;
    for (const Problem& problem : check_scene(reading.scene, full_registry())) all += problem.error.text() + "\n";
    return all;
  };
  const auto control = [](const std::string& node, const std::string& port) {
    return R"("controls": [{"node": ")" + node + R"(", "port": ")" + port + R"(", "maximum": 9}])";
  };
  const std::string place = "nodes/it/stakeholder_group/";
  EXPECT_EQ(problems(control("house", "smart_volume.demand")), "");
  EXPECT_EQ(problems(control("house", "node.position")), "");
  EXPECT_EQ(problems(control("hous", "smart_volume.demand")),
            place + "controls/0/node: there is no node `hous`, did you mean `house`?\n");
  EXPECT_EQ(problems(control("house", "smart_volume.demnd")),
            place + "controls/0/port: `smart_volume` has no port `demnd`, did you mean `demand`?\n");
  EXPECT_EQ(problems(control("house", "street.lanes")),
            place + "controls/0/port: the node `house` is not a `street`, and has no such port\n");
  EXPECT_EQ(problems(control("house", "demand")),
            place + "controls/0/port: expects a port written `typification.port`, found `demand`\n");
  EXPECT_EQ(problems(R"("allowed": [{"command": "add_node"}, {"command": "add_nod"}])"),
            place + "allowed/1/command: unknown command `add_nod`, did you mean `add_node`?\n");
}

// Whoever sets more in the middle of a session is refused, so it is told before.
TEST(StakeholderGroup, ARangeBeyondWhatTheValueAllowsIsTold) {
  const auto problems = [](const std::string& row) {
    const SceneReading reading =
        read_scene(R"({"format": "behaviourlinks", "version": 1, "nodes": [{"id": "a", "types": {"smart_volume": {}}},
                       {"id": "b", "types": {"smart_volume": {}}}, {"id": "it", "types": {"stakeholder_group": {"controls": [{)" +
                       row + R"(}]}}}], "links": [{"id": "apart", "kind": "keep_distance", "from": "a", "to": "b"}]})",
                   full_registry());
    EXPECT_TRUE(reading.is_usable());
    std::string all;
    for (const Problem& problem : check_scene(reading.scene, full_registry())) {
      EXPECT_FALSE(problem.is_error) << "values that are possible can still be set";
      all += problem.error.text() + "\n";
    }
    return all;
  };
  const std::string row = "nodes/it/stakeholder_group/controls/0/";
  EXPECT_EQ(problems(R"("node": "apart", "port": "strength", "maximum": 1)"), "");
  EXPECT_EQ(problems(R"("node": "apart", "port": "strength", "maximum": 3)"),
            row + "maximum: allows 3, but the strength of a link goes to 1 only: what is above is refused\n");
  EXPECT_EQ(problems(R"("node": "a", "port": "smart_volume.demand", "minimum": -5, "maximum": 900)"),
            row + "minimum: allows -5 m³, but `smart_volume.demand` begins at 0 m³: what is below is refused\n");
  EXPECT_EQ(problems(R"("node": "apart", "port": "maximum", "minimum": -1, "maximum": 9)"),
            row + "minimum: allows -1 m, but `maximum` begins at 0 m: what is below is refused\n");
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
