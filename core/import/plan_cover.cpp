// Lines from west to east, cut by the rings.
#include "core/import/plan_cover.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/geometry/polygon_triangles.h"
#include "core/import/box_grid.h"

namespace bl::importing {

namespace {

// Where a line from west to east at height y lies inside of the rings, by the even-odd rule.
std::vector<std::pair<double, double>> stretches_at(const PlanShape& rings, double y) {
  std::vector<double> crossings;
  for (const geometry::Ring* ring : rings)
    for (std::size_t i = 0; i < ring->size(); ++i) {
      const Point3 &a = (*ring)[i], &b = (*ring)[(i + 1) % ring->size()];
      if ((a.y > y) != (b.y > y)) crossings.push_back(a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x));
    }
  std::sort(crossings.begin(), crossings.end());
  std::vector<std::pair<double, double>> stretches;
  for (std::size_t i = 0; i + 1 < crossings.size(); i += 2) stretches.emplace_back(crossings[i], crossings[i + 1]);
  return stretches;
}

// The triangles of a shape, counter-clockwise.
std::vector<geometry::Ring> triangles_of(const PlanShape& shape) {
  std::vector<geometry::Ring> rings;
  geometry::Ring corners;
  for (const geometry::Ring* ring : shape) {
    rings.push_back(*ring);
    corners.insert(corners.end(), ring->begin(), ring->end());
  }
  std::vector<geometry::Ring> triangles;
  for (const auto& [i, j, k] : geometry::polygon_triangles(rings)) triangles.push_back({corners[i], corners[j], corners[k]});
  return triangles;
}

// What of a convex ring lies to the left of the line from a to b (Sutherland and Hodgman 1974).
geometry::Ring left_of(const geometry::Ring& ring, const Point3& a, const Point3& b) {
  const auto side = [&](const Point3& p) { return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x); };
  geometry::Ring kept;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Point3 &here = ring[i], &next = ring[(i + 1) % ring.size()];
    const double at = side(here), after = side(next);
    if (at >= 0) kept.push_back(here);
    if ((at > 0 && after < 0) || (at < 0 && after > 0)) kept.push_back(here + (next - here) * (at / (at - after)));
  }
  return kept;
}

}  // namespace

double common_area(const PlanShape& a, const PlanShape& b) {
  const std::vector<geometry::Ring> first = triangles_of(a), second = triangles_of(b);
  const BoxGrid grid = BoxGrid::of(second, [](const geometry::Ring& triangle) -> const geometry::Ring& { return triangle; });
  double area = 0;
  for (const geometry::Ring& triangle : first)
    for (const std::size_t other : grid.meeting(plan_box(triangle))) {
      geometry::Ring common = triangle;
      for (std::size_t i = 0; i < 3 && common.size() >= 3; ++i)
        common = left_of(common, second[other][i], second[other][(i + 1) % 3]);
      if (common.size() >= 3) area += std::abs(geometry::signed_area(common));
    }
  return area;
}

Point3 place_inside(const geometry::Ring& ring) {
  constexpr std::size_t kMany = 2000;
  Point3 best = ring.front();
  if (ring.size() > kMany) {
    const PlanBox box = plan_box(ring);
    best.y = (box.south + box.north) / 2;
    double widest = 0;
    for (const auto& [west, east] : stretches_at({&ring}, best.y))
      if (east - west > widest) widest = east - west, best.x = (west + east) / 2;
    return best;
  }
  double largest = -1;
  for (const auto& [a, b, c] : geometry::polygon_triangles(std::span(&ring, 1))) {
    const double area = std::abs(cross(ring[b] - ring[a], ring[c] - ring[a]).z);
    if (area > largest) largest = area, best = (ring[a] + ring[b] + ring[c]) / 3;
  }
  return best;
}

double covered_area(const std::vector<PlanShape>& shapes) {
  constexpr int kLines = 512;
  geometry::Ring corners;
  for (const PlanShape& shape : shapes)
    for (const geometry::Ring* ring : shape) corners.insert(corners.end(), ring->begin(), ring->end());
  const PlanBox box = plan_box(corners);
  const double step = (box.north - box.south) / kLines;
  double length = 0;
  for (int i = 0; i < kLines; ++i) {
    std::vector<std::pair<double, double>> all;
    for (const PlanShape& shape : shapes) {
      const auto one = stretches_at(shape, box.south + (i + 0.5) * step);
      all.insert(all.end(), one.begin(), one.end());
    }
    std::sort(all.begin(), all.end());
    double reached = -INFINITY;
    for (const auto& [west, east] : all) {
      length += std::max(0.0, east - std::max(west, reached));
      reached = std::max(reached, east);
    }
  }
  return length * step;
}

}  // namespace bl::importing
