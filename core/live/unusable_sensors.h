// Sensors whose addresses nothing can come from.
#pragma once

#include <vector>

#include "core/base/result.h"
#include "core/graph/scene.h"

namespace bl::live {

/// One error for each, with its place and what is wrong with the address; a sensor without an address is none of them.
std::vector<Error> unusable_sensors(const Scene& scene);

}  // namespace bl::live
