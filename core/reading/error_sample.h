// The errors of one tick, for a chart of how a run settled.
#pragma once

#include <cstdint>

namespace bl::reading {

/// What one tick was like; collected by whoever runs the scene.
struct ErrorSample {
  std::int64_t tick = 0;
  double worst_error = 0;   ///< share of the demand
  double mean_error = 0;    ///< share of the demand
  double largest_move = 0;  ///< [m]
};

}  // namespace bl::reading
