// The state after a tick as it is read: sums over sets fit the figures beside them.
#pragma once

#include "core/graph/state.h"

namespace bl {

/// A state in which whoever only reads a set (statistics, plots) has been asked again. In a tick all evaluations over sets read
/// what was there before the solvers, so that there is no order among them, and what adds up volumes is a tick late. A page on
/// which the list of volumes and its sum differ by that tick is no use to anybody. It is no state that a tick goes on from: its
/// hash is that of the state that was given. Who keeps a memory or works beside the loop is left as it is, and so is who fails.
State with_sums_of_now(const State& state);

}  // namespace bl
