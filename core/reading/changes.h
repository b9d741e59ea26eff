// What changed between two states: who came and went, and which ports hold something else.
#pragma once

#include <string>
#include <vector>

#include "core/graph/state.h"

namespace bl::reading {

struct Changes {
  std::vector<std::string> added_nodes, removed_nodes;  ///< ids, ascending
  std::vector<std::string> added_links, removed_links;  ///< ids, ascending
  std::vector<std::string> retyped_nodes;               ///< ids of those that are in both, with other typifications
  /// In the later state, ascending: ports of nodes that are in both, whose values differ, or whose typification is new there.
  std::vector<PortRef> ports;

  bool is_empty() const;
};

/// Values are compared by content, and where both states share them at no cost; meshes by identity alone: one that was made anew
/// counts as another one.
Changes changes_between(const State& before, const State& after);

}  // namespace bl::reading
