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
/// Members of sets get their results from there. Returns the nodes for which that is otherwise than the plan said; ascending.
std::vector<std::uint32_t> mark_served(Plan& plan);

}  // namespace bl
