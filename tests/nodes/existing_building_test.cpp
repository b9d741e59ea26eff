// Existing buildings: volumes and areas by hand, closed meshes, and what is wrong with outlines.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "tests/nodes/scene_text.h"
#include "tests/support/world.h"

namespace bl {
namespace {

// How many edges of the mesh are not run along once in each direction.
std::size_t open_edges(const Mesh& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> sums;
  for (const auto& t : mesh.triangles)
    for (std::size_t i = 0; i < 3; ++i) {
      const auto a = t[i], b = t[(i + 1) % 3];
      sums[{std::min(a, b), std::max(a, b)}] += a < b ? 1 : -1;
    }
  return static_cast<std::size_t>(std::count_if(sums.begin(), sums.end(), [](const auto& entry) { return entry.second != 0; }));
}

TEST(ExistingBuilding, SceneHasTheVolumesOfTheHand) {
  World world = World::from_file("scenes/nodes/existing_building.json");
  ASSERT_TRUE(world.settle());
  EXPECT_DOUBLE_EQ(world.number("house", "existing_building.volume"), 640);
  EXPECT_DOUBLE_EQ(world.number("house", "existing_building.floor_area"), 200);
  EXPECT_EQ(world.number("house", "existing_building.is_assumed"), 0);
  // 40 x 30 less a court of 20 x 10.
  EXPECT_DOUBLE_EQ(world.number("block", "existing_building.footprint"), 1000);
  EXPECT_DOUBLE_EQ(world.number("block", "existing_building.volume"), 12800);
  EXPECT_DOUBLE_EQ(world.number("block", "existing_building.floor_area"), 4000);
  EXPECT_EQ(world.number("block", "existing_building.is_assumed"), 1);
  EXPECT_DOUBLE_EQ(world.number("tower", "existing_building.top"), 32.8);
  // A box of 3 m and a roof of 2 m over 10 x 10.
  EXPECT_DOUBLE_EQ(world.number("shed", "existing_building.volume"), 400);
  EXPECT_DOUBLE_EQ(world.number("shed", "existing_building.top"), 5);
  for (const char* node : {"house", "block", "tower", "shed"}) {
    const MeshPointer mesh = world.mesh(node, "existing_building.mesh");
    EXPECT_EQ(open_edges(*mesh), 0u) << node;
    EXPECT_NEAR(enclosed_volume(*mesh), world.number(node, "existing_building.volume"), 1e-9) << node;
  }
}

TEST(ExistingBuilding, EitherTurningIsTheSameBuilding) {
  World world =
      World::from_text(one_node("existing_building", R"("outline": [[0, 0, 0], [0, 4, 0], [4, 4, 0], [4, 0, 0]], "height": 5)"));
  world.tick();
  EXPECT_EQ(world.node_error("it", "existing_building"), "");
  EXPECT_DOUBLE_EQ(enclosed_volume(*world.mesh("it", "existing_building.mesh")), 80);
}

TEST(ExistingBuilding, WhatIsWrongIsSaid) {
  const auto error = [](const std::string& ports) {
    World world = World::from_text(one_node("existing_building", ports));
    world.tick();
    return world.node_error("it", "existing_building");
  };
  EXPECT_EQ(error(R"("outline": [[0, 0, 0], [4, 4, 0], [4, 0, 0], [0, 4, 0]])"),
            "nodes/it/existing_building/outline: the ring meets itself at (2.000, 2.000): redraw it there");
  EXPECT_EQ(error(R"("outline": [[0, 0, 0], [4, 4, 0]])"),
            "nodes/it/existing_building/outline: a ring needs at least 3 corners; this one has 2");
  EXPECT_EQ(error(R"("form": "mesh", "vertices": [[0, 0, 0]], "triangles": [{"a": 0, "b": 1, "c": 2}])"),
            "nodes/it/existing_building/triangles/0: names a vertex that does not exist, 1");
  EXPECT_NE(error(R"("form": "mesh")"), "");
}

}  // namespace
}  // namespace bl
