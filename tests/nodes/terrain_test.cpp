// Terrain: rows of text as heights, their figures by hand, and rows that are damaged.
#include <gtest/gtest.h>

#include "tests/nodes/scene_text.h"
#include "tests/support/world.h"

namespace bl {
namespace {

TEST(Terrain, SceneHasTheFiguresOfTheHand) {
  World world = World::from_file("scenes/nodes/terrain.json");
  ASSERT_TRUE(world.settle());
  EXPECT_EQ(world.number("ground", "terrain.columns"), 5);
  EXPECT_EQ(world.number("ground", "terrain.row_count"), 5);
  EXPECT_EQ(world.number("ground", "terrain.without_height"), 5);
  EXPECT_EQ(world.number("ground", "terrain.width"), 40);
  EXPECT_EQ(world.number("ground", "terrain.minimum"), 2);
  EXPECT_NEAR(world.number("ground", "terrain.maximum"), 5, 1e-12);
  EXPECT_NEAR(world.number("ground", "terrain.mean"), 3.5, 1e-12);
  // Three by four quads have all four corners.
  EXPECT_EQ(world.mesh("ground", "terrain.mesh")->triangles.size(), 24u);
}

TEST(Terrain, DigitsCountStepsAboveTheLowest) {
  World world = World::from_text(
      one_node("terrain", R"("rows": [{"heights": "AAAAAB"}, {"heights": "ABA///"}], "lowest": -5, "step": 0.5)"));
  world.tick();
  EXPECT_EQ(world.node_error("it", "terrain"), "");
  EXPECT_EQ(world.number("it", "terrain.minimum"), -5);
  EXPECT_EQ(world.number("it", "terrain.maximum"), -5 + 0.5 * 262143);
  EXPECT_DOUBLE_EQ(world.number("it", "terrain.mean"), -5 + 0.5 * (0 + 1 + 64 + 262143) / 4.0);
}

TEST(Terrain, DamagedRowsAreSaid) {
  const auto error = [](const std::string& rows) {
    World world = World::from_text(one_node("terrain", "\"rows\": [" + rows + "]"));
    world.tick();
    return world.node_error("it", "terrain");
  };
  EXPECT_EQ(error(R"({"heights": "AAAAAA"}, {"heights": "AAA"})"),
            "nodes/it/terrain/rows/1/heights: a row needs three characters for each cell, and as many cells as the first row: "
            "import the grid again");
  EXPECT_EQ(error(R"({"heights": "AAA A "})"),
            "nodes/it/terrain/rows/0/heights: character 4 is no digit of base 64: import the grid again");
  EXPECT_EQ(error(""), "");
}

}  // namespace
}  // namespace bl
