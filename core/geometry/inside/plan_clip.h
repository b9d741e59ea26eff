// A convex polygon in plan whose sides know what they border on: clipped by half-planes, measured inside a disc.
#pragma once

#include <cstdint>
#include <vector>

#include "core/base/vector.h"

namespace bl::geometry {

/// What lies beyond a side. Numbers from 0 on are sites.
struct PlanSide {
  static constexpr std::int32_t kPlot = -1;     ///< the border of the plot
  static constexpr std::int32_t kForm = -2;     ///< a side of the site's own form
  static constexpr std::int32_t kInner = -3;    ///< another convex piece of the same plot: no wall
  static constexpr std::int32_t kStreet = -4;   ///< the border of the plot along a street
  static constexpr std::int32_t kLeftOut = -5;  ///< ground inside the border of the plot that the plot leaves out
};

struct PlanPoint {
  double x = 0, y = 0;
  bool operator==(const PlanPoint&) const = default;
};

/// Corners counter-clockwise; side k runs from corner k to the next one.
struct PlanPolygon {
  struct Corner {
    PlanPoint at;
    std::int32_t beyond = PlanSide::kPlot;  ///< of the side that begins here
  };
  std::vector<Corner> corners;

  bool is_empty() const { return corners.size() < 3; }
  /// The square of the largest distance of a corner from the origin [m²].
  double farthest_squared() const;
};

/// All points with n·x <= offset; `x` and `y` are the unit normal.
struct HalfPlane {
  double x = 0, y = 0, offset = 0;  ///< [m]
};

/// Keeps the part of `polygon` inside the half-plane; `spare` is memory for it. Is anything cut away?
bool clip(PlanPolygon& polygon, const HalfPlane& by, std::int32_t beyond, PlanPolygon& spare);

/// The part of a polygon inside a disc about the origin. A radius of infinity takes all of it.
struct DiscMeasure {
  double area = 0;  ///< [m²]
  double arc = 0;   ///< length of the disc's edge inside the polygon [m]
};

/// Adds to `lengths` the length [m] that each side k has inside the disc; `lengths` has one number for each corner.
DiscMeasure measure_in_disc(const PlanPolygon& polygon, double radius, std::vector<double>& lengths);

}  // namespace bl::geometry
