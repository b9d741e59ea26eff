// The shapes of shadows for drawing: the outline on the ground, the body of shade, and the planes under which neighbours keep
// their sun.
#pragma once

#include <span>
#include <vector>

#include "core/base/mesh.h"

namespace bl::sun {

/// The outline of the shadow on the level plane at `ground`, counter-clockwise: the hull of the projected corners, which is exact
/// for a convex mesh, and holds the shadow of any other. What lies below the plane casts nothing. Empty where the sun is not
/// above the horizon, where the shadow would be longer than 100 km, or nothing is above the plane. `toward` points to the sun.
std::vector<Point3> shadow_outline(const Mesh& mesh, const Vector3& toward, double ground);

/// The shade of a closed mesh down to the level plane at `ground`, as a closed mesh: every point in it has the mesh between
/// itself and the sun, or lies within the mesh. Shades of several bulges overlap. Empty where the outline is.
Mesh shadow_volume(const Mesh& mesh, const Vector3& toward, double ground);

/// A half-space as dot(normal, p) <= offset, with a normal of length 1.
struct SunPlane {
  Vector3 normal;
  double offset = 0;
};
/// The planes through the edge from `a` to `b` along each ray to the sun: a building that stays below all of them, on the side of
/// the edge that the building is on, throws no shadow over the edge. `inside` is a point of the building's side. Suns that stand
/// on the other side of the edge, along it or below the horizon give none.
std::vector<SunPlane> solar_envelope(const Point3& a, const Point3& b, const Point3& inside, std::span<const Vector3> suns);

}  // namespace bl::sun
