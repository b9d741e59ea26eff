// Clips convex polygons by half-planes (Sutherland and Hodgman 1974) and measures them inside a disc by their sides.
#include "core/geometry/inside/plan_clip.h"

#include <algorithm>
#include <cmath>

#include "core/base/mathematics.h"

namespace bl::geometry {

double PlanPolygon::farthest_squared() const {
  double farthest = 0;
  for (const Corner& c : corners) farthest = std::max(farthest, c.at.x * c.at.x + c.at.y * c.at.y);
  return farthest;
}

bool clip(PlanPolygon& polygon, const HalfPlane& by, std::int32_t beyond, PlanPolygon& spare) {
  const std::size_t count = polygon.corners.size();
  const auto height = [&by](const PlanPoint& p) { return by.x * p.x + by.y * p.y - by.offset; };
  bool is_cut = false;
  for (const PlanPolygon::Corner& c : polygon.corners) is_cut |= height(c.at) > 0;
  if (!is_cut) return false;
  spare.corners.clear();
  for (std::size_t k = 0; k < count; ++k) {
    const PlanPolygon::Corner& a = polygon.corners[k];
    const PlanPolygon::Corner& b = polygon.corners[k + 1 < count ? k + 1 : 0];
    const double at_a = height(a.at), at_b = height(b.at);
    if (at_a <= 0) spare.corners.push_back(a);
    if ((at_a <= 0) == (at_b <= 0)) continue;
    const double t = at_a / (at_a - at_b);
    const PlanPoint cut{a.at.x + t * (b.at.x - a.at.x), a.at.y + t * (b.at.y - a.at.y)};
    // Where the polygon is left, the new side begins; where it is entered again, the old side goes on.
    spare.corners.push_back({cut, at_a <= 0 ? beyond : a.beyond});
  }
  std::swap(polygon.corners, spare.corners);
  if (polygon.is_empty()) polygon.corners.clear();
  return true;
}

namespace {

// The sector of the disc below the part [a, b] of a line at the signed distance `height` of the origin (positive where the origin
// lies inside).
void add_sector(double radius, double height, double a, double b, DiscMeasure& sum) {
  const double angle = mathematics::arc_tangent(height * (b - a), height * height + a * b);
  sum.area += 0.5 * radius * radius * angle;
  sum.arc += radius * angle;
}

}  // namespace

DiscMeasure measure_in_disc(const PlanPolygon& polygon, double radius, std::vector<double>& lengths) {
  DiscMeasure sum;
  if (!(radius > 0)) return sum;
  const std::size_t count = polygon.corners.size();
  for (std::size_t k = 0; k < count; ++k) {
    const PlanPoint& p = polygon.corners[k].at;
    const PlanPoint& q = polygon.corners[k + 1 < count ? k + 1 : 0].at;
    const double dx = q.x - p.x, dy = q.y - p.y, length = std::sqrt(dx * dx + dy * dy);
    if (!(length > 0)) continue;
    const PlanPoint e{dx / length, dy / length};
    const double height = e.y * p.x - e.x * p.y, a = e.x * p.x + e.y * p.y, b = a + length;
    const double rest = std::isinf(radius) ? radius : (radius - height) * (radius + height);
    if (!(rest > 0)) {
      add_sector(radius, height, a, b, sum);
      continue;
    }
    const double half = std::sqrt(rest), low = std::clamp(-half, a, b), high = std::clamp(half, a, b);
    if (a < low) add_sector(radius, height, a, low, sum);
    if (low < high) {
      sum.area += 0.5 * height * (high - low);
      lengths[k] += high - low;
    }
    if (high < b) add_sector(radius, height, high, b, sum);
  }
  return sum;
}

}  // namespace bl::geometry
