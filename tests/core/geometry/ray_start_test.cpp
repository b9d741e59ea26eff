// Cells along rays: nearer to the demands than equal weights, the same bits with any threads, and hands off where they are no
// good.
#include "core/geometry/inside/ray_start.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "core/geometry/demand_fit.h"

namespace bl::geometry {
namespace {

struct Ground {
  Domain domain;
  std::vector<PowerSite> sites;
  std::vector<double> demands, weights;
};

Ground make_ground(std::size_t count, double fill, std::uint32_t seed) {
  Ground ground;
  const std::vector<Point3> plan{{0, 0, 0}, {30, 0, 0}, {30, 20, 0}, {0, 20, 0}};
  ground.domain = extrude(plan, 0, 25).value();
  std::mt19937 generator(seed);
  const auto number = [&] { return static_cast<double>(generator()) / 4294967296.0; };
  double sum = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const double x = number(), y = number(), z = number();
    ground.sites.push_back({{30 * x, 20 * y, 25 * z}, 0});
    ground.demands.push_back(std::exp(number() * std::log(20.0)));
    sum += ground.demands.back();
  }
  for (double& demand : ground.demands) demand *= fill * ground.domain.volume / sum;
  ground.weights = initial_weights(ground.domain, ground.sites, ground.demands);
  return ground;
}

// The largest relative error with such weights.
double error_of(const Ground& ground, const std::vector<double>& weights) {
  std::vector<PowerSite> sites = ground.sites;
  for (std::size_t i = 0; i < sites.size(); ++i) sites[i].weight = weights[i];
  const auto cells = power_cells(ground.domain, sites, {}).value();
  double error = 0;
  for (std::size_t i = 0; i < sites.size(); ++i) {
    error = std::max(error, std::abs(cells[i].volume - ground.demands[i]) / ground.demands[i]);
  }
  return error;
}

TEST(RayStart, ComesMuchNearerToTheDemandsThanEqualWeights) {
  for (const double fill : {0.2, 0.5, 0.7, 0.85}) {
    for (const std::size_t count : {std::size_t{20}, std::size_t{300}}) {
      SCOPED_TRACE(std::to_string(count) + " sites, fill " + std::to_string(fill));
      const Ground ground = make_ground(count, fill, 5);
      const auto weights = weights_by_rays(ground.domain, ground.sites, ground.weights, ground.demands);
      EXPECT_LT(error_of(ground, weights), 1);
      EXPECT_LT(error_of(ground, weights), 0.3 * error_of(ground, ground.weights));
    }
  }
}

TEST(RayStart, ThreadsAndDistanceFromTheOriginMakeNoDifference) {
  Ground ground = make_ground(700, 0.7, 6);
  const auto alone = weights_by_rays(ground.domain, ground.sites, ground.weights, ground.demands);
  ThreadPool pool(3);
  EXPECT_EQ(weights_by_rays(ground.domain, ground.sites, ground.weights, ground.demands, &pool), alone);
  const Vector3 away{4096, -8192, 2048};
  const std::vector<Point3> plan{away, away + Vector3{30, 0, 0}, away + Vector3{30, 20, 0}, away + Vector3{0, 20, 0}};
  ground.domain = extrude(plan, away.z, away.z + 25).value();
  for (PowerSite& site : ground.sites) site.position += away;
  const auto moved = weights_by_rays(ground.domain, ground.sites, ground.weights, ground.demands);
  double farthest = 0;
  for (std::size_t i = 0; i < alone.size(); ++i) farthest = std::max(farthest, std::abs(moved[i] - alone[i]) / alone[i]);
  EXPECT_LT(farthest, 1e-3);
}

TEST(RayStart, WhatItIsNoGoodForComesBackAsItWas) {
  const auto comes_back = [](const Ground& ground) {
    return weights_by_rays(ground.domain, ground.sites, ground.weights, ground.demands) == ground.weights;
  };
  EXPECT_FALSE(comes_back(make_ground(50, 0.6, 7)));
  EXPECT_TRUE(comes_back(make_ground(0, 0.6, 7)));
  EXPECT_TRUE(comes_back(make_ground(5, 0.6, 7)));
  EXPECT_TRUE(comes_back(make_ground(50, 0.95, 7)));
  Ground crowd = make_ground(50, 0.6, 7);
  for (PowerSite& site : crowd.sites) site.position = 0.1 * site.position;
  crowd.weights = initial_weights(crowd.domain, crowd.sites, crowd.demands);
  EXPECT_TRUE(comes_back(crowd));
  Ground line = make_ground(100, 0.6, 7);
  for (PowerSite& site : line.sites) site.position = {15, 10, site.position.z};
  line.weights = initial_weights(line.domain, line.sites, line.demands);
  EXPECT_TRUE(comes_back(line));
  Ground idle = make_ground(50, 0.6, 7);
  idle.demands[3] = 0;
  EXPECT_TRUE(comes_back(idle));
}

bool are_weights(const std::vector<double>& weights) {
  return std::all_of(weights.begin(), weights.end(), [](double weight) { return std::isfinite(weight) && weight > 0; });
}

TEST(RayStart, OddPlacesAndDemandsGiveWeightsThatAreNumbers) {
  Ground ground = make_ground(60, 0.7, 8);
  ground.sites[1].position = ground.sites[0].position;
  ground.sites[2].position = ground.sites[0].position + Vector3{1e-9, 0, 0};
  ground.sites[3].position = ground.sites[0].position + Vector3{1e-4, 0, 0};
  ground.sites[4].position = {0, 0, 0};
  ground.sites[5].position = {30, 20, 25};
  for (const double share : {1e-3, 1e-6, 1e-11}) {
    SCOPED_TRACE(share);
    ground.demands[6] *= share;
    const auto weights = weights_by_rays(ground.domain, ground.sites, ground.weights, ground.demands);
    EXPECT_NE(weights, ground.weights);
    EXPECT_TRUE(are_weights(weights));
    ground.demands[6] /= share;
  }
  // Beyond what single precision holds.
  for (const double share : {1e-13, 1e-40, 1e-300}) {
    ground.demands[6] *= share;
    EXPECT_EQ(weights_by_rays(ground.domain, ground.sites, ground.weights, ground.demands), ground.weights) << share;
    ground.demands[6] /= share;
  }
}

// Demands scaled back to a fill after one of them was made so many times the mean.
Ground make_ground_with_one_large(std::size_t count, double fill, std::uint32_t seed, double large) {
  Ground ground = make_ground(count, fill, seed);
  const double volume = fill * ground.domain.volume;
  ground.demands[6] = large * volume / static_cast<double>(count);
  double sum = 0;
  for (const double demand : ground.demands) sum += demand;
  for (double& demand : ground.demands) demand *= volume / sum;
  ground.weights = initial_weights(ground.domain, ground.sites, ground.demands);
  return ground;
}

// One that nothing cuts: the place to look from is pushed nowhere.
TEST(RayStart, ALargeBallWithNobodyNear) {
  for (const double large : {30.0, 1000.0, 1e5}) {
    const Ground ground = make_ground_with_one_large(60, 1e-3, 9, large);
    const auto weights = weights_by_rays(ground.domain, ground.sites, ground.weights, ground.demands);
    EXPECT_TRUE(are_weights(weights)) << large;
    EXPECT_GT(weights[6], 4 * ground.weights[6]) << large;
    EXPECT_LT(error_of(ground, weights), error_of(ground, ground.weights)) << large;
  }
}

// Small balls wholly inside a large one cut it as others do.
TEST(RayStart, SmallCellsInsideALargeBallAreSeen) {
  for (const double large : {20.0, 30.0, 60.0}) {
    for (const std::uint32_t seed : {10u, 11u, 12u}) {
      const Ground ground = make_ground_with_one_large(200, 0.3, seed, large);
      const auto weights = weights_by_rays(ground.domain, ground.sites, ground.weights, ground.demands);
      EXPECT_TRUE(are_weights(weights));
      EXPECT_LT(error_of(ground, weights), 0.5 * error_of(ground, ground.weights)) << large << " " << seed;
    }
  }
}

}  // namespace
}  // namespace bl::geometry
