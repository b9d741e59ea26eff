// Finds ports at many nodes, as selections and declared paths name them.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/graph/plan.h"

namespace bl {

/// Where a path leads at each of the nodes. All of them have such a port, unless it is optional: then PortRef::kNodeId stands for
/// one that is lacking. `check(ref)`, a Result<void>, is asked once for each form of the nodes that have it.
template <class Check>
Result<std::vector<PortRef>> ports_at(const Plan& plan, std::span<const std::uint32_t> nodes, const PortPath& path,
                                      bool is_optional, const Check& check) {
  std::vector<std::optional<PortRef>> found(plan.forms->types.size());
  std::vector<PortRef> ports;
  ports.reserve(nodes.size());
  for (const std::uint32_t node : nodes) {
    std::optional<PortRef>& port = found[plan.forms->of[node]];
    if (!port) {
      port = plan.find(node, path);
      if (!port && is_optional) port = PortRef{node, PortRef::kNodeId, 0};
      else if (auto done = check(*port); !done) return done.error();
    }
    port->node = node;
    ports.push_back(*port);
  }
  return ports;
}

/// Finds one path at node after node. Nodes of the same form answer alike: one of each is searched.
class PortFinder {
 public:
  PortFinder(const Plan& plan, PortPath path) : plan_(&plan), path_(std::move(path)) {}

  const PortPath& path() const { return path_; }
  std::optional<PortRef> at(std::uint32_t node);

 private:
  const Plan* plan_;
  PortPath path_;
  struct Searched {
    std::uint32_t form = 0;
    std::optional<PortRef> found;  // at some node of that form
  };
  std::vector<Searched> searched_;
  std::size_t last_ = 0;
};

/// The path of a declaration; where a parameter chooses it, the one that the values of the parameters name.
PortPath actual_path(const TypeDefinition& definition, const PortPath& path, std::span<const Value> values);
/// What resolve() gives for the scene of the plan, as indices. Ascending.
std::vector<std::uint32_t> selected_nodes(const Plan& plan, const Registry& registry, const Selection& selection);
/// Can somebody who expects this kind read the port? `verb`: who, and what for, as in "link reads".
Result<void> check_kind(const Plan& plan, PortRef ref, ValueKind expected, const MadeType& made, const char* verb);

}  // namespace bl
