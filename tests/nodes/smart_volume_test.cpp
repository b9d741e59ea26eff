// SmartVolume: what it wants, what it is told about its shape, and what it says when nobody takes care of it.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/nodes/scene_text.h"
#include "tests/support/world.h"

namespace bl {
namespace {

constexpr const char* kPlot =
    R"({"id": "plot", "types": {"boundary": {"form": "plan", "plan": [[-50,-50,0],[50,-50,0],[50,50,0],[-50,50,0]], "bottom": -50, "height": 100}}})";
constexpr const char* kSolver = R"({"id": "solver", "types": {"smart_volumes_solver": {}}})";

TEST(SmartVolume, IsIdleWithoutASolver) {
  World world = World::from_text(one_node("smart_volume", ""));
  world.tick();
  EXPECT_EQ(world.text("it", "smart_volume.state"), "idle");
  EXPECT_EQ(world.text("it", "smart_volume.reason"), "no solver takes care of it, or its solver fails");
  EXPECT_EQ(world.number("it", "smart_volume.error"), 1);
  EXPECT_FALSE(world.settle(20));
}

TEST(SmartVolume, AloneItIsABall) {
  const double volume = 4000 * std::numbers::pi / 3;  // radius 10 m
  World world = World::from_text(scene_text(
      std::string(kPlot) + "," + kSolver + "," +
      node_text("v", "[1, 2, 3]", "smart_volume", "\"demand\": " + std::to_string(volume) + ", \"storey_height\": 4")));
  ASSERT_TRUE(world.settle());
  EXPECT_EQ(world.text("v", "smart_volume.state"), "alive");
  EXPECT_EQ(world.text("v", "smart_volume.reason"), "");
  const double radius = world.number("v", "smart_volume.radius");
  EXPECT_NEAR(radius, 10, 0.03);
  EXPECT_NEAR(world.number("v", "smart_volume.weight"), radius * radius, 1e-9);
  EXPECT_NEAR(world.number("v", "smart_volume.volume"), volume, 0.005 * volume);
  EXPECT_NEAR(world.number("v", "smart_volume.cell_volume"), 1e6, 1e-3);
  EXPECT_NEAR(world.number("v", "smart_volume.surface_area"), 4 * std::numbers::pi * radius * radius, 1e-6);
  EXPECT_NEAR(world.number("v", "smart_volume.spherical_area"), world.number("v", "smart_volume.surface_area"), 1e-6);
  EXPECT_NEAR(world.number("v", "smart_volume.footprint"), std::numbers::pi * radius * radius, 1e-6);
  EXPECT_NEAR(world.number("v", "smart_volume.height"), 2 * radius, 1e-9);
  EXPECT_NEAR(world.number("v", "smart_volume.bottom"), 3 - radius, 1e-9);
  EXPECT_NEAR(distance(world.point("v", "smart_volume.centroid"), {1, 2, 3}), 0, 1e-6);
  EXPECT_EQ(world.table("v", "smart_volume.neighbours").rows.size(), 0u);
  // Five storeys of 4 m, cut at their middles: 8, 4, 0, -4 and -8 m from the centre.
  double floors = 0;
  for (int storey = 0; storey < 5; ++storey) {
    const double z = -radius + 2 + 4 * storey;
    if (std::abs(z) < radius) floors += std::numbers::pi * (radius * radius - z * z);
  }
  EXPECT_NEAR(world.number("v", "smart_volume.floor_area"), floors, 0.01 * floors);
  ASSERT_NE(world.mesh("v", "smart_volume.mesh"), nullptr);
}

TEST(SmartVolume, WantsItsDemandWithinLimitAndMinimum) {
  const auto wanted = [](const std::string& ports) {
    World world = World::from_text(
        scene_text(std::string(kPlot) + "," + kSolver + "," + node_text("v", "[0, 0, 0]", "smart_volume", ports)));
    world.tick();
    return world.number("v", "smart_volume.wanted");
  };
  EXPECT_EQ(wanted(R"("demand": 700)"), 700);
  EXPECT_EQ(wanted(R"("demand": 700, "demand_limit": 500)"), 500);
  EXPECT_EQ(wanted(R"("demand": 700, "demand_min": 900)"), 900);
  EXPECT_EQ(wanted(R"("demand": 700, "demand_limit": 500, "demand_min": 600)"), 600);
}

TEST(SmartVolume, WithoutADemandItSaysSoAndIsNoError) {
  World world = World::from_text(scene_text(std::string(kPlot) + "," + kSolver + "," +
                                            node_text("v", "[0, 0, 0]", "smart_volume", R"("demand": 0)") + "," +
                                            node_text("w", "[9, 0, 0]", "smart_volume")));
  ASSERT_TRUE(world.settle());
  EXPECT_EQ(world.number("v", "smart_volume.volume"), 0);
  EXPECT_EQ(world.number("v", "smart_volume.error"), 0);
  EXPECT_EQ(world.text("v", "smart_volume.state"), "starved");
  EXPECT_EQ(world.text("v", "smart_volume.reason"), "wants nothing: raise its demand to give it a volume");
}

TEST(SmartVolume, NeighboursShareOneFace) {
  World world = World::from_text(
      scene_text(std::string(kPlot) + "," + kSolver + "," + node_text("a", "[-4, 0, 0]", "smart_volume") + "," +
                 node_text("b", "[4, 0, 0]", "smart_volume") + "," + node_text("far", "[40, 40, 40]", "smart_volume")));
  ASSERT_TRUE(world.settle());
  const Table& of_a = world.table("a", "smart_volume.neighbours");
  const Table& of_b = world.table("b", "smart_volume.neighbours");
  ASSERT_EQ(of_a.rows.size(), 1u);
  ASSERT_EQ(of_b.rows.size(), 1u);
  EXPECT_EQ(of_a.text(0, "node"), "b");
  EXPECT_EQ(of_b.text(0, "node"), "a");
  EXPECT_GT(of_a.number(0, "area"), 1);
  EXPECT_NEAR(of_a.number(0, "area"), of_b.number(0, "area"), 1e-9);
  EXPECT_EQ(world.table("far", "smart_volume.neighbours").rows.size(), 0u);
}

TEST(SmartVolume, SceneSettles) {
  World world = World::from_file("scenes/nodes/smart_volume.json");
  ASSERT_TRUE(world.settle());
  EXPECT_NEAR(world.number("shop", "smart_volume.volume"), 1400, 14);
  EXPECT_NEAR(world.number("flat_east", "smart_volume.volume"), 900, 9);
  EXPECT_NEAR(world.number("flat_west", "smart_volume.volume"), 900, 9);
}

}  // namespace
}  // namespace bl
