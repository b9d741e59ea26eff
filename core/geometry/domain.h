// The boundary of a SmartVolumes solver: any solid, kept as a union of convex pieces.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "core/geometry/convex_domain.h"

namespace bl::geometry {

/// A solid as convex pieces whose interiors are disjoint. Makers split pieces where needed, so that the face of each plane of
/// a piece lies either wholly on the surface of the solid or wholly between two pieces. One convex domain is one piece whose
/// plane k is side `#k`.
struct Domain {
  static constexpr std::string_view kMadeName = "a domain";  ///< as nodes hand it on
  /// In `Piece::sides`: the face lies between two pieces and is not part of the surface.
  static constexpr std::uint32_t kInner = 0xffffffffu;

  struct Piece {
    ConvexDomain shape;
    std::vector<std::uint32_t> sides;  ///< per plane of `shape`: the boundary side `#s` that its face lies in, or kInner
    bool operator==(const Piece&) const = default;
  };

  std::vector<Piece> pieces;
  std::uint32_t side_count = 0;  ///< sides are 0 .. side_count - 1; each maker documents them
  double volume = 0;             ///< [m³]
  Point3 centroid;               ///< [m]; of a solid that is not convex it may lie outside
  Vector3 minimum, maximum;      ///< corners of the axis-parallel box around it [m]
  bool operator==(const Domain&) const = default;

  Domain() = default;
  /// Not explicit: a convex domain can be used wherever a domain is needed.
  Domain(ConvexDomain convex);  // NOLINT(google-explicit-constructor)

  bool is_convex() const { return pieces.size() == 1; }
  /// Diagonal of the box around it [m]: what tolerances are relative to.
  double size() const { return distance(minimum, maximum); }
  /// Is the point in one of the pieces, or outside by no more than `tolerance` [m]?
  bool contains(const Point3& point, double tolerance = 0) const;
  /// The piece that contains the point, or the one whose planes it violates least; not for an empty domain.
  const ConvexDomain& nearest_piece(const Point3& point) const;
  const ConvexDomain& largest_piece() const;
  /// The position itself where it is inside; else the first place inside on the line to the middle of the nearest piece.
  Point3 place_inside(const Point3& position) const;
};

/// Joins pieces to a domain with volume, centroid, box and side count. Fails where there is no piece.
Result<Domain> join_pieces(std::vector<Domain::Piece> pieces);

}  // namespace bl::geometry
