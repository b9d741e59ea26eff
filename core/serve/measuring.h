// Measures what a session will ask of this computer: commits on its disk, and ticks of its scene.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/graph/scene.h"

namespace bl::serve {

/// [s]
struct Durations {
  double median = 0, worst = 0;
  std::size_t count = 0;
};
/// Of at least one.
Durations durations_of(std::vector<double> seconds);

/// Commits so often into a session file of its own in that folder, each with what a room writes after a tick, and removes the
/// file.
Result<Durations> measure_commits(const std::string& folder, int count = 50);
/// Ticks the scene for so long [s], three times at least, while one of its volumes is moved to and fro: a scene that has settled
/// takes next to no time, and in a session somebody always moves something. The first tick sets everything up, and does not
/// count.
Result<Durations> measure_ticks(const Scene& scene, double seconds = 1.5);

}  // namespace bl::serve
