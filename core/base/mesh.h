// A triangle mesh as plain data: what the eye and the exporters get.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "core/base/vector.h"

namespace bl {

/// Triangles over shared vertices. Closed meshes are oriented outward (counter-clockwise seen from outside).
struct Mesh {
  std::vector<Point3> vertices;                         ///< [m]
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< indices into `vertices`
  bool operator==(const Mesh&) const = default;
};

/// Meshes are shared between snapshots and never changed after they were made.
using MeshPointer = std::shared_ptr<const Mesh>;

/// Signed volume [m³] enclosed by a closed mesh (divergence theorem); positive when oriented outward.
double enclosed_volume(const Mesh& mesh);

}  // namespace bl
