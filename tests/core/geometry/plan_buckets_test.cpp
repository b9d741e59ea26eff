// Balls near a vertical line: all that a look at every ball finds, and hardly more.
#include "core/geometry/inside/plan_buckets.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "core/base/random.h"

namespace bl::geometry {
namespace {

struct Balls {
  std::vector<Point3> centres;
  std::vector<double> radii;
};

Balls random_balls(std::uint64_t seed, std::size_t count, double side) {
  Random random(seed, 3);
  Balls balls;
  for (std::size_t i = 0; i < count; ++i) {
    balls.centres.push_back({random.uniform(-side, side), random.uniform(-side, side), random.uniform(0, 30)});
    balls.radii.push_back(i % 97 == 0 ? 60 : i % 31 == 0 ? 0 : random.uniform(0.5, 6));
  }
  return balls;
}

TEST(PlanBuckets, FindsAllThatALookAtEveryBallFinds) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Balls balls = random_balls(seed, 300, 80);
    const PlanBuckets buckets(balls.centres, balls.radii);
    for (std::size_t i = 0; i < 60; ++i) {
      std::multiset<std::size_t> seen;
      buckets.near(balls.centres[i], balls.radii[i], 0.9, [&](std::size_t j) { seen.insert(j); });
      for (std::size_t j = 0; j < balls.centres.size(); ++j) {
        const Vector3 way = balls.centres[j] - balls.centres[i];
        const bool is_near = balls.radii[j] > 0 && std::hypot(way.x, way.y) <= 0.9 * (balls.radii[i] + balls.radii[j]);
        EXPECT_LE(seen.count(j), 1u);
        EXPECT_GE(seen.count(j), is_near ? 1u : 0u) << seed << " " << i << " " << j;
      }
    }
  }
}

// One large ball among many small ones does not make all of them neighbours: the number seen grows with the balls, not with its
// square.
TEST(PlanBuckets, SeesAFewOfMany) {
  const Balls balls = random_balls(5, 4000, 600);
  const PlanBuckets buckets(balls.centres, balls.radii);
  std::size_t seen = 0;
  for (std::size_t i = 0; i < balls.centres.size(); ++i)
    buckets.near(balls.centres[i], balls.radii[i], 0.87, [&](std::size_t) { ++seen; });
  EXPECT_LT(seen, 4000u * 4000u / 40);
  EXPECT_GT(seen, 4000u);
}

TEST(PlanBuckets, FarAndOddPlacesAreTaken) {
  const std::vector<Point3> centres = {{1e300, 0, 0}, {0, 0, 0}, {-1e300, -1e300, 0}, {3, 0, 0}};
  const std::vector<double> radii = {1, 2, 1e-300, 2};
  const PlanBuckets buckets(centres, radii);
  std::set<std::size_t> seen;
  buckets.near({0, 0, 0}, 2, 1, [&](std::size_t i) { seen.insert(i); });
  EXPECT_TRUE(seen.contains(1) && seen.contains(3) && !seen.contains(0));
}

}  // namespace
}  // namespace bl::geometry
