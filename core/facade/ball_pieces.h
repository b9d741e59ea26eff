// What of a shape lies on its ball, in small pieces.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/base/mesh.h"
#include "core/facade/facing.h"

namespace bl::facade {

/// A convex polygon that is nearly flat.
struct BallPiece {
  std::array<std::uint32_t, 4> corners{};  ///< places among the points of all pieces
  std::uint32_t count = 0;                 ///< of corners: three or four
  Facing facing;                           ///< of the ball in its middle
  Vector3 flat_normal;                     ///< of the polygon
  double flat_area = 0;                    ///< the sum of its triangles, seen along the normal [m²]
};

struct BallPieces {
  std::vector<Point3> points;  ///< each once for all pieces of a triangle that meet in it
  std::vector<BallPiece> pieces;
  double area = 0;  ///< of all pieces [m²]
};

/// Each triangle of the coarse `mesh` in 36 parts; what of these reaches beyond the ball is moved onto it. `mesh.wrap` is there.
/// `out` gives its room, which is used again.
void find_ball_pieces(const Mesh& mesh, const Compass& compass, BallPieces& out);

}  // namespace bl::facade
