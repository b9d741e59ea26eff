// Storeys below the ground: under the whole lowest plate of a volume that stands, its courtyard included.
#pragma once

#include "core/geometry/plates.h"

namespace bl::geometry {

/// Exact area that a ring encloses, its arcs included; below 0 where it goes round a hole [m²].
double area_of(const PlateRing& ring, const Point3& centre);

/// The cellar: so many storeys of this height [m] below the lowest plate, each of them as large as that plate with its
/// courtyard; below a part of a plate with what that part has of the courtyard. Without storeys or outlines where there is no
/// cellar. Its storeys are no floor area of the volume above them.
PlateStack cellar_of(const StandingBody& body, int storeys, double height);

}  // namespace bl::geometry
