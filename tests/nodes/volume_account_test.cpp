// The volume account: what may be had, by hand.
#include <gtest/gtest.h>

#include "tests/nodes/scene_text.h"
#include "tests/support/world.h"

namespace bl {
namespace {

TEST(VolumeAccount, TheRightIsTheAllotmentAndWhatWasBought) {
  World world = World::from_text(one_node("volume_account", R"("allotment": 500, "bought": -120, "paid": -48000)"));
  world.tick(3);
  EXPECT_EQ(world.number("it", "volume_account.right"), 380);
  EXPECT_EQ(world.number("it", "volume_account.paid"), -48000) << "nobody trades, and nothing changes";
}

TEST(VolumeAccount, SceneIsWhatItSays) {
  World world = World::from_file("scenes/nodes/volume_account.json");
  EXPECT_TRUE(world.settle(20));
  EXPECT_EQ(world.number("buyer", "volume_account.right"), 2300);
  EXPECT_EQ(world.number("seller", "volume_account.right"), 2700);
}

}  // namespace
}  // namespace bl
