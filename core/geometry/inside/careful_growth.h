// How much growth a linear step is asked for where cells are far from their demands.
#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "core/geometry/inside/fit_numbers.h"

namespace bl::geometry {

/// Changes of volume [m³] towards the demands: what is missing; or, for a careful step, growth by the 2/3 power of what it takes.
/// The large ones grow all at once, into the same small neighbours, and would empty them. What all together ask for stays what it
/// was: in a full domain anything else has no solution. A volume below `least_share` of its demand is reckoned as that.
inline std::vector<double> changes_towards(std::span<const double> demands, std::span<const double> volumes, bool is_careful,
                                           double least_share = 0) {
  std::vector<double> changes(demands.size());
  double lost = 0, total = 0;
  for (std::size_t k = 0; k < demands.size(); ++k) {
    const double missing = demands[k] - volumes[k], volume = std::max(volumes[k], least_share * demands[k]);
    changes[k] = missing;
    if (is_careful && missing > 0 && volume > 0) {
      const double side = cube_root(demands[k] / volume);
      changes[k] = 1.5 * volume * (side * side - 1);
    }
    lost += missing - changes[k];
    total += volumes[k];
  }
  for (std::size_t k = 0; k < demands.size() && lost > 0 && total > 0; ++k) changes[k] += lost / total * volumes[k];
  return changes;
}

}  // namespace bl::geometry
