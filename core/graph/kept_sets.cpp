// Finds the members that differ by the identity of their nodes: states share what stays the same.
#include "core/graph/kept_sets.h"

#include <algorithm>
#include <utility>

#include "core/base/sorted_runs.h"

namespace bl {

namespace {

// Reads one member again; whether anything in it differs.
bool read_member(const StateDraft& draft, const SetPlan& plan, std::size_t m, SetValues& set) {
  const std::size_t count = plan.reads.size() / plan.members.size();
  bool differs = false;
  for (std::size_t r = m * count; r < (m + 1) * count; ++r) {
    const Value& value = draft.value(plan.reads[r]);
    if (set.reads[r] == value) continue;
    if (const auto* number = std::get_if<double>(&value)) set.reads[r] = *number;
    else set.reads[r] = value;
    differs = true;
  }
  return differs;
}

}  // namespace

std::span<const SetPlan> sets_of(const Plan& plan, const SetGroup& group) {
  return std::span(plan.sets).subspan(group.first, group.count);
}

SetValues read_set(const StateDraft& draft, const SetPlan& plan) {
  SetValues set;
  set.members = plan.members.size();
  set.reads.reserve(plan.reads.size());
  for (const PortRef& ref : plan.reads) set.reads.push_back(draft.value(ref));
  return set;
}

void KeptSets::read_all(const StateDraft& draft, std::span<const SetPlan> plans) {
  structure_ = draft.state.plan->dependents->sets;
  sets_.clear();
  seen_.clear();
  for (const SetPlan& plan : plans) {
    sets_.push_back(read_set(draft, plan));
    auto& seen = seen_.emplace_back(plan.members.size());
    for (std::size_t m = 0; m < seen.size(); ++m) seen[m].node = draft.nodes.item(plan.members[m]);
  }
}

// Nodes, ascending: all others are the same objects as in the state that the tick of the last reading went out from, and neither
// that tick nor this one has written to them.
std::vector<std::uint32_t> KeptSets::may_differ(const StateDraft& draft) const {
  std::vector<std::uint32_t> nodes = written_;
  const std::vector<std::uint32_t> own = draft.nodes.own_items();
  nodes.insert(nodes.end(), own.begin(), own.end());
  each_difference(nodes_, draft.state.nodes, [&](std::uint32_t n) { nodes.push_back(n); });
  sort_runs(nodes);
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  return nodes;
}

std::span<SetValues> KeptSets::read(const StateDraft& draft, const SetGroup& group, bool is_anew) {
  const auto plans = sets_of(*draft.state.plan, group);
  // Until all is written: an exception on the way leaves replies that nobody has got.
  const bool was_complete = std::exchange(is_complete_, false);
  if (is_anew || !was_complete || structure_ != draft.state.plan->dependents->sets || nodes_.size() != draft.nodes.size()) {
    read_all(draft, plans);
    nodes_ = draft.state.nodes;
    return sets_;
  }
  const std::vector<std::uint32_t> nodes = may_differ(draft);
  nodes_ = draft.state.nodes;
  for (std::size_t s = 0; s < plans.size(); ++s) {
    SetValues& set = sets_[s];
    set.is_anew = false;
    set.changed.clear();
    set.answered.reset();
    set.writes.clear();
    const std::vector<std::uint32_t>& members = plans[s].members;
    auto at = members.begin();
    for (const std::uint32_t n : nodes) {
      at = std::lower_bound(at, members.end(), n);
      if (at == members.end()) break;
      if (*at != n) continue;
      const auto m = static_cast<std::uint32_t>(at - members.begin());
      Seen& seen = seen_[s][m];
      const auto& now = draft.nodes.item(n);
      const bool is_other = now != seen.node;
      if (!is_other && !seen.may_differ) continue;
      // What is another node may have lost its replies, whatever is read of it.
      if (read_member(draft, plans[s], m, set) || is_other) set.changed.push_back(m);
      if (is_other) seen.node = now;
      seen.may_differ = false;
    }
  }
  return sets_;
}

void KeptSets::note_written(const StateDraft& draft, const SetGroup& group, bool is_complete) {
  is_complete_ = is_complete;
  if (!is_complete) return;
  const auto plans = sets_of(*draft.state.plan, group);
  written_ = draft.nodes.own_items();
  for (std::size_t s = 0; s < plans.size(); ++s) {
    const std::vector<std::uint32_t>& members = plans[s].members;
    auto at = members.begin();
    for (const std::uint32_t n : written_) {
      at = std::lower_bound(at, members.end(), n);
      if (at == members.end()) break;
      if (*at != n) continue;
      Seen& seen = seen_[s][static_cast<std::size_t>(at - members.begin())];
      if (const auto& now = draft.nodes.item(n); seen.node != now) seen.node = now;
      seen.may_differ = true;
    }
  }
}

}  // namespace bl
