// A convex body that is cut in two repeatedly: the working shape of the makers of domains.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/geometry/domain.h"

namespace bl::geometry {

/// A convex polygon in space, counter-clockwise seen from where its plane's normal points to.
using Polygon = std::vector<Point3>;

struct PartFace {
  Plane plane;
  std::uint32_t side = Domain::kInner;  ///< as in Domain::Piece
  std::vector<std::uint32_t> loop;      ///< indices into the part's vertices, counter-clockwise from outside
};

/// A cut keeps the vertices that it does not touch, and gives both halves the same new ones: what lies on one common face has
/// equal bits on both sides, and the volumes of the halves add up.
struct SolidPart {
  std::vector<Point3> vertices;
  std::vector<PartFace> faces;

  Polygon polygon(std::size_t face) const;
};

/// The halves of a part on the inner (normal·x < offset) and the outer side of a plane; at most one of them is missing.
struct Halves {
  std::optional<SolidPart> inside, outside;
};

/// Points that are no farther apart than this are one place, for solids of this extent [m].
double place_tolerance(const Vector3& minimum, const Vector3& maximum);

/// Vertices within the tolerance of the plane lie on it. The new faces get the side `cut_side`.
Halves cut_in_two(const SolidPart& part, const Plane& plane, double tolerance, std::uint32_t cut_side);

SolidPart part_of(const Domain::Piece& piece);
/// Fails where the part is flat.
Result<Domain::Piece> piece_of(const SolidPart& part);

double volume_of(const SolidPart& part);
Point3 middle_of(const SolidPart& part);  ///< the mean of the vertices: inside
/// Do the axis-parallel boxes around them overlap, by more than the tolerance in each direction?
bool boxes_overlap(std::span<const Point3> a, std::span<const Point3> b, double tolerance);

Vector3 area_vector(const Polygon& polygon);
/// The part of a polygon inside the half-space normal·x <= offset.
Polygon clipped(const Polygon& polygon, const Plane& plane);
/// The part of a polygon that lies inside the body, `depth` [m] deeper than its faces.
Polygon clipped(const Polygon& polygon, const SolidPart& part, double depth);
/// The common area of two convex polygons in one plane, seen along `normal`.
double common_area(const Polygon& a, const Polygon& b, const Vector3& normal);
/// The upright plane on edge i of a polygon, pointing out of it.
Plane edge_plane(const Polygon& polygon, std::size_t edge, const Vector3& normal);

}  // namespace bl::geometry
