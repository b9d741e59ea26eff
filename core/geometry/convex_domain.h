// The boundary of a SmartVolumes solver: a convex polyhedron, made from points, planes, a plan or a mesh.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/base/mesh.h"
#include "core/base/result.h"
#include "core/base/vector.h"

namespace bl::geometry {

/// The half-space normal·x <= offset [m]; `normal` is a unit vector that points out of the domain.
struct Plane {
  Vector3 normal;
  double offset = 0;
  bool operator==(const Plane&) const = default;
};

/// A bounded convex polyhedron. Boundary side `#k` of the diagram is `planes[k]`, so each maker below guarantees the order of
/// planes. A redundant plane keeps its index and has an empty face.
struct ConvexDomain {
  std::vector<Plane> planes;
  std::vector<Point3> vertices;                   ///< [m]
  std::vector<std::vector<std::uint32_t>> faces;  ///< per plane: indices into `vertices`, counter-clockwise from outside
  double volume = 0;                              ///< [m³]
  Point3 centroid;                                ///< [m]
  Vector3 minimum, maximum;                       ///< corners of the axis-parallel box around it [m]
  bool operator==(const ConvexDomain&) const = default;

  /// Diagonal of the box around it [m]: what tolerances are relative to.
  double size() const { return distance(minimum, maximum); }
  /// Is the point inside, or outside by at most `tolerance` [m]?
  bool contains(const Point3& point, double tolerance = 0) const;
  /// The largest share s <= `most` for which centroid + s * way lies inside.
  double share_inside(const Vector3& way, double most) const;
};

/// Largest absolute coordinate [m] that this folder accepts.
inline constexpr double kLargestCoordinate = 1e8;

/// The convex hull of "boundary points" (the 2007 boundary). Coplanar triangles of the hull are one face. Planes are sorted
/// by (polar sector of the normal, offset), so their order does not depend on the order of the points.
Result<ConvexDomain> convex_hull(std::span<const Point3> points);

/// The intersection of half-spaces normal·x <= offset; normals of any length. Plane k stays plane k.
Result<ConvexDomain> from_planes(std::span<const Plane> planes);

/// A convex plan polygon (x and y of the points, either orientation, closing duplicate and collinear points allowed)
/// between two heights [m]. Plane 0 is the bottom, plane 1 the top, then one wall per side of the plan: counter-clockwise,
/// from the first corner that was given.
Result<ConvexDomain> extrude(std::span<const Point3> plan, double bottom, double top);

/// A closed convex mesh back to a domain, with the planes sorted as `convex_hull` does; a mesh that is not convex is refused.
Result<ConvexDomain> from_mesh(const Mesh& mesh);

/// The boundary as a closed triangle mesh, oriented outward.
Mesh to_mesh(const ConvexDomain& domain);

}  // namespace bl::geometry
