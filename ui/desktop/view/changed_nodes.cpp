// States share what is the same in them: it is skipped without a look at it.
#include "ui/desktop/view/changed_nodes.h"

#include <algorithm>

namespace bl::desktop {

std::optional<std::vector<std::uint32_t>> changed_nodes(const State& before, const State& now) {
  // Plans that differ in values alone share what follows from all else.
  if (before.plan->dependents != now.plan->dependents || before.nodes.size() != now.nodes.size()) return std::nullopt;
  std::vector<std::uint32_t> changed;
  for (std::size_t leaf = 0; leaf < now.nodes.leaf_count(); ++leaf) {
    if (now.nodes.shares_leaf(before.nodes, leaf)) continue;
    const std::size_t end = std::min(now.nodes.size(), (leaf + 1) * NodeStates::kLeaf);
    for (std::size_t n = leaf * NodeStates::kLeaf; n < end; ++n)
      if (now.nodes.item(n) != before.nodes.item(n)) changed.push_back(static_cast<std::uint32_t>(n));
  }
  return changed;
}

}  // namespace bl::desktop
