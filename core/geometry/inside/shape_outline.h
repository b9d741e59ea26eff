// The outline in plan of (convex polyhedron ∩ ball): straight stretches and arcs of ellipses, each as a function y(x).
#pragma once

#include <vector>

#include "core/geometry/inside/shape_measure.h"

namespace bl::geometry {

/// y = level + slope (x - middle) + bulge sqrt(width² - (x - middle)²) for x from `from` to `to` [m]. A straight stretch has no
/// bulge. Anything else is a circle on the ball, in the plane normal·p = offset, as it is seen from above.
struct PlanArc {
  double from = 0, to = 0;
  double level = 0, slope = 0, middle = 0;
  double bulge = 0, squared_width = 0;
  Vector3 normal;
  double offset = 0;

  double at(double x) const;
  /// Integral of y from `low` to `high`, in closed form.
  double area_below(double low, double high) const;
};

/// Appends the outline, relative to the ball's centre: at every x the largest y of its stretches is the shape's largest, and the
/// smallest its smallest. All of them lie in the shape, so one too many is no fault. Stretches shorter in x than `tolerance` [m]
/// are left out.
void outline_in_plan(const Polyhedron& cell, double squared_radius, double tolerance, std::vector<PlanArc>& out);

}  // namespace bl::geometry
