// The record of an import: what it says of a node that no import can know again.
#include <gtest/gtest.h>

#include "tests/support/world.h"

namespace bl {
namespace {

TEST(Imported, SceneIsWhatItSays) {
  World world = World::from_file("scenes/nodes/imported.json");
  EXPECT_TRUE(world.settle(20));
  EXPECT_EQ(world.text("building_w12", "imported.message"), "");
  EXPECT_EQ(world.text("shed", "imported.message"), "no import knows this node again: it has no source or no element");
}

}  // namespace
}  // namespace bl
