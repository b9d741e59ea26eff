// A yardstick for benches: the plain regular triangulation that the diagram stands on, without anything of ours.
#pragma once

#include <cstddef>
#include <span>

#include "core/geometry/power_cells.h"

namespace bl::geometry {

/// Builds the regular triangulation of the sites the shortest way that the library offers, throws it away, and returns how many
/// sites have a cell. Whoever calls it holds the stop watch.
std::size_t plain_triangulation(std::span<const PowerSite> sites);

}  // namespace bl::geometry
