// A convex polyhedron as faces with loops of corners: what a Clipper hands out and all measures read.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/base/vector.h"
#include "core/geometry/convex_domain.h"

namespace bl::geometry {

/// What a face lies on. The order of the kinds is the order of faces.
enum class FaceKind : std::uint8_t {
  plane,  ///< a side of the boundary: `index` is its number
  site,   ///< the bisector with another site: `index` is that site
  inner,  ///< the face between two convex pieces of one boundary: no surface
  frame,  ///< an auxiliary plane beyond the ball: no surface, and never within reach
};

/// One face of a polyhedron; its corners are `loops[first .. first + count)`, counter-clockwise seen from outside.
struct PolyhedronFace {
  Vector3 normal;     ///< unit, outward
  double offset = 0;  ///< [m], signed distance of the plane from the origin
  FaceKind kind = FaceKind::plane;
  std::uint32_t index = 0;
  std::uint32_t first = 0, count = 0;
};

/// Closed: every directed edge has its twin exactly once. Edges and faces of no extent may occur.
struct Polyhedron {
  std::vector<Point3> vertices;  ///< relative to an origin [m]
  std::vector<PolyhedronFace> faces;
  std::vector<std::uint32_t> loops;
  double reach_squared = 0;  ///< largest squared distance of a vertex from the origin [m²]

  bool is_empty() const { return vertices.empty(); }
  std::span<const std::uint32_t> loop(const PolyhedronFace& face) const {
    return std::span(loops).subspan(face.first, face.count);
  }
  void clear() {
    vertices.clear();
    faces.clear();
    loops.clear();
    reach_squared = 0;
  }
};

/// Volume [m³] from the corners alone, relative to their mean; `centroid` relative to the polyhedron's origin.
double volume_and_centroid(const Polyhedron& shape, Point3& centroid);

/// A convex domain, moved so that `origin` becomes the origin.
Polyhedron polyhedron_of(const ConvexDomain& domain, const Point3& origin);

}  // namespace bl::geometry
