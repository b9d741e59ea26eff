// The exact form of a volume, a ball cut by planes: drawings made from it are smooth and do not depend on a mesh.
#pragma once

#include <vector>

#include "core/geometry/convex_domain.h"
#include "core/graph/state.h"
#include "core/reading/views/volume.h"

namespace bl::reading {

/// The half-space normal·x <= offset [m]; `normal` is a unit vector.
using Cut = geometry::Plane;

/// The part of the ball inside all cuts.
struct ExactShape {
  Point3 centre;
  double radius = 0;      ///< [m]
  std::vector<Cut> cuts;  ///< those that touch the ball
};

/// Corners of a flat face or a section, in order around it; arcs are fine polygons.
using Corners = std::vector<Point3>;

/// The face on cut k, counter-clockwise seen from outside; empty where other cuts leave nothing of it.
Corners face_of(const ExactShape& shape, std::size_t cut);
/// The horizontal section at height z.
Corners section_of(const ExactShape& shape, double z);
/// Outward unit normal of the surface at a point on it.
Vector3 normal_at(const ExactShape& shape, const Point3& point);
/// Points whose convex hull, seen along `toward`, is the outline of the shape.
Corners outline_of(const ExactShape& shape, const Vector3& toward);

/// The shape of a SmartVolume node from its place, weight, neighbours and the planes of the solver's boundary. Empty (radius 0)
/// where these do not give the footprint and height that the solver reports: then another geometry is at work, and its mesh
/// counts.
ExactShape exact_shape(const State& state, std::uint32_t node, const reading::VolumeFigures& volume);

}  // namespace bl::reading
