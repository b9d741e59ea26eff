// What of a shape lies on its ball, in small pieces.
#pragma once

#include <span>
#include <vector>

#include "core/base/mesh.h"

namespace bl {

/// A convex polygon that is nearly flat.
struct BallPiece {
  std::size_t first = 0, count = 0;  ///< of the corners of all pieces
  Vector3 flat_normal, ball_normal;  ///< of the polygon, and of the ball in its middle
  double area = 0;                   ///< [m²]
};

struct BallPieces {
  std::vector<Point3> corners;
  std::vector<BallPiece> pieces;
  std::span<const Point3> of(const BallPiece& piece) const { return std::span(corners).subspan(piece.first, piece.count); }
};

/// Each triangle of the coarse `mesh` in 36 parts; what of these reaches beyond the ball is moved onto it. `mesh.wrap` is there.
BallPieces ball_pieces(const Mesh& mesh);

}  // namespace bl
