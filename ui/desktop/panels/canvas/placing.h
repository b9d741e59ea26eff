// Where a new volume goes: inside the boundary, as far from the others as it gets, and as large as its neighbours.
#pragma once

#include "core/graph/scene.h"

namespace bl::desktop::canvas {

struct NewVolume {
  Point3 position;
  double demand = 1000;  ///< [m³]
};
/// For the next SmartVolume of the scene.
NewVolume place_volume(const Registry& registry, const Scene& scene);

}  // namespace bl::desktop::canvas
