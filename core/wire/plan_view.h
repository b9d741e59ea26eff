// The plan as outlines for pages: one key for each node that is seen from above.
#pragma once

#include <map>
#include <string>

#include "core/graph/state.h"

namespace bl::wire {

/// `box`, and `n/ID` for volumes, plots, boundaries, buildings and streets. Paths are SVG path data in metres to a decimetre,
/// with y downwards, as screens have it.
std::map<std::string, std::string> plan_view(const State& state);

}  // namespace bl::wire
