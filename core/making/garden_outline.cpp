// Reads corners, and finds the rectangle along their longest side.
#include "core/making/garden_outline.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/base/mathematics.h"
#include "core/base/text.h"
#include "core/geometry/plan_ring.h"

namespace bl::making {

namespace {

constexpr double kHalfCircle = 3.14159265358979323846;

}  // namespace

Result<std::vector<Point3>> read_corners(const std::vector<std::string>& texts) {
  std::vector<Point3> corners;
  for (const std::string& text : texts) {
    const std::size_t comma = text.find(',');
    const auto x = parse_number(text.substr(0, comma)),
               y = comma == std::string::npos ? std::nullopt : parse_number(text.substr(comma + 1));
    if (!x || !y || std::abs(*x) > 1e8 || std::abs(*y) > 1e8)
      return Error{ErrorCode::parse, "--corners", "expects corners such as 10,20 in metres of the scene, found `" + text + "`"};
    corners.push_back({*x, *y, 0});
  }
  if (corners.size() < 3)
    return Error{ErrorCode::missing, "--corners", "a garden needs 3 corners or more, found " + std::to_string(corners.size())};
  if (const auto crossing = geometry::find_self_crossing(corners))
    return Error{ErrorCode::geometry, "--corners",
                 "the outline meets itself at (" + fixed(crossing->where.x, 2) + ", " + fixed(crossing->where.y, 2) +
                     "): name the corners in order around it"};
  return corners;
}

Rectangle around(const std::vector<Point3>& corners) {
  Vector3 axis{1, 0, 0};
  double longest = 0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vector3 side = corners[(i + 1) % corners.size()] - corners[i];
    if (norm(side) > longest + 1e-9) longest = norm(side), axis = side / norm(side);
  }
  // To the east, so that equal gardens have equal angles.
  if (axis.x < 0 || (axis.x == 0 && axis.y < 0)) axis = -1 * axis;
  const Vector3 across{-axis.y, axis.x, 0};
  double low_u = INFINITY, high_u = -INFINITY, low_v = INFINITY, high_v = -INFINITY;
  for (const Point3& p : corners) {
    low_u = std::min(low_u, dot(p, axis)), high_u = std::max(high_u, dot(p, axis));
    low_v = std::min(low_v, dot(p, across)), high_v = std::max(high_v, dot(p, across));
  }
  Rectangle box{axis * ((low_u + high_u) / 2) + across * ((low_v + high_v) / 2), high_u - low_u, high_v - low_v, 0, 0};
  box.rotation = mathematics::arc_tangent(axis.y, axis.x) * 180 / kHalfCircle;
  box.beyond = 1 - std::abs(geometry::signed_area(corners)) / (box.width * box.depth);
  return box;
}

}  // namespace bl::making
