// First positions: inside, apart, the same everywhere, and neighbours near.
#include "core/making/spread_points.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/base/hash.h"
#include "core/base/random.h"
#include "core/geometry/plan_ring.h"
#include "core/making/ball_grid.h"
#include "core/making/prism_samples.h"
#include "tests/support/sanitized.h"

namespace bl::making {
namespace {

const geometry::Ring kSquare = {{0, 0, 0}, {100, 0, 0}, {100, 80, 0}, {0, 80, 0}};
const geometry::Ring kEll = {{0, 0, 0}, {100, 0, 0}, {100, 20, 0}, {20, 20, 0}, {20, 100, 0}, {0, 100, 0}};
const geometry::Ring kComb = {{0, 0, 0},   {90, 0, 0},  {90, 60, 0}, {70, 60, 0}, {70, 10, 0}, {55, 10, 0},
                              {55, 60, 0}, {35, 60, 0}, {35, 10, 0}, {20, 10, 0}, {20, 60, 0}, {0, 60, 0}};
const geometry::Ring kSliver = {{0, 0, 0}, {1000, 999, 0}, {1000, 1000, 0}};

std::vector<double> mixed_volumes(std::size_t count, double total) {
  Random random(7);
  std::vector<double> volumes;
  double sum = 0;
  for (std::size_t i = 0; i < count; ++i) sum += volumes.emplace_back(std::pow(10, random.uniform(0, 2)));
  for (double& volume : volumes) volume *= total / sum;
  return volumes;
}

double nearest_pair(const std::vector<Point3>& points) {
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < points.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) nearest = std::min(nearest, distance(points[i], points[j]));
  return nearest;
}

TEST(SpreadPoints, InsideAndApartInEveryShape) {
  for (const geometry::Ring& plan : {kSquare, kEll, kComb, kSliver})
    for (const double top : {3.0, 30.0, 300.0})
      for (const std::size_t count : {1u, 2u, 7u, 60u, test::kIsSanitized ? 100u : 1000u}) {
        const double prism = geometry::signed_area(plan) * top;
        const auto points = making::spread_points(plan, 0, top, mixed_volumes(count, 0.8 * prism), 3);
        ASSERT_TRUE(points) << points.error().text();
        ASSERT_EQ(points->size(), count);
        for (const Point3& p : *points) {
          EXPECT_TRUE(geometry::ring_contains(plan, p));
          EXPECT_GT(distance({p.x, p.y, 0}, geometry::nearest_on_ring(plan, p)), 1e-6);
          EXPECT_TRUE(p.z > 0 && p.z < top);
        }
        const double spacing = std::cbrt(prism / static_cast<double>(count));
        EXPECT_GE(nearest_pair(*points), making::kSpreadSeparation * spacing) << count << " " << top;
      }
}

TEST(SpreadPoints, KeepsOutOfHoles) {
  const std::vector<geometry::Ring> holes = {{{20, 20, 0}, {20, 60, 0}, {45, 60, 0}, {45, 20, 0}},
                                             {{60, 10, 0}, {55, 70, 0}, {90, 40, 0}}};
  for (const std::size_t count : {1u, 5u, 60u, 300u}) {
    const auto points = making::spread_points(kSquare, 0, 20, mixed_volumes(count, 60000), 3, {}, holes);
    ASSERT_TRUE(points) << points.error().text();
    for (const Point3& p : *points) {
      EXPECT_TRUE(geometry::ring_contains(kSquare, p));
      for (const geometry::Ring& hole : holes) EXPECT_FALSE(geometry::ring_contains(hole, p)) << p.x << " " << p.y;
    }
  }
  const std::vector<geometry::Ring> beyond = {{{90, 10, 0}, {110, 10, 0}, {110, 20, 0}}};
  EXPECT_EQ(making::spread_points(kSquare, 0, 20, std::vector<double>{1}, 3, {}, beyond).error().place, "holes/0");
}

TEST(SpreadPoints, OnePointStandsInTheMiddle) {
  const auto points = making::spread_points(kSquare, 10, 30, std::vector<double>{100}, 1);
  ASSERT_TRUE(points);
  EXPECT_NEAR((*points)[0].x, 50, 0.5);
  EXPECT_NEAR((*points)[0].y, 40, 0.5);
  EXPECT_NEAR((*points)[0].z, 20, 0.5);
}

TEST(SpreadPoints, BallsStayOffGroundRoofAndSides) {
  const std::vector<double> volumes(20, 0.3 * 100 * 80 * 30 / 20);
  const auto points = making::spread_points(kSquare, 0, 30, volumes, 5);
  ASSERT_TRUE(points);
  const double radius = std::cbrt(volumes[0] / 4.18879020478639);
  for (const Point3& p : *points) {
    EXPECT_GE(p.z, radius - 1e-9);
    EXPECT_LE(p.z, 30 - radius + 1e-9);
    EXPECT_GE(distance({p.x, p.y, 0}, geometry::nearest_on_ring(kSquare, p)), radius - 1e-6);
  }
}

// Balls that have to stand on the ground sink a fifth of their radius into it; they keep apart like all others.
TEST(SpreadPoints, StandsOnTheGroundWhereAsked) {
  const auto volumes = mixed_volumes(30, 0.3 * 100 * 80 * 30);
  std::vector<std::uint8_t> on_ground(30, 0);
  for (std::size_t i = 0; i < 30; i += 3) on_ground[i] = 1;
  const auto points = making::spread_points(kSquare, 4, 34, volumes, 5, {}, {}, on_ground);
  ASSERT_TRUE(points);
  for (std::size_t i = 0; i < 30; ++i) {
    const double radius = std::cbrt(volumes[i] / 4.18879020478639);
    if (on_ground[i] != 0) EXPECT_NEAR((*points)[i].z, 4 + std::min(0.8 * radius, 15.0), 1e-9) << i;
    else EXPECT_GE((*points)[i].z, 4 + std::min(radius, 15.0) - 1e-9) << i;
    for (std::size_t j = 0; j < i; ++j)
      EXPECT_GT(distance((*points)[i], (*points)[j]), making::kSpreadSeparation * std::cbrt(100.0 * 80 * 30 / 30))
          << i << " " << j;
  }
  EXPECT_EQ(making::spread_points(kSquare, 4, 34, volumes, 5, {}, {}, std::vector<std::uint8_t>(29, 0)).error().place,
            "on_ground");
}

TEST(SpreadPoints, SeedAloneDecides) {
  const auto volumes = mixed_volumes(50, 1e5);
  const auto first = making::spread_points(kComb, 0, 30, volumes, 11), again = making::spread_points(kComb, 0, 30, volumes, 11),
             other = making::spread_points(kComb, 0, 30, volumes, 12);
  ASSERT_TRUE(first && again && other);
  EXPECT_EQ(*first, *again);
  EXPECT_NE(*first, *other);
}

TEST(SpreadPoints, LargeDemandsGetMoreRoom) {
  std::vector<double> volumes(40, 1000);
  volumes[7] = volumes[23] = 40000;
  const auto points = making::spread_points(kSquare, 0, 30, volumes, 2);
  ASSERT_TRUE(points);
  EXPECT_GT(distance((*points)[7], (*points)[23]), 30);
}

TEST(SpreadPoints, NeighboursStartNear) {
  const auto volumes = std::vector<double>(60, 2000);
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  for (std::size_t i = 0; i + 30 < 60; ++i) pairs.emplace_back(i, i + 30);
  const auto with = making::spread_points(kSquare, 0, 30, volumes, 4, pairs),
             without = making::spread_points(kSquare, 0, 30, volumes, 4);
  ASSERT_TRUE(with && without);
  double near = 0, far = 0;
  for (const auto& [a, b] : pairs) {
    near += distance((*with)[a], (*with)[b]);
    far += distance((*without)[a], (*without)[b]);
  }
  RecordProperty("share", std::to_string(near / far));
  EXPECT_LT(near, 0.5 * far);
}

TEST(SpreadPoints, Errors) {
  const auto text = [](auto result) { return result ? std::string("no error") : result.error().text(); };
  const std::vector<double> one{1}, bad{1, -2};
  EXPECT_EQ(text(making::spread_points(std::vector<Point3>(2), 0, 1, one, 1)),
            "plan: The plan must be a simple polygon of at least 3 finite points with an area.");
  EXPECT_EQ(text(making::spread_points(kSquare, 5, 5, one, 1)), "plan: The top (5 m) must lie above the bottom (5 m).");
  EXPECT_EQ(text(making::spread_points(kSquare, 0, 5, bad, 1)),
            "volumes/1: The demand is -2 m³. It must be greater than zero and finite.");
  const std::vector<std::pair<std::size_t, std::size_t>> pairs{{0, 0}};
  EXPECT_EQ(text(making::spread_points(kSquare, 0, 5, one, 1, pairs)),
            "neighbours/0: The pair (0, 0) must name two different points of 1, counted from 0.");
  EXPECT_TRUE(making::spread_points(kSquare, 0, 5, {}, 1)->empty());
}

TEST(PrismSamples, CoverThePlanEvenly) {
  const auto samples = making::prism_samples(std::vector<geometry::Ring>{kEll}, 0, 10, 36000, 1);
  std::size_t arm = 0;
  for (const Point3& p : samples) {
    EXPECT_TRUE(geometry::ring_contains(kEll, p));
    arm += p.x > 20 ? 1 : 0;
  }
  // The arm east of x = 20 has 1600 of 3600 m².
  EXPECT_NEAR(static_cast<double>(arm), 16000, 150);
}

TEST(BallGrid, AgreesWithLookingAtAll) {
  Random random(3);
  std::vector<making::BallSite> sites;
  for (int i = 0; i < 200; ++i)
    sites.push_back(
        {{random.uniform(0, 50), random.uniform(0, 20), random.uniform(0, 10)}, i % 40 == 0 ? 12.0 : random.uniform(0, 2)});
  const making::BallGrid grid(sites, 3);
  for (int k = 0; k < 2000; ++k) {
    const Point3 p{random.uniform(-20, 70), random.uniform(-20, 40), random.uniform(-20, 30)};
    std::size_t best = 0;
    const auto power = [&](std::size_t i) { return squared_norm(p - sites[i].at) - sites[i].radius * sites[i].radius; };
    for (std::size_t i = 1; i < sites.size(); ++i)
      if (power(i) < power(best)) best = i;
    EXPECT_EQ(grid.nearest(p).site, best);
  }
}

TEST(PlanRing, HandChecks) {
  EXPECT_DOUBLE_EQ(geometry::signed_area(kEll), 3600);
  EXPECT_DOUBLE_EQ(geometry::perimeter(kSquare), 360);
  EXPECT_EQ(geometry::hull_of_plan(kEll), (geometry::Ring{{0, 0, 0}, {100, 0, 0}, {100, 20, 0}, {20, 100, 0}, {0, 100, 0}}));
  EXPECT_NEAR(geometry::depth_below_hull(kEll, geometry::hull_of_plan(kEll)), 20, 1e-9);
  EXPECT_FALSE(geometry::find_self_crossing(kComb));
  EXPECT_TRUE(geometry::find_self_crossing(geometry::Ring{{0, 0, 0}, {10, 0, 0}, {5, 0, 0}, {5, 5, 0}}));  // doubles back
  EXPECT_TRUE(
      geometry::find_self_crossing(geometry::Ring{{0, 0, 0}, {10, 0, 0}, {10, 10, 0}, {5, 0, 0}, {0, 10, 0}}));  // touches
}

}  // namespace
}  // namespace bl::making
