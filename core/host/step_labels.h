// Names of the steps of the history, derived from the ids and JSON of their commands.
#pragma once

#include <string>

#include "core/define/registry.h"
#include "core/graph/scene.h"
#include "core/graph/touch.h"
#include "core/session/commands.h"

namespace bl::host {

/// "Set value · Library, position", "Add Hotel", "Move 3 boxes". `scene`: the present scene, for names.
std::string label_of_step(const Registry& registry, const Command& command, const Scene& scene);

/// "Library, demand": a place that somebody has changed.
std::string label_of_place(const Touch& place, const Scene& scene);

}  // namespace bl::host
