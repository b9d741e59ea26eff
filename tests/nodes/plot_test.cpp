// Plots: the density figures follow from the volumes on them, and overshoots from the rules.
#include <gtest/gtest.h>

#include <algorithm>

#include "core/reading/plot_problems.h"
#include "tests/nodes/scene_text.h"
#include "tests/support/world.h"

namespace bl {
namespace {

TEST(Plot, FiguresFollowFromTheVolumesOnIt) {
  World world = World::from_file("scenes/nodes/plot.json");
  ASSERT_TRUE(world.settle());
  const auto of = [&](const char* node, const char* port) { return world.number(node, std::string("smart_volume.") + port); };
  EXPECT_EQ(world.number("plot", "plot.count"), 2);
  EXPECT_EQ(world.number("plot", "plot.area"), 1600);
  const double floor = of("west", "floor_area") + of("east", "floor_area"),
               ground = of("west", "footprint") + of("east", "footprint");
  EXPECT_NEAR(world.number("plot", "plot.floor_area"), floor, 1e-6 * floor);
  EXPECT_NEAR(world.number("plot", "plot.fsi"), floor / 1600, 1e-6);
  EXPECT_NEAR(world.number("plot", "plot.gsi"), ground / 1600, 1e-6);
  EXPECT_NEAR(world.number("plot", "plot.osr"), (1 - ground / 1600) / (floor / 1600), 1e-6);
  EXPECT_NEAR(world.number("plot", "plot.layers"), floor / ground, 1e-6);
  EXPECT_EQ(world.number("plot", "plot.overshoot"), 0);
}

TEST(Plot, OvershootIsTheWorstShare) {
  World world = World::from_file("scenes/nodes/plot.json");
  const auto rule = [&](const char* port, const char* value) {
    EXPECT_EQ(world.submit(command<SetPort>({"plot", {std::string("plot.") + port}, {value}})), "");
  };
  rule("fsi_max", "0.5");
  rule("height_max", "5");
  ASSERT_TRUE(world.settle());
  const double fsi = world.number("plot", "plot.fsi"), top = world.number("plot", "plot.top");
  EXPECT_NEAR(world.number("plot", "plot.floor_overshoot"), (fsi - 0.5) * 1600, 1e-6);
  EXPECT_NEAR(world.number("plot", "plot.height_overshoot"), top - 5, 1e-9);
  EXPECT_NEAR(world.number("plot", "plot.overshoot"), std::max((fsi - 0.5) / 0.5, (top - 5) / 5), 1e-9);
  rule("setback", "10");
  world.tick(2);
  EXPECT_GT(world.number("plot", "plot.setback_overshoot"), 1);
}

TEST(Plot, AnEmptyPlotHasNoDensity) {
  World world = World::from_text(one_node("plot", ""));
  world.tick();
  EXPECT_EQ(world.node_error("it", "plot"), "");
  for (const char* port : {"count", "fsi", "gsi", "osr", "layers", "overshoot"})
    EXPECT_EQ(world.number("it", std::string("plot.") + port), 0);
  World crossed = World::from_text(one_node("plot", R"("polygon": [[0, 0, 0], [4, 4, 0], [4, 0, 0], [0, 4, 0]])"));
  crossed.tick();
  EXPECT_EQ(crossed.node_error("it", "plot"),
            "nodes/it/plot/polygon: the polygon meets itself at (2.000, 2.000): redraw it there");
}

// Beside a volume that stands on the ground one that begins in the upper half of the lowest storey, and one above it.
TEST(Plot, AFootprintFadesInTheUpperHalfOfTheLowestStorey) {
  const TypificationDefinition& plot = *full_registry().typification("plot");
  const auto footprint = [&](double bottom) {
    std::vector<Value> values;
    for (const PortDefinition& port : plot.ports) values.push_back(port.default_value);
    SetValues set;
    set.members = 1;
    for (const ReadDefinition& read : plot.sets.front().reads) {
      const std::string& port = read.path.port;
      if (read.kind == ValueKind::point) set.reads.emplace_back(Vector3{});
      else if (read.kind == ValueKind::text) set.reads.emplace_back(std::string("it"));
      else set.reads.emplace_back(port == "bottom" ? bottom : port == "storey_height" ? 4.0 : 100.0);
    }
    std::vector<SetValues> sets(plot.sets.size());  // nothing stands
    sets.front() = std::move(set);
    EXPECT_TRUE(plot.evaluate(values, sets, Tick{}).ok());
    return as_number(values[plot.port_index("footprint")]);
  };
  EXPECT_EQ(footprint(-3), 100);
  EXPECT_EQ(footprint(2), 100);
  EXPECT_DOUBLE_EQ(footprint(3), 50);
  EXPECT_EQ(footprint(4), 0);
  EXPECT_EQ(footprint(20), 0);
}

// What stands begins on its ground: no place of its position makes it lower.
TEST(Plot, WhatStandsIsNotToldToMoveDown) {
  World world = World::from_text(R"({"format": "behaviourlinks", "version": 1, "nodes": [
    {"id": "house", "position": [20, 20, 15],
     "types": {"smart_volume": {"demand": 2400, "storey_height": 3}, "footprint": {"storeys": 8}}},
    {"id": "plot", "types": {"plot": {"polygon": [[0,0,0],[40,0,0],[40,40,0],[0,40,0]], "height_max": 12}}},
    {"id": "site", "types": {"boundary": {"form": "plan", "plan": [[0,0,0],[40,0,0],[40,40,0],[0,40,0]], "height": 60}}},
    {"id": "solver", "types": {"standing_solver": {}}}]})");
  ASSERT_TRUE(world.settle());
  EXPECT_NEAR(world.number("plot", "plot.height_overshoot"), 12, 1e-9);
  EXPECT_EQ(world.text("plot", "plot.message"), "");
}

TEST(Plot, OvershootHasALargestValue) {
  World world = World::from_file("scenes/nodes/plot.json");
  for (const char* port : {"plot.gsi_max", "plot.height_max", "plot.fsi_max"})
    ASSERT_EQ(world.submit(command<SetPort>({.node = "plot", .port = {port}, .value = {"1e-300"}})), "");
  world.tick(3);
  EXPECT_EQ(world.number("plot", "plot.overshoot"), 1e6);
}

// On a slope from 0 to 5 m: what stands covers the ground that it stands on, and a tower on a roof covers none.
TEST(Plot, WhatStandsOnASlopeIsBuiltGround) {
  World world = World::from_text(R"({"format": "behaviourlinks", "version": 1, "nodes": [
    {"id": "land", "types": {"plot": {"polygon": [[0,0,0],[80,0,0],[80,40,0],[0,40,0]], "gsi_max": 0.1},
                             "boundary": {"form": "plan", "plan": [[0,0,0],[80,0,0],[80,40,0],[0,40,0]], "height": 40}}},
    {"id": "low", "position": [14, 20, 0], "types": {"smart_volume": {"demand": 1200, "storey_height": 3}, "footprint": {"storeys": 2}}},
    {"id": "middle", "position": [38, 20, 0], "types": {"smart_volume": {"demand": 1200, "storey_height": 3},
                                                        "footprint": {"storeys": 2, "ground": 2}}},
    {"id": "high", "position": [64, 20, 0], "types": {"smart_volume": {"demand": 1200, "storey_height": 3},
                                                      "footprint": {"storeys": 2, "ground": 5}}},
    {"id": "tower", "position": [14, 20, 0], "types": {"smart_volume": {"demand": 300, "storey_height": 3},
                                                       "footprint": {"storeys": 1, "bases": ["low"]}}},
    {"id": "solver", "types": {"standing_solver": {"tolerance": 1e-9}}}], "links": []})");
  ASSERT_TRUE(world.settle());
  ASSERT_EQ(world.text("tower", "smart_volume.stands_on"), "low");
  ASSERT_EQ(world.number("high", "smart_volume.bottom"), 5);
  EXPECT_NEAR(world.number("land", "plot.footprint"), 600, 1e-5);
  EXPECT_NEAR(world.number("land", "plot.gsi"), world.number("solver", "standing_solver.gsi"), 1e-9);
  const auto broken = reading::broken_rules(world.state());
  ASSERT_EQ(broken.size(), 1u);
  EXPECT_EQ(broken.front().volumes.size(), 3u) << broken.front().text;
}

}  // namespace
}  // namespace bl
