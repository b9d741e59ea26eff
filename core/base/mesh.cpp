// Measures of a triangle mesh.
#include "core/base/mesh.h"

namespace bl {

double enclosed_volume(const Mesh& mesh) {
  if (mesh.vertices.empty()) return 0;
  // Relative to a vertex of the mesh: far from the origin the determinants would cancel.
  const Point3 origin = mesh.vertices.front();
  double six_volumes = 0;
  for (const auto& t : mesh.triangles) {
    const Vector3 a = mesh.vertices[t[0]] - origin, b = mesh.vertices[t[1]] - origin, c = mesh.vertices[t[2]] - origin;
    six_volumes += dot(a, cross(b, c));
  }
  return six_volumes / 6;
}

}  // namespace bl
