// The triangles of a closed mesh, gathered into flat faces in an order that does not follow the mesh.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/geometry/convex_domain.h"

namespace bl::geometry {

/// Group g lies in planes[g]. Groups are sorted by the polar sector of the normal, then by offset.
struct CoplanarGroups {
  std::vector<std::uint32_t> group_of;  ///< per triangle
  std::vector<Plane> planes;
};

/// Triangles that join along edges and lie in one plane within rounding are one group. Each directed edge has its twin at most
/// once; points and triangles are sorted, so that the answer depends on the shape alone.
CoplanarGroups coplanar_groups(std::span<const Point3> points, std::span<const std::array<std::uint32_t, 3>> triangles);

}  // namespace bl::geometry
