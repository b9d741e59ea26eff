// Which nodes two states differ in, at a cost that does not grow with those that are the same.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/graph/state.h"

namespace bl::reading {

/// Ascending. Nothing where the scenes differ in more than values: in nodes, links, names, roles, settings.
std::optional<std::vector<std::uint32_t>> changed_nodes(const State& before, const State& now);

}  // namespace bl::reading
