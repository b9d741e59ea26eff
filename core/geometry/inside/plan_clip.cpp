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

// The triangle of the origin and a side [a, b] of one line at the signed distance `height` of the origin (positive where the
// origin lies inside): area and moment. `e` is the direction of the line, `n` its outer normal.
void add_triangle(double height, double a, double b, const PlanPoint& e, const PlanPoint& n, DiscMeasure& sum) {
  const double area = 0.5 * height * (b - a), along = (a + b) / 3, out = 2 * height / 3;
  sum.area += area;
  sum.moment.x += area * (along * e.x + out * n.x);
  sum.moment.y += area * (along * e.y + out * n.y);
}

// The sector of the disc below the part [a, b] of the line. Its moment is r³/3 times the difference of the unit vectors of its
// ends, turned by a right angle.
void add_sector(double radius, double height, double a, double b, const PlanPoint& e, const PlanPoint& n, DiscMeasure& sum) {
  const double angle = mathematics::arc_tangent(height * (b - a), height * height + a * b);
  sum.area += 0.5 * radius * radius * angle;
  sum.arc += radius * angle;
  const double to_a = std::sqrt(height * height + a * a), to_b = std::sqrt(height * height + b * b);
  if (to_a == 0 || to_b == 0) return;
  const PlanPoint ua{(a * e.x + height * n.x) / to_a, (a * e.y + height * n.y) / to_a};
  const PlanPoint ub{(b * e.x + height * n.x) / to_b, (b * e.y + height * n.y) / to_b};
  const double third = radius * radius * radius / 3;
  sum.moment.x += third * (ub.y - ua.y);
  sum.moment.y -= third * (ub.x - ua.x);
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
    const PlanPoint e{dx / length, dy / length}, n{e.y, -e.x};
    const double height = n.x * p.x + n.y * p.y, a = e.x * p.x + e.y * p.y, b = a + length;
    const double rest = std::isinf(radius) ? radius : (radius - height) * (radius + height);
    if (!(rest > 0)) {
      add_sector(radius, height, a, b, e, n, sum);
      continue;
    }
    const double half = std::sqrt(rest), low = std::clamp(-half, a, b), high = std::clamp(half, a, b);
    if (a < low) add_sector(radius, height, a, low, e, n, sum);
    if (low < high) {
      add_triangle(height, low, high, e, n, sum);
      lengths[k] += high - low;
    }
    if (high < b) add_sector(radius, height, high, b, e, n, sum);
  }
  return sum;
}

}  // namespace bl::geometry
