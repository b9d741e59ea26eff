// What of a shape lies on its ball, in small pieces.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/base/mesh.h"

namespace bl::facade {

/// A convex polygon that is nearly flat.
struct BallPiece {
  std::uint32_t first = 0, count = 0;  ///< of the corners of all pieces
  Vector3 flat_normal;                 ///< of the polygon
  double area = 0;                     ///< [m²]
  double flat_area = 0;                ///< the same as the sum of its triangles, seen along the normal [m²]
};

struct BallPieces {
  Point3 centre;  ///< of the ball
  std::vector<Point3> corners;
  std::vector<BallPiece> pieces;

  std::span<const Point3> of(const BallPiece& piece) const { return std::span(corners).subspan(piece.first, piece.count); }
  /// From the ball's centre to the middle of the polygon.
  Vector3 outward(std::span<const Point3> polygon) const;
  /// The same several times as long, to within rounding, for a fraction of the effort; nothing that close to the centre that
  /// rounding counts.
  std::optional<Vector3> about_outward(std::span<const Point3> polygon) const {
    Vector3 sum;
    for (const Point3& corner : polygon) sum += corner - centre;
    constexpr double kFarEnough = 1e-8;  // squared: at 1e-4 of the coordinates rounding is 1e-11 of the direction
    if (!(squared_norm(sum) > kFarEnough * squared_norm(centre))) return std::nullopt;
    return sum;
  }
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
