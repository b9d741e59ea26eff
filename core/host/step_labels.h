// What people call the steps of the history: derived from the commands, which say it in ids and JSON.
#pragma once

#include <string>

#include "core/define/registry.h"
#include "core/graph/scene.h"
#include "core/session/commands.h"

namespace bl::host {

/// "Set value · Library, position", "Add Hotel", "Move 3 boxes". `scene`: as it is now, for names.
std::string label_of_step(const Registry& registry, const Command& command, const Scene& scene);

}  // namespace bl::host
