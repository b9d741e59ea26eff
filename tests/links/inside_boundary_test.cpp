// Inside boundary: projections by hand, margins that leave no room, and volumes drawn off the site.
#include "core/geometry/domain_table.h"
#include "tests/links/link_case.h"

namespace bl {
namespace {

// What a boundary makes of such planes.
Value domain_of(const Table& planes) {
  return Made::of<geometry::Domain>([planes = Shared<Table>(planes)] { return geometry::shared_domain(planes); });
}

// A box of 60 x 40 x 30 m; the normal of one side is not of length 1.
Value box() {
  Table planes{{"x", "y", "z", "offset"}, {}};
  planes.rows = {{2.0, 0.0, 0.0, 120.0}, {-1.0, 0.0, 0.0, 0.0}, {0.0, 1.0, 0.0, 40.0},
                 {0.0, -1.0, 0.0, 0.0},  {0.0, 0.0, 1.0, 30.0}, {0.0, 0.0, -1.0, 0.0}};
  return domain_of(planes);
}

LinkCase inside(Point3 position, double margin) {
  LinkCase link("inside_boundary");
  link.set("margin", margin).from("boundary.domain", box()).to("node.position", position);
  return link;
}

TEST(InsideBoundary, ProjectsOntoSidesEdgesAndCorners) {
  const std::pair<Point3, Vector3> cases[] = {
      {{70, 20, 10}, {-15, 0, 0}}, {{-1, -2, 10}, {6, 7, 0}}, {{64, 44, 35}, {-9, -9, -10}}};
  for (const auto& [position, move] : cases) {
    auto link = inside(position, 5);
    ASSERT_EQ(link.run(), "");
    expect_near(link.move(End::to), move, 1e-6);
  }
}

TEST(InsideBoundary, FindsTheNearestPointBetweenSlantedSides) {
  Table wedge{{"x", "y", "z", "offset"}, {{0.0, 1.0, 0.0, 0.0}, {0.6, 0.8, 0.0, 0.0}}};
  for (const double side : {-1.0, 1.0}) wedge.rows.push_back({0.0, 0.0, side, 100.0});
  wedge.rows.push_back({-1.0, 0.0, 0.0, 100.0});
  wedge.rows.push_back({0.0, -1.0, 0.0, 100.0});
  LinkCase link("inside_boundary");
  link.from("boundary.domain", domain_of(wedge)).to("node.position", Point3{1, 3, 2});
  ASSERT_EQ(link.run(), "");
  expect_near(link.move(End::to), {-1, -3, 0}, 1e-6);  // the edge where both sides meet
}

TEST(InsideBoundary, LeavesTheInsideAloneAndWaitsForAShape) {
  auto link = inside({55, 35, 25}, 5);
  ASSERT_EQ(link.run(), "");
  EXPECT_FALSE(link.moves(End::to));
  ASSERT_EQ(link.from("boundary.domain", domain_of({})).to("node.position", Point3{1e6, 0, 0}).run(), "");
  EXPECT_FALSE(link.moves(End::to));
}

TEST(InsideBoundary, GoesToTheNearestOfThePieces) {
  // Two boxes side by side, the second lower; they share the face at x = 10.
  Table planes{{"x", "y", "z", "offset", "piece", "side"}, {}};
  const auto add = [&](double low, double high, double top, double piece) {
    const double number = 6 * piece;
    planes.rows.push_back({-1.0, 0.0, 0.0, -low, piece, piece > 0 ? -1.0 : number});
    planes.rows.push_back({1.0, 0.0, 0.0, high, piece, piece > 0 ? number + 1 : -1.0});
    planes.rows.push_back({0.0, -1.0, 0.0, 0.0, piece, number + 2});
    planes.rows.push_back({0.0, 1.0, 0.0, 10.0, piece, number + 3});
    planes.rows.push_back({0.0, 0.0, -1.0, 0.0, piece, number + 4});
    planes.rows.push_back({0.0, 0.0, 1.0, top, piece, number + 5});
  };
  add(0, 10, 20, 0);
  add(10, 30, 6, 1);
  const auto moved = [&](Point3 position) {
    LinkCase link("inside_boundary");
    link.set("margin", 1.0).from("boundary.domain", domain_of(planes)).to("node.position", position);
    EXPECT_EQ(link.run(), "");
    return link.moves(End::to) ? link.move(End::to) : Vector3{};
  };
  expect_near(moved({20, 5, 7}), {0, 0, -2}, 1e-6);
  expect_near(moved({11, 5, 19}), {-1, 0, 0}, 1e-6);
  expect_near(moved({10, 5, 3}), {}, 1e-6);  // between the pieces there is no side to keep away from
}

TEST(InsideBoundary, AMarginWithoutRoomIsAnError) {
  EXPECT_EQ(inside({30, 20, 15}, 15.5).run(), "margin: a margin of 15.5 m leaves no room inside the boundary; make it smaller");
  EXPECT_EQ(inside({30, 20, 10}, 15).run(), "");  // room for the middle plane exactly
}

TEST(InsideBoundary, SceneBringsAllVolumesBack) {
  World world = World::from_file("scenes/links/inside_boundary.json");
  ASSERT_TRUE(world.settle());
  expect_near(world.point("gate", "node.position"), {6, 20, 8}, 1e-6);
  expect_near(world.point("house", "node.position"), {54, 34, 10}, 1e-6);
  expect_near(world.point("store", "node.position"), {30, 6, 24}, 1e-6);
  expect_near(world.point("studio", "node.position"), {32, 22, 8}, 0);
  for (const char* node : {"gate", "house", "store", "studio"})
    EXPECT_EQ(world.text(node, "smart_volume.state"), "alive") << node;
}

}  // namespace
}  // namespace bl
