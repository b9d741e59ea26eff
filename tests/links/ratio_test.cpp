// Ratio: the product by hand, and a chain of volumes.
#include "tests/links/link_case.h"

namespace bl {
namespace {

TEST(Ratio, IsTheMultipleOfTheVolumeReached) {
  LinkCase link("ratio");
  ASSERT_EQ(link.set("ratio", 0.25).from("smart_volume.volume", 8000.0).run(), "");
  EXPECT_EQ(link.number(End::to, "smart_volume.demand"), 2000);
  ASSERT_EQ(link.from("smart_volume.volume", 0.0).run(), "");
  EXPECT_EQ(link.number(End::to, "smart_volume.demand"), 0);
}

TEST(Ratio, SceneRunsAlongTheChain) {
  World world = World::from_file("scenes/links/ratio.json");
  ASSERT_TRUE(world.settle());
  world.tick(20);
  EXPECT_NEAR(world.number("parking", "smart_volume.volume"), 2000, 20);
  EXPECT_NEAR(world.number("shop", "smart_volume.volume"), 1000, 15);
}

}  // namespace
}  // namespace bl
