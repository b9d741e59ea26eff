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

  PlanBuckets buckets(double side) const { return {{-side, -side, 0}, {side, side, 0}, centres, radii}; }
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

// Each ball near one of the first is seen, and once.
void expect_all_near_are_seen(const Balls& balls, const PlanBuckets& buckets, std::uint64_t seed) {
  for (std::size_t i = 0; i < 60; ++i) {
    std::multiset<std::size_t> seen;
    buckets.near(balls.centres[i], balls.radii[i], 0.9, [&](std::size_t j) { seen.insert(j); });
    for (std::size_t j = 0; j < balls.centres.size(); ++j) {
      const Vector3 way = balls.centres[j] - balls.centres[i];
      const bool is_near = balls.radii[j] > 0 && std::hypot(way.x, way.y) <= 0.9 * (balls.radii[i] + balls.radii[j]);
      EXPECT_LE(seen.count(j), balls.radii[j] > 0 ? 1u : 0u);
      EXPECT_GE(seen.count(j), is_near ? 1u : 0u) << seed << " " << i << " " << j;
    }
  }
}

// Also where the plan is smaller than the place in which they lie.
TEST(PlanBuckets, FindsAllThatALookAtEveryBallFinds) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Balls balls = random_balls(seed, 300, 80);
    expect_all_near_are_seen(balls, balls.buckets(seed % 2 == 0 ? 80 : 40), seed);
  }
}

// Balls move, grow, shrink, go and come back.
TEST(PlanBuckets, FindsBallsThatHaveChanged) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    Balls balls = random_balls(seed, 300, 80);
    PlanBuckets buckets = balls.buckets(80);
    Random random(seed, 4);
    for (int step = 0; step < 200; ++step) {
      const std::size_t i = random.below(300);
      balls.centres[i].x += random.uniform(-60, 60);
      balls.centres[i].y += random.uniform(-6, 6);
      balls.radii[i] = step % 7 == 0 ? 0 : random.uniform(0.1, 20);
      buckets.change(i, balls.centres[i], balls.radii[i]);
    }
    expect_all_near_are_seen(balls, buckets, seed);
  }
}

// One large ball among many small ones does not make all of them neighbours: the number seen grows with the balls, not with its
// square.
TEST(PlanBuckets, SeesAFewOfMany) {
  const Balls balls = random_balls(5, 4000, 600);
  const PlanBuckets buckets = balls.buckets(600);
  std::size_t seen = 0;
  for (std::size_t i = 0; i < balls.centres.size(); ++i)
    buckets.near(balls.centres[i], balls.radii[i], 0.87, [&](std::size_t) { ++seen; });
  EXPECT_LT(seen, 4000u * 4000u / 40);
  EXPECT_GT(seen, 4000u);
}

TEST(PlanBuckets, FarAndOddPlacesAreTaken) {
  const std::vector<Point3> centres = {{1e300, 0, 0}, {0, 0, 0}, {-1e300, -1e300, 0}, {3, 0, 0}};
  const std::vector<double> radii = {1, 2, 1e-300, 2};
  const PlanBuckets buckets({-100, -100, 0}, {100, 100, 0}, centres, radii);
  std::set<std::size_t> seen;
  buckets.near({0, 0, 0}, 2, 1, [&](std::size_t i) { seen.insert(i); });
  EXPECT_TRUE(seen.contains(1) && seen.contains(3) && !seen.contains(0));
}

}  // namespace
}  // namespace bl::geometry
