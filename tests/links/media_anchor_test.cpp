// Media anchor: a step by hand, and a board that comes to its house.
#include "tests/links/link_case.h"

namespace bl {
namespace {

TEST(MediaAnchor, GoesItsShareOfTheWay) {
  LinkCase link("media_anchor");
  link.set("x", 1.0).set("y", 0.0).set("z", 2.0).set("share", 0.25).from("media.opacity", 1.0);
  link.from("node.position", Point3{0, 0, 0}).to("node.position", Point3{7, 4, 0});
  ASSERT_EQ(link.run(), "");
  expect_near(link.move(End::from), {2, 1, 0.5});
  link.from("node.position", Point3{8, 4, 2});
  ASSERT_EQ(link.run(), "");
  EXPECT_FALSE(link.moves(End::from)) << "it is there";
}

TEST(MediaAnchor, SceneBringsTheBoardToTheHouse) {
  World world = World::from_file("scenes/links/media_anchor.json");
  ASSERT_TRUE(world.settle());
  world.tick(60);
  EXPECT_NEAR(world.point("board", "node.position").y, world.point("house", "node.position").y - 22, 1e-3);
}

}  // namespace
}  // namespace bl
