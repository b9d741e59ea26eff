// Where a new volume goes: inside the boundary, as far from the others as it gets.
#pragma once

#include "core/graph/scene.h"

namespace bl::desktop::canvas {

/// For the next SmartVolume of the scene. Its size is not ours to say: it would be a voice against the brief.
Point3 place_volume(const Registry& registry, const Scene& scene);

}  // namespace bl::desktop::canvas
