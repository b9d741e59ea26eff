// Turn rules: no left turn at the market, rules that cannot hold, and junctions that are named one by one.
#include <gtest/gtest.h>

#include "core/file/scene_file.h"
#include "tests/support/world.h"

namespace bl {
namespace {

double time_of(const World& world, std::initializer_list<const char*> streets) {
  double time = 0;
  for (const char* street : streets) time += world.number(street, "street.time_forth");
  return time;
}

TEST(TurnRules, NoLeftTurnAtTheMarket) {
  World world = World::from_file("scenes/nodes/turn_rules.json");
  ASSERT_TRUE(world.settle(100));
  EXPECT_EQ(world.number("market_street", "street.flow_forth"), 0);
  EXPECT_EQ(world.number("high_street_2", "street.flow_back"), 0) << "nobody turns round at the bridge";
  EXPECT_NEAR(world.number("quay", "street.flow_forth") + world.number("mill_lane", "street.flow_forth"), 900, 1e-6);
  EXPECT_NEAR(time_of(world, {"high_street_1", "high_street_2", "quay"}), time_of(world, {"mill_lane"}), 0.1);
  EXPECT_EQ(world.number("market", "turn_rules.forbidden"), 1);
  EXPECT_EQ(world.number("bridge", "turn_rules.forbidden"), 1);
  EXPECT_EQ(world.text("market", "turn_rules.reason"), "");
  EXPECT_EQ(world.text("network", "traffic_network.message"), "");
  // Without the rule the market street is the shortest way.
  ASSERT_EQ(world.submit(command<SetPort>({.node = "market", .port = {"turn_rules.turns"}, .value = {"[]"}})), "");
  world.tick();
  ASSERT_TRUE(world.settle(100));
  EXPECT_GT(world.number("market_street", "street.flow_forth"), 800);
  for (const char* street : {"quay", "mill_lane"})
    ASSERT_EQ(world.submit(command<SetPort>({.node = street, .port = {"street.open"}, .value = {"0"}})), "");
  ASSERT_EQ(world.submit(command<Untypify>({.node = "bridge", .typification = "turn_rules"})), "");
  ASSERT_EQ(world.submit(command<SetPort>({.node = "market",
                                           .port = {"turn_rules.turns"},
                                           .value = {R"([{"from": "high_street_1", "to": "high_street_2", "rule": "only"}])"}})),
            "");
  world.tick();
  ASSERT_TRUE(world.settle(100));
  EXPECT_EQ(world.number("market", "turn_rules.forbidden"), 2);
  EXPECT_NEAR(world.number("market_street", "street.flow_forth"), 900, 1e-6) << "round at the bridge, and then to the right";
  EXPECT_NEAR(world.number("high_street_2", "street.flow_back"), 900, 1e-6);
}

TEST(TurnRules, RowsThatDoNotHoldAreNamedWithTheirPlace) {
  World world = World::from_file("scenes/nodes/turn_rules.json");
  ASSERT_EQ(world.submit(command<SetPort>(
                {.node = "market", .port = {"turn_rules.turns"}, .value = {R"([{"from": "high_street_1", "to": "market_street"},
    {"from": "quay", "to": "market_street"}, {"from": "high_street_1", "to": "market_stret"},
    {"from": "high_street_1", "to": "market_street", "rule": "left"}])"}})),
            "");
  world.tick();
  const std::string reason =
      "turns/1/from: `quay` neither begins nor ends at `market`; turns/2/to: `market_stret` is no street of this network; "
      "turns/3/rule: `left` is no rule; write `no` or `only`";
  EXPECT_EQ(world.text("market", "turn_rules.reason"), reason);
  EXPECT_EQ(world.text("network", "traffic_network.message"), "`market`: " + reason);
  EXPECT_EQ(world.number("market", "turn_rules.forbidden"), 1) << "the other row holds";
  EXPECT_EQ(world.number("market_street", "street.flow_forth"), 0);
  ASSERT_EQ(world.submit(command<RemoveNode>({.id = "network"})), "");
  world.tick();
  EXPECT_NE(world.text("market", "turn_rules.reason").find("no traffic network"), std::string::npos);
}

TEST(TurnRules, JunctionsNamedOneByOneNeedNoRules) {
  World world = World::from_file("scenes/nodes/turn_rules.json");
  ASSERT_EQ(
      world.submit(command<SetPort>(
          {.node = "network", .port = {"traffic_network.junctions"}, .value = {R"(["home", "market", "work", "bridge"])"}})),
      "");
  ASSERT_TRUE(world.settle(100));
  EXPECT_EQ(world.node_error("network", "traffic_network"), "");
  EXPECT_EQ(world.number("market_street", "street.flow_forth"), 0);
}

TEST(TurnRules, ASavedStateGoesOnBitForBit) {
  World one = World::from_file("scenes/nodes/turn_rules.json");
  one.tick(2);
  const SavedState saved = save(one.state());
  World two = World::from_text(write_scene(one.state().plan->scene, full_registry(), &saved));
  for (int i = 0; i < 5; ++i) {
    one.tick();
    two.tick();
    ASSERT_EQ(one.state().hash, two.state().hash) << "tick " << i;
  }
}

}  // namespace
}  // namespace bl
