// The second yardstick of the bench, there only where the library is installed.
#pragma once

#include <span>

#include "core/geometry/power_cells.h"

namespace bl::cli {

/// Computes all radical cells of the sites in the box with Voro++ and returns the sum of their volumes [m³].
double voropp_total_volume(const Vector3& minimum, const Vector3& maximum, std::span<const PowerSite> sites);

}  // namespace bl::cli
