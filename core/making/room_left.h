// What remains of the sites of a scene to build on, beside what the brief asks for.
#pragma once

#include <string>

#include "core/define/registry.h"
#include "core/graph/scene.h"

namespace bl::making {

/// One sentence; empty where the scene has no site.
std::string room_left_text(const Scene& scene, const Registry& registry);

}  // namespace bl::making
