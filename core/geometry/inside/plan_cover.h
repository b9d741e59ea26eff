// The ground that the parts of one shape cover together: what lies above one another counts once.
#pragma once

#include <span>

#include "core/geometry/inside/shape_measure.h"

namespace bl::geometry {

/// Area [m²] of the union of the projections of all parts that are not empty, each cut by the same ball around the origin. Exact;
/// where no two parts lie above one another it is the sum of their footprints, bit for bit.
double plan_cover(std::span<const Polyhedron> parts, std::span<const ShapeMeasure> shapes, double squared_radius);

}  // namespace bl::geometry
