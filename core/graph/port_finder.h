// Finds ports at many nodes, as selections and declared paths name them.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/graph/plan.h"

namespace bl {

/// Finds one path at node after node. Nodes of the same typifications answer alike, so that most are not searched.
class PortFinder {
 public:
  PortFinder(const Plan& plan, PortPath path) : plan_(&plan), path_(std::move(path)) {}

  const PortPath& path() const { return path_; }
  std::optional<PortRef> at(std::uint32_t node);

 private:
  const Plan* plan_;
  PortPath path_;
  std::vector<const TypificationDefinition*> searched_;  // the typifications of the node that was searched last
  std::optional<PortRef> found_;                         // and what was found there
};

/// The path of a declaration; where a parameter chooses it, the one that the values of the parameters name.
PortPath actual_path(const TypeDefinition& definition, const PortPath& path, std::span<const Value> values);
/// What resolve() gives for the scene of the plan, as indices. Ascending.
std::vector<std::uint32_t> selected_nodes(const Plan& plan, const Registry& registry, const Selection& selection);
/// Can somebody who expects this kind read the port? `verb`: who, and what for, as in "link reads".
Result<void> check_kind(const Plan& plan, PortRef ref, ValueKind expected, const MadeType& made, const char* verb);

}  // namespace bl
