// The flat faces of a shape, and which of them it shares with a neighbour.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/base/mesh.h"

namespace bl::facade {

/// One flat face of a mesh: the triangles that share their first corner in a coarse mesh, or one triangle of any other.
struct ShapeFace {
  std::size_t first = 0, count = 0;  ///< of the mesh's triangles
  Vector3 normal;                    ///< unit, outward
  Point3 middle;                     ///< centre of gravity [m]
  double area = 0;                   ///< of the whole face, also beyond the ball [m²]
  bool is_shared = false;
};

/// Faces without extent are left out. Of a mesh that brings its coarse one along give the coarse one.
std::vector<ShapeFace> faces_of(const Mesh& mesh);

/// Marks the faces of `own` that stand face to face with one of `other`: same plane, same middle. Two cells of one diagram share
/// a face whole, and their balls cut the same disc out of it, because the face lies on the plane of equal power; so that what one
/// of them covers of it, the other covers too. `size` [m]: of the shapes, for the tolerance.
void mark_shared(std::span<ShapeFace> own, std::span<const ShapeFace> other, double size);

}  // namespace bl::facade
