// Finds the casters between a point and the sun: Embree searches their triangles, and triangle_hit.h decides the hits.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "core/base/mesh.h"
#include "core/base/result.h"

namespace bl::sun {

/// Casters are named by their index. Asking does not change the scene: any number of threads may ask at once.
class ShadowScene {
 public:
  /// An empty mesh casts nothing. Errors name the caster that has a corner that is not finite.
  static Result<ShadowScene> build(std::span<const MeshPointer> casters);

  /// Which casters count; empty: all of them.
  using Mask = std::span<const std::uint8_t>;

  /// All casters that count and meet the ray further than `kStart` from its origin, in ascending order; none: the sun reaches the
  /// point. `toward` has length 1.
  void blockers(const Point3& origin, const Vector3& toward, std::vector<std::uint32_t>& found, Mask mask = {}) const;

  std::size_t casters() const;
  std::size_t triangles() const;

  /// Rays start so far from their point, so that a point on a wall is not shaded by that wall [m].
  static constexpr double kStart = 0.001;

 private:
  struct Content;
  std::shared_ptr<const Content> content_;
};

}  // namespace bl::sun
