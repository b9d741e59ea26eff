// A reference for benches: the plain regular triangulation under the diagram, without any code of this project.
#pragma once

#include <cstddef>
#include <span>

#include "core/geometry/power_cells.h"

namespace bl::geometry {

/// Builds the regular triangulation of the sites in the fastest way of the library, discards it, and returns how many sites have
/// a cell. The caller measures the time.
std::size_t plain_triangulation(std::span<const PowerSite> sites);

}  // namespace bl::geometry
