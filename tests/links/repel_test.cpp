// Repel: the push by hand, nodes on one point, and pavilions that find room.
#include "tests/links/link_case.h"

namespace bl {
namespace {

LinkCase push(const char* from_id, Point3 from, const char* to_id, Point3 to) {
  LinkCase link("repel");
  link.set("reach", 20.0).set("stiffness", 0.2).from("node.position", from).to("node.position", to);
  link.from("node.id", std::string(from_id)).to("node.id", std::string(to_id));
  return link;
}

TEST(Repel, FallsOffLinearlyToTheReach) {
  for (const auto& [x, half] : {std::pair{1.0, 1.9}, {10.0, 1.0}, {15.0, 0.5}}) {
    auto link = push("a", {0, 0, 0}, "b", {x, 0, 0});
    ASSERT_EQ(link.run(), "");
    expect_near(link.move(End::from), {-half, 0, 0});
    expect_near(link.move(End::to), {half, 0, 0});
  }
  auto far = push("a", {0, 0, 0}, "b", {20, 0, 0});
  ASSERT_EQ(far.run(), "");
  EXPECT_FALSE(far.moves(End::from));
}

TEST(Repel, NodesOnOnePointPartTheSameWayWhicheverIsAskedFirst) {
  auto link = push("a", {5, 5, 5}, "b", {5, 5, 5});
  auto turned = push("b", {5, 5, 5}, "a", {5, 5, 5});
  ASSERT_EQ(link.run(), "");
  ASSERT_EQ(turned.run(), "");
  EXPECT_NEAR(norm(link.move(End::to)), 2, 1e-12);
  EXPECT_EQ(link.move(End::to).z, 0);
  EXPECT_EQ(link.move(End::to), -link.move(End::from));
  EXPECT_EQ(link.move(End::to), turned.move(End::from));
}

TEST(Repel, SceneGivesEveryPavilionItsRoom) {
  World world = World::from_file("scenes/links/repel.json");
  ASSERT_TRUE(world.settle(1000));
  world.tick(300);
  for (int a = 1; a <= 5; ++a)
    for (int b = a + 1; b <= 5; ++b) {
      const auto place = [&](int i) { return world.point("pavilion_" + std::to_string(i), "node.position"); };
      EXPECT_GT(distance(place(a), place(b)), 21) << a << " and " << b;
    }
}

}  // namespace
}  // namespace bl
