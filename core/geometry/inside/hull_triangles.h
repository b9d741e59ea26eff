// The triangles of a convex hull, the only thing that is asked of the hull algorithm.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/base/result.h"
#include "core/base/vector.h"

namespace bl::geometry {

/// Triangles over `points` (indices), counter-clockwise from outside, in an order that depends on the points alone.
/// The points are finite, distinct and sorted; four of them do not lie in one plane, or an error says so.
Result<std::vector<std::array<std::uint32_t, 3>>> hull_triangles(std::span<const Point3> points);

}  // namespace bl::geometry
