// Vectors: the few operations and their laws.
#include "core/base/vector.h"

#include <gtest/gtest.h>

#include <limits>

#include "core/base/random.h"

namespace bl {
namespace {

TEST(Vector, Calculates) {
  const Vector3 a{1, 2, 3}, b{4, -5, 6};
  EXPECT_EQ(a + b, (Vector3{5, -3, 9}));
  EXPECT_EQ(a - b, (Vector3{-3, 7, -3}));
  EXPECT_EQ(-a, (Vector3{-1, -2, -3}));
  EXPECT_EQ(2 * a, (Vector3{2, 4, 6}));
  EXPECT_EQ(a * 2, 2 * a);
  EXPECT_EQ(a / 2, (Vector3{0.5, 1, 1.5}));
  EXPECT_EQ(dot(a, b), 12);
  EXPECT_EQ(cross(a, b), (Vector3{27, 6, -13}));
  EXPECT_EQ(squared_norm(a), 14);
  EXPECT_EQ(norm(Vector3{2, 3, 6}), 7);
  EXPECT_EQ(distance(Point3{1, 1, 1}, Point3{3, 4, 7}), 7);
  static_assert(cross(Vector3{1, 0, 0}, Vector3{0, 1, 0}) == Vector3{0, 0, 1});
  static_assert(Vector3{} == Vector3{0, 0, 0});
}

TEST(Vector, ChangesInPlace) {
  Vector3 a{1, 2, 3};
  a += {1, 1, 1};
  a *= 3;
  a -= {0, 9, 0};
  EXPECT_EQ(a, (Vector3{6, 0, 12}));
}

TEST(Vector, CrossIsNormalToBoth) {
  Random random(1);
  const auto any = [&] { return Vector3{random.uniform(-9, 9), random.uniform(-9, 9), random.uniform(-9, 9)}; };
  for (int i = 0; i < 1000; ++i) {
    const Vector3 a = any(), b = any(), c = cross(a, b);
    ASSERT_NEAR(dot(a, c), 0, 1e-11);
    ASSERT_NEAR(dot(b, c), 0, 1e-11);
    ASSERT_EQ(cross(b, a), -c);
    ASSERT_NEAR(squared_norm(c) + dot(a, b) * dot(a, b), squared_norm(a) * squared_norm(b), 1e-8);
  }
}

TEST(Vector, KnowsWhetherItIsFinite) {
  const double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
  EXPECT_TRUE(is_finite({1, 2, 3}));
  EXPECT_FALSE(is_finite({nan, 0, 0}));
  EXPECT_FALSE(is_finite({0, infinity, 0}));
  EXPECT_FALSE(is_finite({0, 0, -infinity}));
}

}  // namespace
}  // namespace bl
