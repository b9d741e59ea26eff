// The input of a fit: sites, and demands on their volumes or floor areas.
#pragma once

#include <cstdint>
#include <vector>

#include "core/geometry/power_cells.h"

namespace bl::geometry {

/// The demand of one site, or of several sites together (such as a building with wings).
struct VolumeDemand {
  enum class Kind : std::uint8_t { volume, floor_area };
  std::vector<std::uint32_t> sites;  ///< whose volumes are added up; a site belongs to one demand at most
  double least = 0, most = 0;        ///< [m³], or [m²] of floor; equal: exactly this much
  Kind kind = Kind::volume;
  double storey_height = 3;  ///< [m]; for floor areas only
};

/// A site that belongs to no demand keeps its weight.
struct FitProblem {
  std::vector<PowerSite> sites;  ///< initial weights; where not positive, the solver finds one
  std::vector<VolumeDemand> demands;
};

}  // namespace bl::geometry
