// Cuts, areas and nearest points of convex polygons in space.
#include "core/geometry/inside/seam_outline.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace bl::geometry {

std::pair<Polygon, Polygon> cut_outline(const Polygon& polygon, const Vector3& outward, double offset, double tolerance) {
  std::pair<Polygon, Polygon> sides;
  const auto depth_of = [&](const Point3& p) { return dot(outward, p) - offset; };
  double farthest[2] = {0, 0};
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Point3 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const double at_a = depth_of(a), at_b = depth_of(b);
    if (at_a <= tolerance) sides.first.push_back(a);
    if (at_a >= -tolerance) sides.second.push_back(a);
    farthest[0] = std::max(farthest[0], -at_a);
    farthest[1] = std::max(farthest[1], at_a);
    if ((at_a < -tolerance && at_b > tolerance) || (at_a > tolerance && at_b < -tolerance)) {
      const Point3 crossing = a + (at_a / (at_a - at_b)) * (b - a);
      sides.first.push_back(crossing);
      sides.second.push_back(crossing);
    }
  }
  if (farthest[0] <= tolerance) sides.first.clear();
  if (farthest[1] <= tolerance) sides.second.clear();
  return sides;
}

bool edge_line(const Polygon& polygon, std::size_t i, const Vector3& normal, double tolerance, Vector3& outward, double& offset) {
  const Point3 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
  const double length = distance(a, b);
  if (length <= tolerance) return false;
  outward = cross(b - a, normal) / length;
  offset = dot(outward, a);
  return true;
}

double outline_area(const Polygon& polygon) { return polygon.size() < 3 ? 0 : norm(area_vector(polygon)); }

Point3 nearest_in_outline(const Polygon& polygon, const Vector3& normal, double offset) {
  const Point3 foot = offset * normal;
  Point3 best = foot;
  double least = std::numeric_limits<double>::infinity();
  bool is_inside = true;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Point3 a = polygon[i], along = polygon[(i + 1) % polygon.size()] - a;
    is_inside = is_inside && dot(normal, cross(along, foot - a)) >= 0;
    const Point3 on_edge = a + std::clamp(dot(foot - a, along) / std::max(1e-300, squared_norm(along)), 0.0, 1.0) * along;
    if (squared_norm(foot - on_edge) >= least) continue;
    least = squared_norm(foot - on_edge);
    best = on_edge;
  }
  return is_inside ? foot : best;
}

}  // namespace bl::geometry
