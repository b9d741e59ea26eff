// Even samples of a prism over any simple polygon with holes, by exact inversion.
// No rejection, so the cost does not depend on the shape.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/base/vector.h"
#include "core/geometry/plan_ring.h"

namespace bl::making {

/// `count` points strictly inside the prism over the rings (a polygon, then its holes), evenly spread: a fixed low-discrepancy
/// sequence shifted by the seed.
std::vector<Point3> prism_samples(std::span<const geometry::Ring> rings, double bottom, double top, std::size_t count,
                                  std::uint64_t seed);

}  // namespace bl::making
