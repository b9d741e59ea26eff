// The state after a tick for readers: sums over sets agree with the figures beside them.
#pragma once

#include "core/graph/state.h"

namespace bl {

/// A state in which typifications that only read a set (statistics, plots) have been evaluated again. In a tick, all evaluations
/// over sets read the values from before the solvers, so that their order does not matter; sums of volumes are therefore one tick
/// late. Here a list of volumes and its sum agree. No tick continues from this state: its hash is that of the given state.
/// Typifications with memory, analyses and those that fail are left unchanged.
State with_sums_of_now(const State& state);
/// The state with what its links say of it: the next tick reads it, and is `after`.
State with_links_of(const State& state, const State& after);

}  // namespace bl
