// How far a body of storeys reaches through planes of the sun, and how high it could be below them.
#pragma once

#include <limits>
#include <span>

#include "core/geometry/plates.h"
#include "core/sun/shadow_shape.h"

namespace bl::sun {

struct BodyReach {
  double excess = 0;  ///< the farthest that it reaches through a plane, level [m]; 0: it stays below all
  Vector3 back;       ///< the level direction that leads back below that plane by the shortest way; of length 1, or zero
  double allowed = std::numeric_limits<double>::infinity();  ///< the height above its lowest floor up to which it fits [m]
};

/// Exact for planes that rise, but for arcs, which are chords within a millimetre. What is allowed beyond the present top counts
/// with the plates of the highest storeys.
BodyReach reach_of(const geometry::StandingBody& body, std::span<const SunPlane> planes);

}  // namespace bl::sun
