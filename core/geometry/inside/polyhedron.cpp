// Volume and centroid of convex polyhedra, and domains as polyhedra.
#include "core/geometry/inside/polyhedron.h"

#include <algorithm>

#include "core/geometry/inside/wide_registers.h"

namespace bl::geometry {

BL_WIDE_REGISTERS double volume_and_centroid(const Polyhedron& shape, Point3& centroid) {
  if (shape.is_empty()) return 0;
  Point3 middle;
  for (const Point3& v : shape.vertices) middle += v;
  middle *= 1 / static_cast<double>(shape.vertices.size());
  double six_volumes = 0;
  Vector3 moment;
  for (const PolyhedronFace& face : shape.faces) {
    const auto loop = shape.loop(face);
    const Vector3 a = shape.vertices[loop[0]] - middle;
    for (std::uint32_t i = 1; i + 1 < face.count; ++i) {
      const Vector3 b = shape.vertices[loop[i]] - middle, c = shape.vertices[loop[i + 1]] - middle;
      const double six = dot(a, cross(b, c));
      six_volumes += six;
      moment += six * (a + b + c);
    }
  }
  centroid = six_volumes > 0 ? middle + moment / (4 * six_volumes) : middle;
  return std::max(0.0, six_volumes / 6);
}

Polyhedron polyhedron_of(const ConvexDomain& domain, const Point3& origin) {
  Polyhedron shape;
  for (const Point3& v : domain.vertices) shape.vertices.push_back(v - origin);
  for (std::uint32_t k = 0; k < domain.faces.size(); ++k) {
    const auto& loop = domain.faces[k];
    if (loop.size() < 3) continue;
    PolyhedronFace face;
    face.normal = domain.planes[k].normal;
    // From a corner instead of the stored offset: far from the world's origin that keeps the digits.
    face.offset = dot(face.normal, shape.vertices[loop.front()]);
    face.index = k;
    face.first = static_cast<std::uint32_t>(shape.loops.size());
    face.count = static_cast<std::uint32_t>(loop.size());
    shape.loops.insert(shape.loops.end(), loop.begin(), loop.end());
    shape.faces.push_back(face);
  }
  for (const Point3& v : shape.vertices) shape.reach_squared = std::max(shape.reach_squared, squared_norm(v));
  return shape;
}

}  // namespace bl::geometry
