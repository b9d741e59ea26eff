// What of a shape lies on its ball, in small pieces.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/base/mesh.h"

namespace bl::facade {

/// A convex polygon that is nearly flat.
struct BallPiece {
  std::uint32_t first = 0, count = 0;  ///< of the corners of all pieces
  Vector3 flat_normal;                 ///< of the polygon
  /// From the ball's centre to the middle of the polygon, several times as long, to within rounding; nothing (0, 0, 0) where the
  /// middle is that close to the centre that rounding counts.
  Vector3 about_outward;
  double flat_area = 0;  ///< the sum of its triangles, seen along the normal [m²]
};

struct BallPieces {
  Point3 centre;  ///< of the ball
  std::vector<Point3> corners;
  std::vector<BallPiece> pieces;
  double area = 0;  ///< of all pieces [m²]

  std::span<const Point3> of(const BallPiece& piece) const { return std::span(corners).subspan(piece.first, piece.count); }
  /// From the ball's centre to the middle of the polygon.
  Vector3 outward(std::span<const Point3> polygon) const;
};

/// Twice the area of a polygon from its corners, seen along its normal.
inline double doubled_area(std::span<const Point3> polygon, const Vector3& normal) {
  double doubled = 0;
  for (std::size_t i = 2; i < polygon.size(); ++i)
    doubled += dot(normal, cross(polygon[i - 1] - polygon[0], polygon[i] - polygon[0]));
  return doubled;
}

/// Each triangle of the coarse `mesh` in 36 parts; what of these reaches beyond the ball is moved onto it. `mesh.wrap` is there.
BallPieces ball_pieces(const Mesh& mesh);

}  // namespace bl::facade
