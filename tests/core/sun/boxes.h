// Boxes to cast shadows in tests: upright, turned, as closed meshes; and a ray test of another make.
#pragma once

#include <cmath>
#include <memory>
#include <vector>

#include "core/base/mesh.h"
#include "core/base/random.h"
#include "core/sun/shadow_scene.h"

namespace bl::sun {

/// A closed box that stands at `foot` (the middle of its underside), turned by `angle` [rad] about the vertical.
inline Mesh box_mesh(const Point3& foot, double width, double depth, double height, double angle = 0) {
  Mesh mesh;
  for (const double z : {0.0, height})
    for (const auto& [x, y] : {std::pair{-0.5, -0.5}, {0.5, -0.5}, {0.5, 0.5}, {-0.5, 0.5}}) {
      const double across = x * width, along = y * depth;
      mesh.vertices.push_back({foot.x + across * std::cos(angle) - along * std::sin(angle),
                               foot.y + across * std::sin(angle) + along * std::cos(angle), foot.z + z});
    }
  mesh.triangles = {{0, 2, 1}, {0, 3, 2}, {4, 5, 6}, {4, 6, 7}};
  for (std::uint32_t i = 0; i < 4; ++i) {
    const std::uint32_t j = (i + 1) % 4;
    mesh.triangles.push_back({i, j, j + 4});
    mesh.triangles.push_back({i, j + 4, i + 4});
  }
  return mesh;
}

inline std::vector<MeshPointer> random_boxes(int count, std::uint64_t seed, double reach = 500) {
  Random random(seed);
  std::vector<MeshPointer> boxes;
  for (int i = 0; i < count; ++i)
    boxes.push_back(std::make_shared<const Mesh>(
        box_mesh({random.uniform(-reach, reach), random.uniform(-reach, reach), random.uniform(-1, 5)}, random.uniform(3, 30),
                 random.uniform(3, 30), random.uniform(3, 60), random.uniform(0, 3.2))));
  return boxes;
}

inline bool is_shaded(const ShadowScene& scene, const Point3& origin, const Vector3& toward, ShadowScene::Mask mask = {}) {
  std::vector<std::uint32_t> found;
  scene.blockers(origin, toward, found, mask);
  return !found.empty();
}

/// Solves origin + t toward = a + u (b - a) + v (c - a) by cross products (Möller and Trumbore 1997): unlike the one under test.
inline bool plain_hit(const Point3& origin, const Vector3& toward, const Point3& a, const Point3& b, const Point3& c,
                      double nearest) {
  const Vector3 ab = b - a, ac = c - a, normal = cross(toward, ac);
  const double volume = dot(ab, normal);
  if (volume == 0) return false;
  const Vector3 from = origin - a;
  const double u = dot(from, normal) / volume;
  if (u < 0 || u > 1) return false;
  const Vector3 other = cross(from, ab);
  const double v = dot(toward, other) / volume;
  if (v < 0 || u + v > 1) return false;
  return dot(ac, other) / volume > nearest;
}

/// Does the ray meet the mesh? Every triangle is asked.
inline bool plain_hit(const Point3& origin, const Vector3& toward, const Mesh& mesh, double nearest) {
  for (const auto& [a, b, c] : mesh.triangles)
    if (plain_hit(origin, toward, mesh.vertices[a], mesh.vertices[b], mesh.vertices[c], nearest)) return true;
  return false;
}

}  // namespace bl::sun
