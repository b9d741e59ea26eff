// Plans for scenes in which a few nodes or links differ, such as the reading of a sensor: made from the last plan.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "core/graph/link_edits.h"
#include "core/graph/plan.h"

namespace bl {

struct Amended {
  std::shared_ptr<const Plan> plan;
  std::vector<std::uint32_t> nodes;                           ///< of which more than the name differs; ascending
  std::vector<LinkEdit> links;                                ///< ascending
  std::vector<std::pair<std::uint32_t, std::uint32_t>> sets;  ///< nodes and their typifications whose sets were found anew
};

/// What compile() would make of the scene, as long as it has the same nodes with the same typifications as that of `plan`, and
/// the same settings and scripts; nothing where it has not, and has to be compiled. `registry`: the types of the program.
std::optional<Amended> amend(const Plan& plan, const Scene& scene, const Registry& registry);

}  // namespace bl
