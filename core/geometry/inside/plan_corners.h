// The outline of a plan made ready: without spare corners, simple, and turned the right way.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/geometry/convex_domain.h"

namespace bl::geometry {

struct PlanCorner {
  double x = 0, y = 0;
  std::size_t given = 0;  ///< index in the ring as given, for messages
};

enum class Turning { counter_clockwise, clockwise };

/// Twice the area of the triangle a, b, c: positive where c lies left of the way from a to b.
inline double turn(const PlanCorner& a, const PlanCorner& b, const PlanCorner& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// "(x, y)" in millimetres, for messages.
std::string place_of(double x, double y);

/// The corners of a ring from the first one on. Errors call it `what`, such as "plan polygon".
Result<std::vector<PlanCorner>> plan_corners(std::span<const Point3> ring, const std::string& what, Turning turning);

/// The first corner where a counter-clockwise ring does not turn left, or its size.
std::size_t first_reflex(const std::vector<PlanCorner>& corners);

/// Both heights finite and in order.
Result<void> check_heights(double bottom, double top);

/// The upright column over a convex polygon: planes and faces are bottom, top and one wall per side.
ConvexDomain prism(const std::vector<PlanCorner>& plan, double bottom, double top);

}  // namespace bl::geometry
