// A triangle mesh as plain data: what the eye and the exporters get.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
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

/// How a mesh comes about that nobody has looked at yet. It holds all that it needs: what it makes depends on nothing else.
class MeshRecipe {
 public:
  virtual ~MeshRecipe() = default;
  /// The coarse mesh; nullptr where the mesh has none. Once it has succeeded it is not called again.
  virtual std::shared_ptr<const Mesh> make_coarse() = 0;
  /// The mesh but for its `coarse`; afterwards. No coordinate of it is a zero with a sign.
  virtual Mesh make() = 0;
  /// How often each triangle of the coarse mesh is split in four.
  virtual int depth() const = 0;
};

/// A mesh that snapshots share and that never changes, or none. It may be made by the first who looks, for all copies at once:
/// one that nobody looks at costs next to nothing. Copying, comparing and asking whether there is one make nothing. Only the very
/// same mesh is equal. Where making it throws (memory has run out), so does looking; whoever looks again tries again.
class MeshPointer {
 public:
  MeshPointer() = default;
  MeshPointer(std::nullptr_t) {}                                             // NOLINT: implicit on purpose
  MeshPointer(std::shared_ptr<const Mesh> made) : mesh_(std::move(made)) {}  // NOLINT
  MeshPointer(const std::shared_ptr<Mesh>& made) : mesh_(made) {}            // NOLINT
  explicit MeshPointer(std::unique_ptr<MeshRecipe> recipe);
  MeshPointer(const MeshPointer&) = default;
  MeshPointer& operator=(const MeshPointer&) = default;
  MeshPointer(MeshPointer&& other) noexcept : mesh_(std::move(other.mesh_)), lazy_(std::exchange(other.lazy_, nullptr)) {}
  MeshPointer& operator=(MeshPointer&& other) noexcept {
    mesh_ = std::move(other.mesh_);
    lazy_ = std::exchange(other.lazy_, nullptr);
    return *this;
  }
  ~MeshPointer() = default;

  explicit operator bool() const { return mesh_ != nullptr; }
  const Mesh& operator*() const {
    look();
    return *mesh_;
  }
  const Mesh* operator->() const { return &**this; }
  /// The coarse mesh alone, as `(*this)->coarse` is: the rest is not made for it. nullptr where there is none.
  const std::shared_ptr<const Mesh>& coarse() const;
  /// Is it its coarse mesh with each triangle split in four so many times?
  bool has_depth(int depth) const;
  /// Will somebody else make it, or has done so? Such a mesh has no zeros with signs.
  bool has_recipe() const { return lazy_ != nullptr; }
  /// Is it there already, or its coarse mesh, so that looking makes nothing?
  bool is_made() const;
  bool is_coarse_made() const;

  bool operator==(const MeshPointer&) const = default;

 private:
  struct Lazy;
  void look() const {
    if (lazy_ != nullptr) make();
  }
  void make() const;

  std::shared_ptr<const Mesh> mesh_;  // of a lazy one: the place where it is made, which `lazy_` is a part of
  Lazy* lazy_ = nullptr;
};

/// The coarse mesh of the whole cell, where `mesh` brings it along; else `mesh` itself.
inline const Mesh& whole_cell(const MeshPointer& mesh) {
  const Mesh& coarse = mesh.coarse() && mesh.coarse()->wrap ? *mesh.coarse() : *mesh;
  return coarse.whole ? *coarse.whole : coarse;
}

/// Signed volume [m³] enclosed by a closed mesh (divergence theorem); positive when oriented outward.
double enclosed_volume(const Mesh& mesh);

}  // namespace bl
