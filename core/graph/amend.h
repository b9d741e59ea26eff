// Plans for scenes in which nothing but values has changed, such as the reading of a sensor: made from the last plan.
#pragma once

#include <memory>

#include "core/graph/plan.h"

namespace bl {

/// What compile() would make of the scene, as long as it differs from that of `plan` only in set values of which no index, end
/// or unit of a plan is made; nullptr where it does not, and has to be compiled.
std::shared_ptr<const Plan> amend(const Plan& plan, const Scene& scene);

}  // namespace bl
