// What scenes and plans take of memory for themselves, beside others that they share most of it with.
#pragma once

#include <cstddef>

#include "core/graph/plan.h"

namespace bl {

/// About how much memory the scene takes that `before` does not take; nullptr: all of it. It is no less than 0.7 of what the heap
/// gives for it. What both share is not counted, at a cost that follows what they do not share.
std::size_t held_bytes(const Scene& scene, const Scene* before);
/// The same for a plan. Of its scene only that is counted which it shares with no copy: settings and view. What readers of the
/// plan keep beside it (`PlanMemo`) is not counted.
std::size_t held_bytes(const Plan& plan, const Plan* before);

}  // namespace bl
