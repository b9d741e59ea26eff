// The second yardstick of the bench, there only where the library is installed.
#pragma once

#include <span>
#include <vector>

#include "core/geometry/power_cells.h"

namespace bl::cli::bench {

/// Computes all radical cells of the sites in the box with Voro++ and returns the sum of their volumes [m³].
double voropp_total_volume(const Vector3& minimum, const Vector3& maximum, std::span<const geometry::PowerSite> sites);

/// The same cells as the solver's diagram has them, one after the other in long lists, which is the fastest way to keep them.
struct VoroppCells {
  std::vector<double> volumes;     ///< per site [m³]; 0 where it has no cell
  std::vector<std::size_t> first;  ///< per site: where its faces begin in the lists below
  std::vector<int> neighbours;     ///< the other site; negative: a side of the box
  std::vector<double> face_areas;  ///< [m²]
};
VoroppCells voropp_cells(const Vector3& minimum, const Vector3& maximum, std::span<const geometry::PowerSite> sites);

}  // namespace bl::cli::bench
