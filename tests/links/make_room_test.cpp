// Make room: the way to the middle of a body by hand, and four workshops on one spot.
#include "tests/links/link_case.h"

namespace bl {
namespace {

LinkCase pressed_body(const Point3& centroid) {
  LinkCase link("make_room");
  link.set("stiffness", 0.5).set("play", 0.1).from("smart_volumes_solver.count", 3.0);
  link.to("node.position", Point3{1, 2, 3})
      .to("smart_volume.centroid", centroid)
      .to("smart_volume.volume", 4188.79);  // radius 10
  return link;
}

TEST(MakeRoom, FollowsTheMiddleOfTheBody) {
  auto off = pressed_body({4, 2, 3});  // 3 m off, of which 1 m is free: half of the rest
  ASSERT_EQ(off.run(), "");
  expect_near(off.move(End::to), {1, 0, 0}, 1e-5);
}

TEST(MakeRoom, LeavesRoundBodiesAndThoseWithoutOne) {
  auto within = pressed_body({1, 2.9, 3}), starved = pressed_body({4, 2, 3}), without_solver = pressed_body({4, 2, 3});
  ASSERT_EQ(within.run(), "");
  ASSERT_EQ(starved.to("smart_volume.volume", 0.0).run(), "");
  ASSERT_EQ(without_solver.from("smart_volumes_solver.count", 0.0).run(), "");
  EXPECT_FALSE(within.moves(End::to));
  EXPECT_FALSE(starved.moves(End::to));
  EXPECT_FALSE(without_solver.moves(End::to));
}

TEST(MakeRoom, ScenePartsTheWorkshops) {
  World world = World::from_file("scenes/links/make_room.json");
  ASSERT_TRUE(world.settle());
  const std::vector<const char*> ids{"glass", "metal", "paint", "wood"};
  for (const char* a : ids)
    for (const char* b : ids) {
      if (a == b) continue;
      const double radii = world.number(a, "smart_volume.radius") + world.number(b, "smart_volume.radius");
      EXPECT_GT(distance(world.point(a, "node.position"), world.point(b, "node.position")), 0.6 * radii) << a << " " << b;
    }
}

}  // namespace
}  // namespace bl
