// Plans for scenes in which nothing but values has changed, such as the reading of a sensor: made from the last plan.
#pragma once

#include <memory>

#include "core/graph/plan.h"

namespace bl {

/// The plan that compile() would make, if the scene differs from that of `plan` only in set values that no index, end or unit
/// depends on; else nullptr, and the scene must be compiled.
std::shared_ptr<const Plan> amend(const Plan& plan, const Scene& scene);

}  // namespace bl
