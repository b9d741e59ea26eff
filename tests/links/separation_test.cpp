// Separation: the push by hand, volumes on one point, and rehearsal rooms without common walls.
#include <numbers>

#include "tests/links/link_case.h"

namespace bl {
namespace {

LinkCase separated_rooms(double length, double shared) {
  LinkCase link("separation");
  Table neighbours{{"node", "area"}, {}};
  if (shared > 0) neighbours.rows.push_back({std::string("b"), shared});
  link.set("stiffness", 0.2).from("smart_volume.neighbours", Shared<Table>(neighbours));
  link.from("node.id", std::string("a")).to("node.id", std::string("b"));
  link.from("node.position", Point3{0, 0, 0}).to("node.position", Point3{length, 0, 0});
  link.from("smart_volume.radius", 10.0).to("smart_volume.radius", 10.0);
  return link;
}

TEST(Separation, PushesWhileAFacetIsShared) {
  auto link = separated_rooms(16, 16 * std::numbers::pi);  // 2 · area / (pi · distance) = 2 m, and 5 cm more
  ASSERT_EQ(link.run(), "");
  expect_near(link.move(End::from), {-0.205, 0, 0});
  expect_near(link.move(End::to), {0.205, 0, 0});
  auto cut_off = separated_rooms(16, 0);  // the balls overlap, but something stands between
  ASSERT_EQ(cut_off.run(), "");
  EXPECT_FALSE(cut_off.moves(End::from));
}

TEST(Separation, AGapCountsBetweenTheBalls) {
  auto link = separated_rooms(22, 0);
  ASSERT_EQ(link.set("gap", 5.0).run(), "");
  expect_near(link.move(End::to), {0.3, 0, 0});
  auto wide = separated_rooms(25, 0);
  ASSERT_EQ(wide.set("gap", 5.0).run(), "");
  EXPECT_FALSE(wide.moves(End::to));
}

TEST(Separation, VolumesOnOnePointPart) {
  auto link = separated_rooms(0, 0);
  ASSERT_EQ(link.run(), "");
  EXPECT_NEAR(norm(link.move(End::to)), 0.1, 1e-12);
  EXPECT_EQ(link.move(End::to), -link.move(End::from));
}

TEST(Separation, SceneLeavesNoCommonWall) {
  World world = World::from_file("scenes/links/separation.json");
  ASSERT_TRUE(world.settle());
  world.tick(300);
  for (const char* room : {"room_1", "room_2", "room_3", "studio"})
    EXPECT_TRUE(world.table(room, "smart_volume.neighbours").rows.empty()) << room;
  for (const char* room : {"room_1", "room_2", "room_3"}) {
    const double radii = world.number(room, "smart_volume.radius") + world.number("studio", "smart_volume.radius");
    EXPECT_GT(distance(world.point(room, "node.position"), world.point("studio", "node.position")), radii + 3.9) << room;
  }
}

}  // namespace
}  // namespace bl
