// Lists are merged: what stays is taken over, and what belongs to a node or link that has changed is read again.
#include "core/reading/problems_memo.h"

#include <algorithm>
#include <utility>

#include "core/reading/changed_nodes.h"

namespace bl::reading {

void ProblemsMemo::follow_tensions(const State& state, const std::vector<std::uint32_t>& changed) {
  std::vector<TensePort> merged;
  merged.reserve(tense_.size());
  auto next = tense_.begin();
  for (const std::uint32_t node : changed) {
    while (next != tense_.end() && next->ref.node < node) merged.push_back(*next++);
    while (next != tense_.end() && next->ref.node == node) ++next;
    add_tense_ports(state, node, merged);
  }
  merged.insert(merged.end(), next, tense_.end());
  tense_ = std::move(merged);
}

// The links of the plan are the same: what they say may not be.
void ProblemsMemo::follow_links(const State& state) {
  std::vector<std::uint32_t> merged;
  auto next = links_.begin();
  for (std::uint32_t l = 0; l < state.links.size(); ++l) {
    if (l % LinkStates::kLeaf == 0 && state.links.shares_leaf(state_->links, l / LinkStates::kLeaf)) {
      const std::uint32_t end = l + static_cast<std::uint32_t>(LinkStates::kLeaf);
      while (next != links_.end() && *next < end) merged.push_back(*next++);
      l = end - 1;
      continue;
    }
    while (next != links_.end() && *next <= l) ++next;
    if (has_error(state, l)) merged.push_back(l);
  }
  links_ = std::move(merged);
}

void ProblemsMemo::read(const std::shared_ptr<const State>& state) {
  if (state == state_) return;
  const auto changed = state_ ? changed_nodes(*state_, *state) : std::nullopt;
  if (changed) {
    follow_tensions(*state, *changed);
    follow_links(*state);
  } else {
    tense_ = tense_ports(*state);
    links_ = links_with_errors(*state);
  }
  places_.read(*state, changed);
  state_ = state;
}

}  // namespace bl::reading
