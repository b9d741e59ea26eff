// Plans for scenes in which values or links have changed, such as the reading of a sensor: made from the last plan.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "core/graph/link_edits.h"
#include "core/graph/plan.h"

namespace bl {

struct Amended {
  std::shared_ptr<const Plan> plan;
  std::vector<std::uint32_t> nodes;  ///< whose set values differ; ascending
  std::vector<LinkEdit> links;       ///< ascending
};

/// What compile() would make of the scene, as long as it differs from that of `plan` only in links, and in set values of which no
/// index, end or unit of a plan is made; nothing where it does not, and has to be compiled. `registry`: the types of the program.
std::optional<Amended> amend(const Plan& plan, const Scene& scene, const Registry& registry);

}  // namespace bl
