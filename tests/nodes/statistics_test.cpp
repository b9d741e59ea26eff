// Statistics: numbers that can be checked by hand, over sets chosen in each way.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/nodes/scene_text.h"
#include "tests/support/world.h"

namespace bl {
namespace {

std::string volumes_and(const std::string& statistics) {
  return scene_text(
      R"({"id": "a", "tags": ["x"], "types": {"smart_volume": {"demand": 2}}}, {"id": "b", "types": {"smart_volume": {"demand": 4}}},
                       {"id": "c", "tags": ["x"], "types": {"smart_volume": {"demand": 9}}}, {"id": "plain", "tags": ["x"], "types": {}},
                       {"id": "it", "types": {"statistics": {)" +
      statistics + "}}}");
}

TEST(Statistics, SumMeanExtremesAndSpread) {
  World world = World::from_text(volumes_and(R"("port": "smart_volume.demand")"));
  world.tick();
  EXPECT_EQ(world.node_error("it", "statistics"), "");
  EXPECT_EQ(world.number("it", "statistics.count"), 3);
  EXPECT_EQ(world.number("it", "statistics.sum"), 15);
  EXPECT_EQ(world.number("it", "statistics.mean"), 5);
  EXPECT_EQ(world.number("it", "statistics.minimum"), 2);
  EXPECT_EQ(world.number("it", "statistics.maximum"), 9);
  EXPECT_NEAR(world.number("it", "statistics.spread"), std::sqrt((9 + 1 + 16) / 3.0), 1e-15);
}

TEST(Statistics, ATagLeavesOutNodesWithoutThePort) {
  World world = World::from_text(volumes_and(R"("nodes": {"tag": "x"}, "port": "smart_volume.demand")"));
  world.tick();
  EXPECT_EQ(world.node_error("it", "statistics"), "");
  EXPECT_EQ(world.number("it", "statistics.count"), 2);
  EXPECT_EQ(world.number("it", "statistics.sum"), 11);
}

TEST(Statistics, ANamedNodeMustHaveThePort) {
  World world = World::from_text(volumes_and(R"("nodes": ["a", "plain"], "port": "smart_volume.demand")"));
  world.tick();
  EXPECT_EQ(world.node_error("it", "statistics"), "nodes/it/statistics/nodes: the node `plain` has no `smart_volume.demand`");
}

TEST(Statistics, AnEmptySetCountsAsNothing) {
  World world = World::from_text(one_node("statistics", ""));
  world.tick();
  EXPECT_EQ(world.node_error("it", "statistics"), "");
  for (const char* port : {"sum", "mean", "minimum", "maximum", "spread", "count"})
    EXPECT_EQ(world.number("it", std::string("statistics.") + port), 0) << port;
}

TEST(Statistics, APortHasToBeChosen) {
  World world = World::from_text(volumes_and(R"("port": "")"));
  world.tick();
  EXPECT_EQ(world.node_error("it", "statistics"),
            "nodes/it/statistics/port: no port is chosen: choose one, such as `smart_volume.volume`");
}

TEST(Statistics, UnitsAreThoseOfThePort) {
  World world = World::from_text(volumes_and(R"("port": "smart_volume.storey_height")"));
  const Plan& plan = *world.state().plan;
  const TypificationDefinition& type = *full_registry().typification("statistics");
  EXPECT_EQ(unit_of(full_registry(), plan.scene.nodes.at("it"), type, *type.find_port("mean")), Unit::metre);
  EXPECT_EQ(unit_of(full_registry(), plan.scene.nodes.at("it"), type, *type.find_port("count")), Unit::count);
}

TEST(Statistics, WholeNumbersAndSwitchesCountAsNumbers) {
  World world = World::from_text(
      scene_text(R"({"id": "a", "types": {"control": {"is_switch": true}}}, {"id": "b", "types": {"control": {}}},
      {"id": "it", "types": {"statistics": {"nodes": {"typification": "control"}, "port": "control.is_switch"}}})"));
  world.tick();
  EXPECT_EQ(world.number("it", "statistics.mean"), 0.5);
}

TEST(Statistics, SceneSettles) {
  World world = World::from_file("scenes/nodes/statistics.json");
  EXPECT_TRUE(world.settle());
  EXPECT_EQ(world.number("demands", "statistics.sum"), 12000);
  EXPECT_NEAR(world.number("heights", "statistics.mean"), 3.8, 1e-12);
  EXPECT_NEAR(world.number("heights", "statistics.spread"), 0.2, 1e-12);
}

}  // namespace
}  // namespace bl
