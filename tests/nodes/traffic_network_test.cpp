// The network: what leaves arrives, a saved state goes on, Braess's streets, and faults that keep the last good figures.
#include <map>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/file/scene_file.h"
#include "core/traffic/trip_flows.h"
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
    const Numbers& trips = ways.numbers(r, "trips");
    ASSERT_LT(place, trips->size());
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

TEST(TrafficNetwork, TripsThatOlderFilesHeldAsDigitsAreTheSame) {
  World now = World::from_file("scenes/nodes/traffic_network.json");
  now.tick(2);
  const SavedState saved = save(now.state());
  Json file = *parse_json(write_scene(now.session().scene(), full_registry(), &saved));
  Json& ways = file["state"]["nodes"]["network"]["traffic_network.ways"];
  ASSERT_FALSE(ways.empty());
  for (Json& row : ways) {
    row["links"] = digits_of(row.value("links", std::vector<std::uint32_t>()));
    for (const char* list : {"flows", "trips"}) row[list] = digits_of(row.value(list, std::vector<double>()));
  }
  file["state"].erase("check");  // older files have none
  World old = World::from_text(write_json(file));
  for (int i = 0; i < 3; ++i, now.tick(), old.tick()) ASSERT_EQ(old.state().hash, now.state().hash) << i;
}

TEST(TrafficNetwork, ItsFlowsAreHandedOnByStreet) {
  World world = World::from_file("scenes/nodes/traffic_network.json");
  ASSERT_TRUE(world.settle(200));
  const auto flows = std::get<Made>(value_in(world.state(), "network", "traffic_network.trip_flows")).get<traffic::TripFlows>();
  ASSERT_NE(flows, nullptr);
  std::map<std::string, double> by_place;
  for (const traffic::TripFlows::Zone& zone : flows->zones)
    for (std::size_t k = 0; k < zone.links->size(); ++k) by_place[flows->places.at((*zone.links)[k])] += (*zone.flows)[k];
  for (const char* street : {"e11", "e12"})
    EXPECT_NEAR(by_place[street], world.number(street, "street.flow_forth") + world.number(street, "street.flow_back"), 1e-6)
        << street;
}

TEST(TrafficNetwork, FiguresThatAnOlderProgramKeptAreNoReasonToLoseAScene) {
  const SceneReading reading = read_scene(
      R"({"format": "behaviourlinks", "version": 1, "nodes": [{"id": "n", "types": {"traffic_network": {}}}],
          "state": {"tick": 5, "nodes": {"n": {"traffic_network.flows": [{"origin": "a", "link": "b", "flow": 3}]}}}})",
      full_registry());
  EXPECT_TRUE(reading.is_usable());
  ASSERT_EQ(reading.problems.size(), 1u);
  EXPECT_NE(reading.problems.front().error.text().find("computed again"), std::string::npos);
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
