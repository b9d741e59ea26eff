// Spreads first positions of volumes inside a prism: seeded, the same on every machine, large volumes apart, neighbours near.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "core/base/result.h"
#include "core/base/vector.h"
#include "core/geometry/plan_ring.h"

namespace bl::making {

/// No two points come closer than this share of the mean spacing, the cube root of (prism volume / number of points).
constexpr double kSpreadSeparation = 0.15;

/// One point per demand, strictly inside the prism over `plan` (a simple ring, convex or not) without its `holes` (simple rings
/// inside it that do not meet), from `bottom` to `top` [m]. `volumes`: demand of each point [m³]. `neighbours`: pairs of indices
/// that shall start near each other. The method is in README.md: best candidates on a fixed sample set, then a fixed number of
/// relaxation steps in the power diagram whose weights are the squared radii of the equal-volume balls. `on_ground`: not 0 for
/// points whose balls shall stand on the bottom; empty: nobody has to.
Result<std::vector<Point3>> spread_points(std::span<const Point3> plan, double bottom, double top,
                                          std::span<const double> volumes, std::uint64_t seed,
                                          std::span<const std::pair<std::size_t, std::size_t>> neighbours = {},
                                          std::span<const geometry::Ring> holes = {},
                                          std::span<const std::uint8_t> on_ground = {});

}  // namespace bl::making
