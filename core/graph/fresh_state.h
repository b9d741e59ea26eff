// What states begin with and how their parts are named, for the files that make states.
#pragma once

#include <memory>
#include <string>
#include <utility>

#include "core/graph/state.h"

namespace bl {

/// Of an analysis of a plan: its node and its typification, by which it is found in another plan.
std::pair<std::string, std::string> analysis_name(const Plan& plan, std::size_t analysis);
/// Settings as set, computed values at their defaults.
NodeState fresh_node(const NodePlan& plan);
/// As initial_state() gives it, but for the hash.
StateDraft fresh_state(std::shared_ptr<const Plan> plan);

}  // namespace bl
