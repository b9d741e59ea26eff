// States share what is the same in them: it is skipped without a look at it.
#include "core/reading/changed_nodes.h"

namespace bl::reading {

std::optional<std::vector<std::uint32_t>> changed_nodes(const State& before, const State& now) {
  // Plans that differ in values alone share what follows from all else.
  if (before.plan->dependents != now.plan->dependents || before.nodes.size() != now.nodes.size()) return std::nullopt;
  std::vector<std::uint32_t> changed;
  each_difference(before.nodes, now.nodes, [&](std::uint32_t n) { changed.push_back(n); });
  return changed;
}

}  // namespace bl::reading
