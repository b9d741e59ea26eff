// A triangle mesh as plain data: what the eye and the exporters get.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "core/base/vector.h"

namespace bl {

/// How a coarse mesh becomes a finely divided one on a ball: each triangle is split in four so many times, then every vertex
/// that lies beyond the ball moves along the line to the centre of its part until it lies on the ball.
struct MeshWrap {
  static constexpr std::size_t kMostSeams = 23;  ///< exact in the 24 bits of a float, as graphics processors get them
  struct Part {
    std::uint32_t triangles = 0;  ///< how many; the parts follow each other
    Point3 centre;                ///< what its vertices move towards [m]
    std::vector<Point3> seams;    ///< what vertices on its seams with other parts move towards instead [m]
    bool operator==(const Part&) const = default;
  };
  Point3 ball_centre;  ///< [m]
  double radius = 0;   ///< [m]
  std::vector<Part> parts;
  std::vector<std::uint32_t> seams;  ///< per vertex: bit s is set where it lies on seam s of its part; the lowest bit counts
  bool operator==(const MeshWrap&) const = default;
};

/// Triangles over shared vertices. Closed meshes are oriented outward (counter-clockwise seen from outside).
struct Mesh {
  std::vector<Point3> vertices;                         ///< [m]
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< indices into `vertices`
  /// Of a coarse mesh only: the first corner of each triangle is then the centre of its face.
  std::shared_ptr<const MeshWrap> wrap = {};
  /// Of a wrapped mesh: the coarse one that it follows from, for those who divide and wrap it themselves; may be null.
  std::shared_ptr<const Mesh> coarse = {};
  /// Of a coarse mesh whose cell was cut near to its ball: the one of the whole cell, whose faces are those of its neighbours
  /// too. Null where the coarse mesh is that itself.
  std::shared_ptr<const Mesh> whole = {};
  bool operator==(const Mesh&) const = default;
};

/// Meshes are shared between snapshots and never changed after they were made.
using MeshPointer = std::shared_ptr<const Mesh>;

/// The coarse mesh of the whole cell, where `mesh` brings it along; else `mesh` itself.
inline const Mesh& whole_cell(const Mesh& mesh) {
  const Mesh& coarse = mesh.coarse && mesh.coarse->wrap ? *mesh.coarse : mesh;
  return coarse.whole ? *coarse.whole : coarse;
}

/// Signed volume [m³] enclosed by a closed mesh (divergence theorem); positive when oriented outward.
double enclosed_volume(const Mesh& mesh);

}  // namespace bl
