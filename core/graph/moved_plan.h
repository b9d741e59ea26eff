// Plans in which nodes were added or removed before anything else is done: all others have new numbers.
#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "core/graph/item_edits.h"
#include "core/graph/plan.h"

namespace bl {

/// A step on the way to a plan with more or fewer nodes.
struct MovedPlan {
  /// The scene is still the one before. Links and sets speak of the same nodes by their new numbers. Those that spoke of a node
  /// which is gone, and the sets of new nodes, are still to be made; so are the dependents.
  std::shared_ptr<Plan> plan;
  std::vector<std::uint32_t> places;  ///< by node before: its number now, or ItemEdit::kNone
};

/// `edits` of nodes, ascending; `now`: the scene with the nodes that were added. `registry`: the types of the scene.
MovedPlan moved_plan(const Plan& before, const Scene& now, std::span<const ItemEdit> edits, const Registry& registry);

}  // namespace bl
