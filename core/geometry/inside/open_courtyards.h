// Plates whose courtyards reach an outer wall.
#pragma once

#include "core/geometry/plates.h"

namespace bl::geometry {

/// Where a courtyard has sides on those of the plate, the plate is open there: it becomes what is left of it, without a
/// courtyard, and its arcs become chords within a tenth of a millimetre. A hole on the edge would be no closed body.
void open_courtyards(PlateStack& stack, const Point3& centre);

}  // namespace bl::geometry
