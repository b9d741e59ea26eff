// Parts of a cell that reach far beyond their ball, cut nearer to it before they become a mesh.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/geometry/inside/shape_measure.h"
#include "core/geometry/power_cells.h"

namespace bl::geometry {

/// Cells hold at most so many times the volume of their shape when they are divided for a mesh.
inline constexpr double kMostTrimmedShare = 1.7;

/// The parts without what lies far beyond the ball, cut off by planes that leave the ball whole: their shape stays the same, and
/// their faces are no larger than what is seen of them. Nothing where they fit well enough as they are. All parts are cut by the
/// same planes, so that they still meet. `centroid` of the shape, relative to the site.
std::optional<std::vector<Polyhedron>> trimmed_parts(std::span<const Polyhedron> parts, std::span<const ShapeMeasure> shapes,
                                                     const PowerSite& site, const Point3& centroid);

}  // namespace bl::geometry
