// Convex polygons in space that are cut by lines in their plane: what parts of a cell have in common.
#pragma once

#include <utility>

#include "core/geometry/solid_part.h"

namespace bl::geometry {

/// The parts of a polygon within (outward·x <= offset) and beyond a line; corners within the tolerance [m] of the line belong to
/// both. A part that nowhere leaves the line by more is empty.
std::pair<Polygon, Polygon> cut_outline(const Polygon& polygon, const Vector3& outward, double offset, double tolerance);

/// The line along edge i of a polygon, out of it; false where the edge is no longer than the tolerance and so bounds nothing.
bool edge_line(const Polygon& polygon, std::size_t i, const Vector3& normal, double tolerance, Vector3& outward, double& offset);

/// [m²]; 0 for fewer than three corners.
double outline_area(const Polygon& polygon);

/// The point of a polygon that is nearest to the origin; its plane is normal·x = offset.
Point3 nearest_in_outline(const Polygon& polygon, const Vector3& normal, double offset);

}  // namespace bl::geometry
