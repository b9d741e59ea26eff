// States that go on under another plan.
#pragma once

#include <memory>
#include <set>
#include <string>
#include <utility>

#include "core/graph/amend.h"
#include "core/graph/state.h"

namespace bl {

/// The parts of `old` that still fit a new plan; `placed` ports start again from their set values.
State carry(const State& old, std::shared_ptr<const Plan> plan, const std::set<std::pair<std::string, std::string>>& placed);
/// The same under a plan that was amended from that of `old`: what was not amended is shared.
State carry_amended(const State& old, const Amended& amended, const std::set<std::pair<std::string, std::string>>& placed);

}  // namespace bl
