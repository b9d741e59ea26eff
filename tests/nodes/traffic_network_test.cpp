// The network: what leaves arrives, a saved state goes on, Braess's streets, and faults that keep the last good figures.
#include <gtest/gtest.h>

#include "core/file/scene_file.h"
#include "core/traffic/packed_numbers.h"
#include "tests/nodes/scene_text.h"
#include "tests/support/world.h"

namespace bl {
namespace {

TEST(TrafficNetwork, AnEmptyOneRests) {
  World world = World::from_text(one_node("traffic_network", ""));
  world.tick(2);
  EXPECT_EQ(world.node_error("it", "traffic_network"), "");
  EXPECT_EQ(world.number("it", "traffic_network.unrest"), 0);
}

TEST(TrafficNetwork, FourZonesFindTheirWays) {
  World world = World::from_file("scenes/nodes/traffic_network.json");
  ASSERT_TRUE(world.settle(200));
  EXPECT_LE(world.number("network", "traffic_network.relative_gap"), 1e-6);
  EXPECT_NEAR(world.number("network", "traffic_network.trips"), 1260, 1e-6);
  EXPECT_EQ(world.number("network", "traffic_network.trips_lost"), 0);
  // Doubly: what ends in a zone is in proportion to what it would take.
  const Table& ways = world.table("network", "traffic_network.ways");
  const std::size_t place = ways.row_of("zone", "j32");
  double ending = 0;
  for (std::size_t r = 0; r < ways.rows.size(); ++r) {
    const auto trips = unpacked_numbers(ways.text(r, "trips"));
    ASSERT_TRUE(trips && place < trips->size());
    ending += (*trips)[place];
  }
  EXPECT_NEAR(ending, 600.0 * 1260 / 1230, 0.5);
}

TEST(TrafficNetwork, BraessEverybodyIsFasterWithoutTheBridge) {
  World world = World::from_file("scenes/studies/braess.json");
  ASSERT_TRUE(world.settle(100));
  EXPECT_NEAR(world.number("a_start", "traffic_zone.mean_travel_time"), 92, 1e-3);
  EXPECT_NEAR(world.number("s5_bridge", "street.flow_forth"), 2, 1e-4);
  ASSERT_EQ(world.submit(command<SetPort>({.node = "bridge_open", .port = {"control.value"}, .value = {"0"}})), "");
  world.tick(3);  // control, link, network: one effect a tick
  ASSERT_TRUE(world.settle(100));
  EXPECT_NEAR(world.number("a_start", "traffic_zone.mean_travel_time"), 83, 1e-3);
  EXPECT_NEAR(world.number("s1_start_north", "street.flow_forth"), 3, 1e-4);
  EXPECT_EQ(world.text("s5_bridge", "street.reason"), "it is closed");
}

TEST(TrafficNetwork, ASavedStateGoesOnBitForBit) {
  const std::string text = project_file("scenes/nodes/traffic_network.json");
  World one = World::from_text(text);
  one.tick(2);
  const SavedState saved = save(one.state());
  World two = World::from_text(write_scene(one.state().plan->scene, full_registry(), &saved));
  for (int i = 0; i < 5; ++i) {
    one.tick();
    two.tick();
    ASSERT_EQ(one.state().hash, two.state().hash) << "tick " << i;
  }
}

TEST(TrafficNetwork, FiguresThatAnOlderProgramKeptAreNoReasonToLoseAScene) {
  const SceneReading reading = read_scene(
      R"({"format": "behaviourlinks", "version": 1, "nodes": [{"id": "n", "types": {"traffic_network": {}}}],
          "state": {"tick": 5, "nodes": {"n": {"traffic_network.flows": [{"origin": "a", "link": "b", "flow": 3}]}}}})",
      full_registry());
  EXPECT_TRUE(reading.is_usable());
  ASSERT_EQ(reading.problems.size(), 1u);
  EXPECT_NE(reading.problems.front().error.text().find("worked out again"), std::string::npos);
}

TEST(TrafficNetwork, AnEditIsAnsweredFromTheOldFlows) {
  World world = World::from_file("scenes/nodes/traffic_network.json");
  ASSERT_TRUE(world.settle(200));
  ASSERT_EQ(world.submit(command<SetPort>({.node = "e11", .port = {"street.open"}, .value = {"0"}})), "");
  world.tick();
  EXPECT_EQ(world.number("e11", "street.flow_forth"), 0);
  EXPECT_LT(world.number("network", "traffic_network.relative_gap"), 1e-3) << "one tick from the old flows";
  ASSERT_TRUE(world.settle(200));
  EXPECT_NEAR(world.number("network", "traffic_network.trips"), 1260, 1e-6);
}

TEST(TrafficNetwork, TwoNetworksCannotHaveOneStreet) {
  World world = World::from_file("scenes/nodes/street.json");
  ASSERT_EQ(world.submit(command<AddNode>({.id = "other", .node = {R"({"types": {"traffic_network": {}}})"}})), "");
  world.tick(2);
  EXPECT_NE(world.node_error("other", "traffic_network").find("already belongs to `network`"), std::string::npos);
}

}  // namespace
}  // namespace bl
