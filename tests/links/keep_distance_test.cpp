// Keep distance: both limits by hand, the calm between them, and a noisy workshop.
#include "tests/links/link_case.h"

namespace bl {
namespace {

LinkCase range(Point3 from, Point3 to) {
  LinkCase link("keep_distance");
  link.set("minimum", 10.0).set("maximum", 30.0).set("stiffness", 0.5).from("node.position", from).to("node.position", to);
  link.from("node.id", std::string("a")).to("node.id", std::string("b"));
  return link;
}

TEST(KeepDistance, CorrectsBothLimitsAndNothingBetween) {
  auto near = range({0, 0, 0}, {0, 6, 0});  // 4 m missing, half of that is 2 m, each end 1 m
  ASSERT_EQ(near.run(), "");
  expect_near(near.move(End::from), {0, -1, 0});
  expect_near(near.move(End::to), {0, 1, 0});
  auto far = range({0, 0, 0}, {0, 38, 0});
  ASSERT_EQ(far.run(), "");
  expect_near(far.move(End::from), {0, 2, 0});
  expect_near(far.move(End::to), {0, -2, 0});
  for (const double y : {10.0, 20.0, 30.0}) {
    auto inside = range({0, 0, 0}, {0, y, 0});
    ASSERT_EQ(inside.run(), "");
    EXPECT_FALSE(inside.moves(End::from)) << y;
  }
}

TEST(KeepDistance, NodesOnOnePointPartLevel) {
  auto link = range({1, 1, 1}, {1, 1, 1});
  ASSERT_EQ(link.run(), "");
  EXPECT_NEAR(norm(link.move(End::to)), 2.5, 1e-12);
  EXPECT_EQ(link.move(End::to).z, 0);
}

TEST(KeepDistance, CrossedLimitsAreAnError) {
  auto link = range({0, 0, 0}, {1, 0, 0});
  EXPECT_EQ(link.set("minimum", 40.0).run(), "minimum: the minimum is larger than the maximum; swap them or widen the range");
}

TEST(KeepDistance, SceneKeepsTheWorkshopAway) {
  World world = World::from_file("scenes/links/keep_distance.json");
  ASSERT_TRUE(world.settle());
  world.tick(100);
  for (const char* house : {"house_1", "house_2", "house_3"}) {
    Vector3 way = world.point(house, "node.position") - world.point("workshop", "node.position");
    way.z = 0;
    EXPECT_GT(norm(way), 27.9) << house;
    EXPECT_LT(norm(way), 45.1) << house;
  }
}

}  // namespace
}  // namespace bl
