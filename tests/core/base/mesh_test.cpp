// The volume of closed meshes, by shapes whose volume is known.
#include "core/base/mesh.h"

#include <gtest/gtest.h>

#include <utility>

#include "core/base/random.h"

namespace bl {
namespace {

// An axis-parallel box from `low` with the given edges, oriented outward.
Mesh box(const Point3& low, const Vector3& edges) {
  Mesh mesh;
  for (int i = 0; i < 8; ++i)
    mesh.vertices.push_back(low + Vector3{(i & 1) != 0 ? edges.x : 0, (i & 2) != 0 ? edges.y : 0, (i & 4) != 0 ? edges.z : 0});
  mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                    {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return mesh;
}

TEST(Mesh, VolumesOfKnownShapes) {
  EXPECT_DOUBLE_EQ(enclosed_volume(box({0, 0, 0}, {1, 1, 1})), 1);
  EXPECT_DOUBLE_EQ(enclosed_volume(box({-1, 5, 2}, {2, 3, 4})), 24);
  const Mesh corner = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}}};
  EXPECT_DOUBLE_EQ(enclosed_volume(corner), 1.0 / 6);
}

TEST(Mesh, NothingEnclosesNothing) {
  EXPECT_EQ(enclosed_volume({}), 0);
  EXPECT_EQ(enclosed_volume({{{1, 2, 3}}, {}}), 0);
}

TEST(Mesh, TurnedInsideOutIsNegative) {
  Mesh mesh = box({0, 0, 0}, {2, 2, 2});
  for (auto& triangle : mesh.triangles) std::swap(triangle[1], triangle[2]);
  EXPECT_DOUBLE_EQ(enclosed_volume(mesh), -8);
}

TEST(Mesh, FarFromTheOriginNothingCancels) {
  const Point3 far{4e6, 5e6, 100};  // as in national coordinates; exact in a double, and so are the corners
  EXPECT_NEAR(enclosed_volume(box(far, {10, 20, 30})), 6000, 1e-9);
}

TEST(Mesh, GrowsWithTheCubeAndAddsUp) {
  Random random(5);
  for (int i = 0; i < 100; ++i) {
    const Vector3 edges{random.uniform(0.1, 9), random.uniform(0.1, 9), random.uniform(0.1, 9)};
    const double volume = enclosed_volume(box({1, 2, 3}, edges));
    ASSERT_NEAR(volume, edges.x * edges.y * edges.z, 1e-11 * volume);
    ASSERT_NEAR(enclosed_volume(box({1, 2, 3}, 3 * edges)), 27 * volume, 1e-9 * volume);
    Mesh both = box({0, 0, 0}, edges);
    const Mesh second = box({20, 0, 0}, edges);
    for (const auto& t : second.triangles) both.triangles.push_back({t[0] + 8, t[1] + 8, t[2] + 8});
    both.vertices.insert(both.vertices.end(), second.vertices.begin(), second.vertices.end());
    ASSERT_NEAR(enclosed_volume(both), 2 * volume, 1e-10 * volume);
  }
}

TEST(Mesh, ComparesByContent) {
  EXPECT_EQ(box({0, 0, 0}, {1, 1, 1}), box({0, 0, 0}, {1, 1, 1}));
  EXPECT_NE(box({0, 0, 0}, {1, 1, 1}), box({0, 0, 0}, {1, 1, 2}));
}

}  // namespace
}  // namespace bl
