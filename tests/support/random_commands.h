// Commands as people might give them to a scene, at random.
#pragma once

#include "core/base/random.h"
#include "core/session/commands.h"

namespace bl {

/// A command that fits the scene as it is; now and then one that is refused. `number` makes new ids unique.
Command random_command(const Scene& scene, Random& random, int number);

}  // namespace bl
