// Triangles of polygons: areas by hand, holes, random stars, and prisms that are closed whatever the rings look like.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "core/base/random.h"
#include "core/geometry/height_grid.h"
#include "core/geometry/polygon_triangles.h"

namespace bl::geometry {
namespace {

double area(const std::vector<Ring>& rings, const std::vector<std::array<std::uint32_t, 3>>& triangles) {
  std::vector<Point3> points;
  for (const Ring& ring : rings) points.insert(points.end(), ring.begin(), ring.end());
  double sum = 0;
  for (const auto& [a, b, c] : triangles) {
    const double part = cross(points[b] - points[a], points[c] - points[a]).z / 2;
    EXPECT_GE(part, 0) << "a triangle is turned over";
    sum += part;
  }
  return sum;
}

bool is_closed(const Mesh& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> sums;
  for (const auto& t : mesh.triangles)
    for (std::size_t i = 0; i < 3; ++i) {
      const auto a = t[i], b = t[(i + 1) % 3];
      sums[{std::min(a, b), std::max(a, b)}] += a < b ? 1 : -1;
    }
  for (const auto& [edge, sum] : sums)
    if (sum != 0) return false;
  return true;
}

Ring square(double x, double y, double side) { return {{x, y, 0}, {x + side, y, 0}, {x + side, y + side, 0}, {x, y + side, 0}}; }

TEST(PolygonTriangles, AreaIsThatOfThePolygon) {
  const std::vector<Ring> ell = {{{0, 0, 0}, {4, 0, 0}, {4, 1, 0}, {1, 1, 0}, {1, 4, 0}, {0, 4, 0}}};
  EXPECT_DOUBLE_EQ(area(ell, polygon_triangles(ell)), 7);
  EXPECT_EQ(polygon_triangles(ell).size(), 4u);
  const std::vector<Ring> courts = {square(0, 0, 10), square(1, 1, 3), square(6, 6, 3), square(6, 1, 2)};
  EXPECT_NEAR(area(courts, polygon_triangles(courts)), 100 - 9 - 9 - 4, 1e-12);
  std::vector<Ring> turned = courts;
  for (Ring& ring : turned) std::reverse(ring.begin(), ring.end());
  EXPECT_NEAR(area(turned, polygon_triangles(turned)), 78, 1e-12);
}

TEST(PolygonTriangles, RandomStarsWithHoles) {
  Random random(3, 5);
  for (int round = 0; round < 300; ++round) {
    const int corners = 3 + static_cast<int>(random.uniform(0, 30));
    std::vector<Ring> rings(2);
    for (int i = 0; i < corners; ++i) {
      const double angle = 2 * 3.14159265358979323846 * i / corners, far = random.uniform(5, 20), near = random.uniform(0.5, 1.2);
      rings[0].push_back({far * std::cos(angle), far * std::sin(angle), 0});
      rings[1].push_back({near * std::cos(angle), near * std::sin(angle), 0});
    }
    if (corners < 5) rings.pop_back();  // a triangle may be narrower than the hole
    double wanted = 0;
    for (std::size_t r = 0; r < rings.size(); ++r) wanted += (r == 0 ? 1 : -1) * std::abs(signed_area(rings[r]));
    EXPECT_NEAR(area(rings, polygon_triangles(rings)), wanted, 1e-9 * wanted) << "round " << round;
    const Mesh prism = prism_mesh(rings[0], std::span(rings).subspan(1), -2, 3);
    EXPECT_TRUE(is_closed(prism));
    EXPECT_NEAR(enclosed_volume(prism), 5 * wanted, 1e-8 * wanted);
  }
}

TEST(PolygonTriangles, RingsThatCrossStillGiveClosedPrisms) {
  Random random(9, 1);
  for (int round = 0; round < 200; ++round) {
    std::vector<Ring> rings(3);
    for (Ring& ring : rings)
      for (int i = 0; i < 6; ++i) ring.push_back({std::round(random.uniform(0, 4)), std::round(random.uniform(0, 4)), 0});
    EXPECT_TRUE(is_closed(prism_mesh(rings[0], std::span(rings).subspan(1), 0, 1)));
  }
  EXPECT_TRUE(polygon_triangles({}).empty());
}

TEST(HeightGrid, RowsReadBackToHalfAStep) {
  Random random(4, 4);
  std::vector<double> heights;
  for (int i = 0; i < 1000; ++i) heights.push_back(i % 17 == 0 ? NAN : random.uniform(-20, 900));
  const std::string text = height_row(heights, -20, 0.01);
  EXPECT_EQ(first_wrong_character(text), text.size());
  const HeightGrid grid{0, 0, 1, -20, 0.01, {text}};
  for (std::size_t i = 0; i < heights.size(); ++i) {
    ASSERT_EQ(grid.at(0, i).has_value(), std::isfinite(heights[i])) << i;
    if (grid.at(0, i)) { EXPECT_NEAR(*grid.at(0, i), heights[i], 0.005 + 1e-9); }
  }
  EXPECT_FALSE(grid.at(0, 1000).has_value());
  EXPECT_FALSE(grid.at(1, 0).has_value());
}

}  // namespace
}  // namespace bl::geometry
