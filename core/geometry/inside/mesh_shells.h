// A closed mesh made ready to be cut: welded, sorted, simple, and with every shell turned the right way.
#pragma once

#include <cstdint>
#include <vector>

#include "core/base/mesh.h"
#include "core/base/result.h"

namespace bl::geometry {

/// The same solid with each place one vertex, vertices and triangles sorted, and each shell turned outward, or, where it bounds a
/// cavity of another, into the cavity. Errors name the place where the mesh is open, crosses or touches itself.
Result<Mesh> ready_mesh(const Mesh& mesh);

/// How often the mesh goes round the point: 1 within a solid, 0 outside and in cavities, between them on the surface.
double winding_number(const Mesh& mesh, const Point3& point);

/// Two triangles of a welded mesh that meet elsewhere than in a common edge or corner, or one that has no area; none in a simple
/// mesh. Exact.
struct TrianglePair {
  std::uint32_t first = 0, second = 0;
};
Result<std::vector<TrianglePair>> crossing_triangles(const Mesh& mesh);

}  // namespace bl::geometry
