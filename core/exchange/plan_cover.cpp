// Lines from west to east, cut by the rings.
#include "core/exchange/plan_cover.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/exchange/box_grid.h"
#include "core/geometry/polygon_triangles.h"

namespace bl {

namespace {

// Where a line from west to east at height y lies inside of the rings, by the even-odd rule.
std::vector<std::pair<double, double>> stretches_at(const PlanShape& rings, double y) {
  std::vector<double> crossings;
  for (const Ring* ring : rings)
    for (std::size_t i = 0; i < ring->size(); ++i) {
      const Point3 &a = (*ring)[i], &b = (*ring)[(i + 1) % ring->size()];
      if ((a.y > y) != (b.y > y)) crossings.push_back(a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x));
    }
  std::sort(crossings.begin(), crossings.end());
  std::vector<std::pair<double, double>> stretches;
  for (std::size_t i = 0; i + 1 < crossings.size(); i += 2) stretches.emplace_back(crossings[i], crossings[i + 1]);
  return stretches;
}

}  // namespace

Point3 place_inside(const Ring& ring) {
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
  for (const auto& [a, b, c] : polygon_triangles(std::span(&ring, 1))) {
    const double area = std::abs(cross(ring[b] - ring[a], ring[c] - ring[a]).z);
    if (area > largest) largest = area, best = (ring[a] + ring[b] + ring[c]) / 3;
  }
  return best;
}

double covered_area(const std::vector<PlanShape>& shapes) {
  constexpr int kLines = 512;
  Ring corners;
  for (const PlanShape& shape : shapes)
    for (const Ring* ring : shape) corners.insert(corners.end(), ring->begin(), ring->end());
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

}  // namespace bl
