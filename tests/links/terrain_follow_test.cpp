// Terrain follow: bilinear ground by hand, places beside it, and volumes that come to rest above a slope.
#include "tests/links/link_case.h"

namespace bl {
namespace {

// Two by two cells, 10 m apart: 0, 1 in the north, 2, 3 in the south.
LinkCase over(double x, double y, double z) {
  LinkCase link("terrain_follow");
  link.from("terrain.rows", Shared<Table>(Table{{"heights"}, {{std::string("AAAABA")}, {std::string("ACAADA")}}}));
  link.from("terrain.west", 0.0).from("terrain.north", 10.0).from("terrain.cell", 10.0).from("terrain.lowest", 0.0);
  link.from("terrain.step", 1 / 64.0).to("node.position", Vector3{x, y, z});
  return link;
}

TEST(TerrainFollow, GroundBetweenCellsIsBilinear) {
  LinkCase middle = over(5, 5, 0);
  ASSERT_EQ(middle.set("stiffness", 1.0).run(), "");
  expect_near(middle.move(End::to), {0, 0, 1.5});
  LinkCase south = over(2.5, 0, 0);
  ASSERT_EQ(south.set("stiffness", 0.5).set("offset", 4.0).run(), "");
  expect_near(south.move(End::to), {0, 0, 0.5 * (2.25 + 4)});
  LinkCase there = over(10, 10, 1);
  ASSERT_EQ(there.run(), "");
  EXPECT_FALSE(there.moves(End::to));
}

TEST(TerrainFollow, BesideTheGroundIsAnErrorOrLeftAlone) {
  LinkCase beside = over(20, 5, 0);
  EXPECT_EQ(beside.run(), "to: there is no ground at (20.0, 5.0): move the node onto the terrain, or turn `needs_ground` off");
  EXPECT_EQ(beside.set("needs_ground", false).run(), "");
  EXPECT_FALSE(beside.moves(End::to));
}

TEST(TerrainFollow, SceneStandsFiveMetresAboveTheSlope) {
  World world = World::from_file("scenes/links/terrain_follow.json");
  ASSERT_TRUE(world.settle());
  for (const char* node : {"low", "middle", "high"}) {
    const Vector3 p = world.point(node, "node.position");
    EXPECT_NEAR(p.z, 2 + 0.1 * (p.x + 10) + 5, 0.02) << node;
  }
}

}  // namespace
}  // namespace bl
