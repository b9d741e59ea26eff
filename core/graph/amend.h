// Plans for scenes in which a few nodes or links differ, such as the reading of a sensor: made from the last plan.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "core/graph/item_edits.h"
#include "core/graph/moved_plan.h"
#include "core/graph/plan.h"

namespace bl {

struct Amended {
  std::optional<MovedPlan> moved;  ///< where nodes were added or removed: all that follows goes on from it
  std::shared_ptr<const Plan> plan;
  std::vector<std::uint32_t> nodes;                           ///< of which more than the name differs; ascending
  std::vector<ItemEdit> links;                                ///< ascending
  std::vector<std::pair<std::uint32_t, std::uint32_t>> sets;  ///< nodes and their typifications whose sets were found anew
};

/// What compile() would make of the scene, as long as no node that stays has other typifications than in `plan`, and settings and
/// scripts are the same; nothing where they are not, and the scene has to be compiled. `registry`: the types of the program.
std::optional<Amended> amend(const Plan& plan, const Scene& scene, const Registry& registry);

}  // namespace bl
