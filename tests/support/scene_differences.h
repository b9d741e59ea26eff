// All places at which two scenes differ, found by looking at everything: what the record of a command's touches is held to.
#pragma once

#include <set>

#include "core/graph/scene.h"
#include "core/graph/touch.h"

namespace bl {

std::set<Touch> differences(const Scene& before, const Scene& after);

}  // namespace bl
