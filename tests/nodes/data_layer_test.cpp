// Data layers: count, sum, mean and extremes by hand.
#include <gtest/gtest.h>

#include "tests/nodes/scene_text.h"
#include "tests/support/world.h"

namespace bl {
namespace {

TEST(DataLayer, SceneHasTheFiguresOfTheHand) {
  World world = World::from_file("scenes/nodes/data_layer.json");
  ASSERT_TRUE(world.settle());
  EXPECT_EQ(world.number("noise", "data_layer.count"), 12);
  EXPECT_EQ(world.number("noise", "data_layer.minimum"), 40);
  EXPECT_EQ(world.number("noise", "data_layer.maximum"), 70);
  EXPECT_EQ(world.number("noise", "data_layer.mean"), 55);
  EXPECT_EQ(world.number("noise", "data_layer.sum"), 660);
}

TEST(DataLayer, AnEmptyOneIsNothing) {
  World world = World::from_text(one_node("data_layer", ""));
  world.tick();
  EXPECT_EQ(world.node_error("it", "data_layer"), "");
  for (const char* port : {"count", "sum", "mean", "minimum", "maximum"})
    EXPECT_EQ(world.number("it", std::string("data_layer.") + port), 0);
}

}  // namespace
}  // namespace bl
