// What shapes cover in plan: a place inside of one, and the ground under several.
#pragma once

#include <vector>

#include "core/geometry/plan_ring.h"

namespace bl::importing {

/// A place inside a ring: the centre of the largest of its triangles; of rings of very many corners, the middle of the widest
/// stretch that lies inside on the line through its middle.
Point3 place_inside(const geometry::Ring& ring);

/// An outline with its holes.
using PlanShape = std::vector<const geometry::Ring*>;

/// The ground that the shapes cover together [m²]: what lies under several counts once. Measured along 512 lines from west to
/// east, exactly on each of them.
double covered_area(const std::vector<PlanShape>& shapes);

/// The ground that lies under both shapes [m²], exactly: their triangles are cut by each other. The first ring of a shape is its
/// outline, the others are holes.
double common_area(const PlanShape& a, const PlanShape& b);

}  // namespace bl::importing
