// Even samples of a prism over any simple polygon, by exact inversion: no rejection, so the cost does not depend on the shape.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/base/vector.h"

namespace bl {

/// `count` points strictly inside the prism, evenly spread: a fixed low-discrepancy sequence shifted by the seed.
std::vector<Point3> prism_samples(std::span<const Point3> plan, double bottom, double top, std::size_t count, std::uint64_t seed);

}  // namespace bl
