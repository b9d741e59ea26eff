// The changes between two states: added and removed nodes and links, and ports with other values.
#pragma once

#include <string>
#include <vector>

#include "core/graph/state.h"

namespace bl::reading {

struct Changes {
  std::vector<std::string> added_nodes, removed_nodes;  ///< ids, ascending
  std::vector<std::string> added_links, removed_links;  ///< ids, ascending
  std::vector<std::string> retyped_nodes;               ///< ids of nodes in both states whose typifications differ
  /// In the later state, ascending: ports of nodes that are in both, whose values differ, or whose typification is new there.
  std::vector<PortRef> ports;

  bool is_empty() const;
};

/// Values are compared by content, at no cost where both states share them. Meshes are compared by identity: a new mesh counts as
/// changed.
Changes changes_between(const State& before, const State& after);

}  // namespace bl::reading
