// What a fit is asked for: sites, and demands on their volumes or floor areas.
#pragma once

#include <cstdint>
#include <vector>

#include "core/geometry/power_cells.h"

namespace bl::geometry {

/// What one site, or several sites together (a stand, a building with wings), are to have.
struct VolumeDemand {
  enum class Kind : std::uint8_t { volume, floor_area };
  std::vector<std::uint32_t> sites;  ///< whose volumes are added up; a site belongs to one demand at most
  double least = 0, most = 0;        ///< [m³], or [m²] of floor; equal: exactly this much
  Kind kind = Kind::volume;
  double storey_height = 3;  ///< [m]; for floor areas only
};

/// A site that belongs to no demand keeps its weight.
struct FitProblem {
  std::vector<PowerSite> sites;  ///< weights to start from; not positive: the solver starts this one by itself
  std::vector<VolumeDemand> demands;
};

}  // namespace bl::geometry
