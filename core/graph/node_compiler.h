// Compiles the nodes of a scene, and the sets of nodes that some of them evaluate.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/graph/plan.h"

namespace bl {

/// `registry`: the types of the scene. Which types are served by sets of other nodes is found out by mark_served().
NodePlan compiled_node(const Scene& scene, const Registry& registry, const std::string& id, const NodeRecord& record);
/// Set `s` of typification `t` of node `n`; the plan has its nodes and their forms. Where it cannot be evaluated, it says why.
SetPlan compiled_set(const Plan& plan, const Registry& registry, std::uint32_t n, std::uint32_t t, std::uint32_t s);
/// Fills in the sets and analyses of a plan that has its nodes: `make(n, t, s)` gives each set, in their order.
template <class Make>
void put_sets(Plan& plan, const Make& make) {
  std::vector<SetPlan> sets;
  plan.analyses.clear();
  for (std::uint32_t n = 0; n < plan.nodes.size(); ++n) {
    const auto& types = plan.forms->types_of(n);
    for (std::uint32_t t = 0; t < types.size(); ++t) {
      const TypificationDefinition& definition = *types[t];
      if (!definition.latency.empty())
        plan.analyses.push_back({n, t, sets.size(), definition.sets.size(), definition.port_index(definition.latency)});
      for (std::uint32_t s = 0; s < definition.sets.size(); ++s) sets.push_back(make(n, t, s));
    }
  }
  plan.sets = SharedVector<SetPlan>(std::move(sets));
}
/// Members of sets get their results from there. Returns the nodes for which that is otherwise than the plan said; ascending.
std::vector<std::uint32_t> mark_served(Plan& plan);

}  // namespace bl
