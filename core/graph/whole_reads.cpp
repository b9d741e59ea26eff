// Finds the nodes of whole ends that differ by their identity: states share what stays the same.
#include "core/graph/whole_reads.h"

#include <algorithm>

#include "core/graph/link_run.h"

namespace bl {

bool WholeReads::follow(const State& frozen, const LinkPlan& plan) {
  if (is_known_ && has_whole_) read_changes(frozen, plan);
  else if (!is_known_) read_all(frozen, plan);
  return has_whole_;
}

void WholeReads::read_all(const State& frozen, const LinkPlan& plan) {
  const std::vector<LinkRead>& reads = plan.definition->reads;
  const bool has_whole = std::any_of(reads.begin(), reads.end(), [](const LinkRead& read) { return read.is_whole; });
  if (!has_whole) {
    is_known_ = true;
    return;
  }
  reads_.values.resize(reads.size());
  for (std::size_t r = 0; r < reads.size(); ++r) {
    reads_.values[r].resize(reads[r].is_whole ? plan.reads[r].size() : 1);
    for (std::size_t i = 0; reads[r].is_whole && i < plan.reads[r].size(); ++i)
      reads_.values[r][i] = value_read(frozen, reads[r], plan.reads[r][i]);
  }
  reads_.loaded = &loaded_;
  nodes_ = frozen.nodes;
  node_plans_ = frozen.plan->nodes;
  // Last of all: an exception on the way leaves what has to be begun again.
  has_whole_ = is_known_ = true;
}

void WholeReads::read_changes(const State& frozen, const LinkPlan& plan) {
  // Changes that the last evaluation has not taken, because its kind takes none or because it failed before: then it is loaded
  // anew when it asks.
  if (!loaded_.changed[0].empty() || !loaded_.changed[1].empty()) loaded_.is_complete = false;
  for (auto& changed : loaded_.changed) changed.clear();
  each_difference(nodes_, frozen.nodes, [&](std::uint32_t n) {
    for (const End end : {End::from, End::to}) {
      const auto at = place_in(plan.nodes[static_cast<std::size_t>(end)], n);
      if (!at) continue;
      loaded_.changed[static_cast<std::size_t>(end)].push_back(*at);
      for (std::size_t r = 0; r < plan.reads.size(); ++r) {
        const LinkRead& read = plan.definition->reads[r];
        // Ids and locks stay as they are in all plans with the same links.
        if (read.is_whole && read.end == end && !read.is_lock && plan.reads[r][*at].type != PortRef::kNodeId)
          reads_.values[r][*at] = &frozen.value(plan.reads[r][*at]);
      }
    }
  });
  nodes_ = frozen.nodes;
}

}  // namespace bl
