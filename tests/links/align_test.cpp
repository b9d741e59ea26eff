// Align: coordinates and grids by hand, and offices that find their grid.
#include <cmath>
#include <numbers>

#include "tests/links/link_case.h"

namespace bl {
namespace {

Vector3 aligned(const std::string& mode, Point3 from, Point3 to, double angle = 0) {
  LinkCase link("align");
  link.set("mode", mode).set("module", 10.0).set("angle", angle).set("stiffness", 1.0);
  link.from("node.position", from).to("node.position", to);
  EXPECT_EQ(link.run(), "");
  EXPECT_FALSE(link.moves(End::from));
  return link.move(End::to);
}

TEST(Align, SharesOneCoordinate) {
  expect_near(aligned("x", {1, 2, 3}, {5, 6, 7}), {-4, 0, 0});
  expect_near(aligned("y", {1, 2, 3}, {5, 6, 7}), {0, -4, 0});
  expect_near(aligned("z", {1, 2, 3}, {5, 6, 7}), {0, 0, -4});
}

TEST(Align, GoesToTheNearestGridPointAndKeepsItsHeight) {
  expect_near(aligned("grid", {0, 0, 0}, {12, -26, 9}), {-2, -4, 0});
  expect_near(aligned("grid", {1, 1, 0}, {1, 1, 5}), {0, 0, 0});
  // Turned by 45 degrees the grid has a point at (7.07, 7.07).
  const double half = 10 / std::numbers::sqrt2;
  expect_near(aligned("grid", {0, 0, 0}, {half + 1, half, 0}, 45), {-1, 0, 0});
}

TEST(Align, StiffnessIsTheShareOfOneTick) {
  LinkCase link("align");
  link.set("stiffness", 0.25).from("node.position", Point3{0, 0, 0}).to("node.position", Point3{8, 1, 1});
  ASSERT_EQ(link.run(), "");
  expect_near(link.move(End::to), {-2, 0, 0});
}

TEST(Align, SceneBringsTheOfficesOntoTheTurnedGrid) {
  World world = World::from_file("scenes/links/align.json");
  ASSERT_TRUE(world.settle());
  world.tick(100);
  const double turn = 10 * std::numbers::pi / 180;
  for (const char* office : {"office_1", "office_2", "office_3"}) {
    const Vector3 way = world.point(office, "node.position") - world.point("core", "node.position");
    const double along = way.x * std::cos(turn) + way.y * std::sin(turn),
                 across = way.y * std::cos(turn) - way.x * std::sin(turn);
    EXPECT_NEAR(along / 16.2, std::round(along / 16.2), 1e-3) << office;
    EXPECT_NEAR(across / 16.2, std::round(across / 16.2), 1e-3) << office;
  }
  EXPECT_NEAR(world.point("tower", "node.position").z, 8, 1e-3);
  EXPECT_NEAR(world.point("tower", "node.position").x, 30, 1e-3);
}

}  // namespace
}  // namespace bl
