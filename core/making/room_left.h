// What remains of the sites of a scene to build on, beside what the brief asks for.
#pragma once

#include <string>

#include "core/define/registry.h"
#include "core/graph/scene.h"
#include "core/making/site.h"

namespace bl::making {

/// The ground of a site without what it leaves out, or where `is_whole` with that [m²].
double ground_of(const Site& site, bool is_whole);

/// One sentence; empty where the scene has no site.
std::string room_left_text(const Scene& scene, const Registry& registry);

}  // namespace bl::making
