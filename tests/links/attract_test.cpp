// Attract: the spring by hand, its rest, and houses that gather around a court.
#include "tests/links/link_case.h"

namespace bl {
namespace {

LinkCase spring(Point3 from, Point3 to) {
  LinkCase link("attract");
  link.set("rest", 20.0).set("stiffness", 0.2).from("node.position", from).to("node.position", to);
  return link;
}

TEST(Attract, EachEndGoesHalfOfTheShare) {
  auto link = spring({0, 0, 0}, {30, 0, 0});  // 10 m beyond rest, a fifth of that is 2 m
  ASSERT_EQ(link.run(), "");
  expect_near(link.move(End::from), {1, 0, 0});
  expect_near(link.move(End::to), {-1, 0, 0});
}

TEST(Attract, NeverPushesAndHasNoDirectionOnOnePoint) {
  for (const double x : {0.0, 5.0, 20.0}) {
    auto link = spring({0, 0, 0}, {x, 0, 0});
    ASSERT_EQ(link.run(), "");
    EXPECT_FALSE(link.moves(End::from)) << x;
    EXPECT_FALSE(link.moves(End::to)) << x;
  }
  auto together = spring({1, 2, 3}, {1, 2, 3});
  ASSERT_EQ(together.set("rest", 0.0).run(), "");
  EXPECT_FALSE(together.moves(End::to));
}

TEST(Attract, InPlanLeavesHeightsAlone) {
  auto link = spring({0, 0, 0}, {30, 0, 40});
  ASSERT_EQ(link.set("in_plan", true).run(), "");
  expect_near(link.move(End::to), {-1, 0, 0});
}

TEST(Attract, SceneGathersTheHousesAroundTheFixedCourt) {
  World world = World::from_file("scenes/links/attract.json");
  ASSERT_TRUE(world.settle());
  world.tick(100);
  EXPECT_EQ(world.point("court", "node.position"), (Point3{30, 20, 4}));
  for (const char* house : {"house_1", "house_2", "house_3", "house_4"}) {
    Vector3 way = world.point(house, "node.position") - world.point("court", "node.position");
    way.z = 0;
    EXPECT_LT(norm(way), 15.1) << house;
  }
}

}  // namespace
}  // namespace bl
