// Domains from points, planes, plans and meshes, and the sentences that refuse bad ones.
#include "core/geometry/convex_domain.h"

#include <cmath>
#include <limits>
#include <numbers>

#include "tests/core/geometry/geometry_support.h"

namespace bl::test {
namespace {

std::vector<Point3> cube_corners() {
  std::vector<Point3> points;
  for (unsigned i = 0; i < 8; ++i) points.push_back({(i & 1u) ? 2.0 : 0, (i & 2u) ? 3.0 : 0, (i & 4u) ? 4.0 : 0});
  return points;
}

void expect_refused(const Result<geometry::ConvexDomain>& domain, const char* word) {
  ASSERT_FALSE(domain.ok()) << word;
  EXPECT_NE(domain.error().message.find(word), std::string::npos) << domain.error().message;
}

TEST(ConvexDomain, HullOfABoxHasSixFacesInAFixedOrder) {
  auto points = cube_corners();
  points.push_back({1, 1, 1});
  points.push_back({1, 0, 2});  // on a face
  const auto hull = geometry::convex_hull(points);
  ASSERT_TRUE(hull.ok()) << hull.error().text();
  ASSERT_EQ(hull->planes.size(), 6u);
  EXPECT_DOUBLE_EQ(hull->volume, 24);
  EXPECT_EQ(hull->planes.front().normal, (Vector3{0, 0, -1}));
  EXPECT_EQ(hull->planes.back().normal, (Vector3{0, 0, 1}));
  EXPECT_EQ(hull->maximum, (Vector3{2, 3, 4}));
  EXPECT_NEAR(distance(hull->centroid, {1, 1.5, 2}), 0, 1e-14);
  std::reverse(points.begin(), points.end());
  EXPECT_EQ(*geometry::convex_hull(points), *hull);
  EXPECT_TRUE(is_closed(to_mesh(*hull)));
  EXPECT_NEAR(enclosed_volume(to_mesh(*hull)), 24, 1e-13);
}

TEST(ConvexDomain, HullsOfRandomPointsAreClosed) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    Random random(seed);
    std::vector<Point3> points;
    for (int i = 0; i < 40; ++i) points.push_back(random_point(random, {-5, 3, 100}, {9, 8, 120}));
    const auto hull = geometry::convex_hull(points);
    ASSERT_TRUE(hull.ok());
    EXPECT_TRUE(is_closed(to_mesh(*hull)));
    for (const Point3& p : points) EXPECT_TRUE(hull->contains(p, 1e-10));
    const auto planes = from_planes(hull->planes);
    ASSERT_TRUE(planes.ok()) << planes.error().text();
    EXPECT_NEAR(planes->volume, hull->volume, 1e-9);
    EXPECT_TRUE(is_closed(to_mesh(*planes)));
  }
}

TEST(ConvexDomain, HullsHoldTheirPointsThoughFacesAreFlatWithinRounding) {
  // The corners of a ring of straight pieces: eight of them lie in one plane, but for rounding.
  for (const int around : {8, 12, 40}) {
    std::vector<Point3> points;
    for (int i = 0; i < around; ++i) {
      for (int j = 0; j < 5; ++j) {
        const double a = 2 * std::numbers::pi * i / around, b = 2 * std::numbers::pi * (j + 0.5) / 5,
                     radius = 10 + 3 * std::cos(b);
        points.push_back({radius * std::cos(a), radius * std::sin(a), 3 * std::sin(b)});
      }
    }
    const auto domain = geometry::convex_hull(points);
    ASSERT_TRUE(domain.ok()) << domain.error().text();
    for (const Point3& p : points) EXPECT_TRUE(domain->contains(p, 1e-9)) << around << ": " << p.x << " " << p.y << " " << p.z;
  }
}

TEST(ConvexDomain, HullRefusesWhatHasNoVolume) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  expect_refused(geometry::convex_hull(std::vector<Point3>{}), "at least 4");
  expect_refused(geometry::convex_hull(std::vector<Point3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}), "at least 4");
  expect_refused(geometry::convex_hull(std::vector<Point3>(7, {1, 2, 3})), "1 of them at different places");
  expect_refused(geometry::convex_hull(std::vector<Point3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {3, 4, 0}}), "one plane");
  expect_refused(geometry::convex_hull(std::vector<Point3>{{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {3, 3, 3}}), "one plane");
  expect_refused(geometry::convex_hull(std::vector<Point3>{{0, 0, 0}, {1, 0, nan}, {0, 1, 0}, {1, 1, 1}}), "boundary point 1");
  expect_refused(geometry::convex_hull(std::vector<Point3>{{0, 0, 0}, {1e9, 0, 0}, {0, 1, 0}, {1, 1, 1}}), "1e8 m");
  expect_refused(geometry::convex_hull(std::vector<Point3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 1e-15}}), "flat");
}

TEST(ConvexDomain, PlanesKeepTheirIndex) {
  // A box with a redundant plane (4) and a repeated one (5); not normalised.
  const std::vector<geometry::Plane> planes{{{-2, 0, 0}, 0}, {{1, 0, 0}, 1}, {{0, -1, 0}, 0}, {{0, 3, 0}, 3},
                                            {{1, 1, 0}, 5},  {{1, 0, 0}, 1}, {{0, 0, -1}, 0}, {{0, 0, 1}, 1}};
  const auto domain = from_planes(planes);
  ASSERT_TRUE(domain.ok()) << domain.error().text();
  EXPECT_EQ(domain->planes.size(), 8u);
  EXPECT_TRUE(domain->faces[4].empty());
  EXPECT_TRUE(domain->faces[5].empty());
  EXPECT_EQ(domain->faces[7].size(), 4u);
  EXPECT_DOUBLE_EQ(domain->volume, 1);
  EXPECT_EQ(domain->minimum, (Vector3{0, 0, 0}));
  EXPECT_EQ(domain->maximum, (Vector3{1, 1, 1}));
}

TEST(ConvexDomain, PyramidFromPlanesHasOneApex) {
  const std::vector<geometry::Plane> planes{{{0, 0, -1}, 0}, {{1, 0, 1}, 1}, {{-1, 0, 1}, 1}, {{0, 1, 1}, 1}, {{0, -1, 1}, 1}};
  const auto domain = from_planes(planes);
  ASSERT_TRUE(domain.ok());
  EXPECT_EQ(domain->vertices.size(), 5u);
  EXPECT_NEAR(domain->volume, 4.0 / 3, 1e-14);
  EXPECT_TRUE(is_closed(to_mesh(*domain)));
}

TEST(ConvexDomain, PlanesThatDoNotCloseAreRefused) {
  const std::vector<geometry::Plane> open{{{-1, 0, 0}, 0}, {{1, 0, 0}, 1}, {{0, -1, 0}, 0}, {{0, 1, 0}, 1}, {{0, 0, -1}, 0}};
  expect_refused(from_planes(open), "do not close");
  const std::vector<geometry::Plane> empty{{{-1, 0, 0}, 0}, {{1, 0, 0}, -1}, {{0, -1, 0}, 0},
                                           {{0, 1, 0}, 1},  {{0, 0, -1}, 0}, {{0, 0, 1}, 1}};
  expect_refused(from_planes(empty), "leave no space: plane 1");
  const std::vector<geometry::Plane> zero{{{0, 0, 0}, 0}, {{1, 0, 0}, 1}, {{0, -1, 0}, 0}, {{0, 1, 0}, 1}};
  expect_refused(from_planes(zero), "plane 0 has no direction");
  expect_refused(from_planes(std::vector<geometry::Plane>{}), "at least 4");
}

TEST(ConvexDomain, SmallDomainsFarAwayAreExact) {
  const double x = 100000, s = 0.5;
  const std::vector<geometry::Plane> planes{{{-1, 0, 0}, -x},   {{1, 0, 0}, x + s}, {{0, -1, 0}, -x},
                                            {{0, 1, 0}, x + s}, {{0, 0, -1}, 0},    {{0, 0, 1}, s}};
  const auto domain = from_planes(planes);
  ASSERT_TRUE(domain.ok()) << domain.error().text();
  EXPECT_DOUBLE_EQ(domain->volume, 0.125);
}

TEST(ConvexDomain, PlanOfEitherOrientationWithSpareCorners) {
  std::vector<Point3> plan{{0, 0, 0}, {5, 0, 0}, {10, 0, 0}, {10, 10, 0}, {0, 10, 0}, {0, 0, 0}};
  const auto domain = geometry::extrude(plan, 1, 4);
  ASSERT_TRUE(domain.ok()) << domain.error().text();
  EXPECT_DOUBLE_EQ(domain->volume, 300);
  EXPECT_EQ(domain->planes.size(), 6u);
  EXPECT_TRUE(is_closed(to_mesh(*domain)));
  EXPECT_GT(enclosed_volume(to_mesh(*domain)), 0);
  std::reverse(plan.begin(), plan.end());
  const auto reversed = geometry::extrude(plan, 1, 4);
  ASSERT_TRUE(reversed.ok());
  EXPECT_DOUBLE_EQ(reversed->volume, 300);
}

TEST(ConvexDomain, BadPlansAreRefusedWithAPlace) {
  const auto plan = [](std::initializer_list<std::pair<double, double>> corners) {
    std::vector<Point3> points;
    for (const auto& c : corners) points.push_back({c.first, c.second, 0});
    return points;
  };
  expect_refused(geometry::extrude(plan({{0, 0}, {10, 10}, {10, 0}, {0, 10}}), 0, 1), "side 0 and side 2 meet at (5.000, 5.000)");
  expect_refused(geometry::extrude(plan({{0, 0}, {10, 0}, {5, 2}, {5, 10}}), 0, 1), "not convex (corner 2 at (5.000, 2.000))");
  expect_refused(geometry::extrude(plan({{0, 0}, {10, 0}}), 0, 1), "at least 3");
  expect_refused(geometry::extrude(plan({{0, 0}, {10, 0}, {0, 0}, {10, 0}}), 0, 1), "");
  expect_refused(geometry::extrude(plan({{0, 0}, {10, 0}, {20, 0}}), 0, 1), "no area");
  expect_refused(geometry::extrude(plan({{0, 0}, {10, 0}, {10, 10}}), 3, 3), "above");
  expect_refused(geometry::extrude(plan({{0, 0}, {10, 0}, {10, std::numeric_limits<double>::infinity()}}), 0, 3),
                 "plan corner 2");
}

TEST(ConvexDomain, MeshesComeBackAsDomains) {
  const auto plan = std::vector<Point3>{{0, 0, 0}, {4, 0, 0}, {5, 3, 0}, {2, 6, 0}, {-1, 3, 0}};
  const auto domain = geometry::extrude(plan, 0, 10).value();
  const auto back = geometry::from_mesh(to_mesh(domain));
  ASSERT_TRUE(back.ok()) << back.error().text();
  EXPECT_NEAR(back->volume, domain.volume, 1e-11);
  EXPECT_EQ(back->planes.size(), domain.planes.size());
  EXPECT_EQ(*geometry::from_mesh(to_mesh(*back)), *back);
  Mesh open = to_mesh(domain);
  open.triangles.pop_back();
  expect_refused(geometry::from_mesh(open), "not closed");
  Mesh dented = to_mesh(geometry::convex_hull(cube_corners()).value());
  dented.vertices.push_back({1, 1.5, 2});
  const auto t = dented.triangles.back();
  dented.triangles.pop_back();
  const auto centre = static_cast<std::uint32_t>(dented.vertices.size() - 1);
  for (unsigned i = 0; i < 3; ++i) dented.triangles.push_back({t[i], t[(i + 1) % 3], centre});
  expect_refused(geometry::from_mesh(dented), "not convex");
}

TEST(ConvexDomain, FourPointsGiveATetrahedronWhicheverWayTheyAreGiven) {
  for (const Point3 fourth : {Point3{0, 0, 2}, Point3{0, 0, -2}, Point3{-3, 1, 2}})
    for (const int copies : {1, 3}) {
      std::vector<Point3> corners{{0, 0, 0}, {2, 0, 0}, {0, 2, 0}};
      for (int i = 0; i < copies; ++i) corners.push_back(fourth);
      const auto hull = geometry::convex_hull(corners);
      ASSERT_TRUE(hull.ok()) << hull.error().text();
      EXPECT_NEAR(hull->volume, 8.0 / 6, 1e-12);
      EXPECT_NEAR(enclosed_volume(to_mesh(*hull)), 8.0 / 6, 1e-12);
    }
}

}  // namespace
}  // namespace bl::test
