// A cell as a triangle mesh for display and export: faces split to a depth, then wrapped onto the ball.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/base/mesh.h"
#include "core/base/vector.h"

namespace bl::geometry {

/// The largest depth; a deeper mesh would have more triangles than a screen has pixels.
inline constexpr int kDeepestTessellation = 4;
/// By depth: the mesh of a cell encloses less than its volume, but by no more than this share of it.
inline constexpr double kMostMeshLoss[kDeepestTessellation + 1] = {0.6, 0.2, 0.06, 0.02, 0.005};

/// One polygonal face of a polyhedron: indices of corners, counter-clockwise seen from outside.
using FaceLoop = std::span<const std::uint32_t>;

/// The targets of vertices outside the ball. A vertex on an edge whose two corners lie on one seam moves towards that seam's
/// point, every other one towards the centre.
struct WrapTargets {
  Point3 centre;
  std::span<const std::uint32_t> marks = {};  ///< per corner: bit s is set where it lies on seam s; empty: there is no seam
  std::span<const Point3> seams = {};
};

/// The place on the ball around the origin, on the way from a point in it to one beyond it.
Point3 place_on_ball(double squared_radius, const Point3& inside, const Point3& beyond);

/// Each face becomes a fan of triangles around the mean of its corners, each triangle 4^depth equal ones; corners and edge
/// points are shared, so the mesh of a closed polyhedron is closed. Then every vertex farther than `radius` from the origin
/// moves along the line to its target until it lies on the ball. The centre has to lie in both the polyhedron and the ball:
/// the result is then star-shaped around it, hence free of folds. With the origin as centre this is the shrink-wrap of 2007.
/// `offset` [m] is added to every vertex at the end. `border`, where given, gets the vertices on edges that only one face has.
Mesh tessellate(std::span<const Point3> corners, std::span<const FaceLoop> faces, int depth, double radius,
                const WrapTargets& targets, const Vector3& offset = {}, std::vector<std::uint32_t>* border = nullptr);

}  // namespace bl::geometry
