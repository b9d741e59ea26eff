// A cell as a triangle mesh for the eye and for export: faces split to a depth, then wrapped onto the ball.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/base/mesh.h"
#include "core/base/vector.h"

namespace bl {

/// Depth beyond which a mesh would have more triangles than any screen has pixels.
inline constexpr int kDeepestTessellation = 4;

/// One polygonal face of a closed convex polyhedron: indices of corners, counter-clockwise seen from outside.
using FaceLoop = std::span<const std::uint32_t>;

/// Each face becomes a fan of triangles around the mean of its corners, each triangle 4^depth equal ones; corners and edge
/// points are shared, so the mesh of a closed polyhedron is closed. Then every vertex x farther than `radius` from
/// `ball_centre` moves along the line to `wrap_centre` until it lies on the ball. `wrap_centre` has to lie in both the
/// polyhedron and the ball: the result is then star-shaped around it, hence free of folds. With wrap_centre equal to
/// ball_centre this is the shrink-wrap of 2007.
/// Positions are relative to any origin; `offset` [m] is added to every vertex at the end.
Mesh tessellate(std::span<const Point3> corners, std::span<const FaceLoop> faces, int depth, const Point3& ball_centre,
                double radius, const Point3& wrap_centre, const Vector3& offset = {});

}  // namespace bl
