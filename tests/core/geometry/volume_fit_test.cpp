// The one-call fit: groups, intervals, floor areas, fixed weights, and the truth about what cannot be.
#include "core/geometry/volume_fit.h"

#include <cmath>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>

#include "tests/core/geometry/fit_scenes.h"

namespace bl::test {
namespace {

TEST(VolumeFit, MeetsTheLargestErrorAndSaysTheVolumesOfItsWeights) {
  for (const double tolerance : {1e-2, 1e-4, 1e-6, 1e-9}) {
    for (const double fill : {0.3, 0.7, 0.95, 1.0}) {
      SCOPED_TRACE("fill " + std::to_string(fill) + " tolerance " + std::to_string(tolerance));
      const FitScene scene = fit_scene(40, fill, 11);
      geometry::VolumeFitOptions options;
      options.tolerance = tolerance;
      const geometry::VolumeFit fit = fit_of(scene, options);
      EXPECT_EQ(fit.status, geometry::FitStatus::met);
      expect_honest(scene, fit, tolerance);
    }
  }
}

TEST(VolumeFit, AtMostTwelveStepsAtEveryFill) {
  for (const double fill : {0.3, 0.7, 0.95, 0.99, 1.0}) {
    int most = 0, evaluations = 0;
    for (std::uint64_t seed = 0; seed < static_cast<std::uint64_t>(rounds(12)); ++seed) {
      const FitScene scene = fit_scene(500, fill, 100 + seed);
      const geometry::VolumeFit fit = fit_of(scene);
      EXPECT_EQ(fit.status, geometry::FitStatus::met)
          << "fill " << fill << " seed " << seed << " error " << fit.max_relative_error;
      EXPECT_LE(fit.iterations, 12) << "fill " << fill << " seed " << seed;
      most = std::max(most, fit.iterations);
      evaluations = std::max(evaluations, fit.evaluations);
    }
    std::printf("500 sites, fill %.0f %%: at most %d steps, %d evaluations\n", 100 * fill, most, evaluations);
  }
}

TEST(VolumeFit, EveryStepLimitLeavesUsableWeights) {
  for (const double fill : {0.5, 1.0}) {
    const FitScene scene = fit_scene(60, fill, 12);
    double last = 1e300;
    for (int steps = 1; steps <= 10; ++steps) {
      SCOPED_TRACE(std::to_string(steps) + " steps, fill " + std::to_string(fill));
      geometry::VolumeFitOptions options;
      options.most_steps = steps;
      const geometry::VolumeFit fit = fit_of(scene, options);
      EXPECT_LE(fit.evaluations, steps);
      expect_honest(scene, fit, options.tolerance);
      // More steps never leave less: what is handed out is the best so far.
      EXPECT_LE(fit.max_relative_error, last);
      last = fit.max_relative_error;
    }
    EXPECT_LE(last, 1e-3);
  }
}

TEST(VolumeFit, WhatIsMetAtOnceIsTold) {
  // One site that is to have everything, and one whose weight was right before.
  FitScene one = fit_scene(1, 1.0, 3);
  EXPECT_EQ(fit_of(one).status, geometry::FitStatus::met);
  expect_honest(one, fit_of(one), 1e-6);
  FitScene again = fit_scene(20, 0.6, 4);
  const geometry::VolumeFit first = fit_of(again);
  for (std::size_t i = 0; i < 20; ++i) again.problem.sites[i].weight = first.weights[i];
  const geometry::VolumeFit second = fit_of(again);
  EXPECT_EQ(second.evaluations, 1);
  EXPECT_EQ(second.weights, first.weights);
  // All demands zero, with weights to begin with.
  FitScene nothing = fit_scene(5, 0.5, 5);
  for (geometry::VolumeDemand& demand : nothing.problem.demands) demand.least = demand.most = 0;
  for (geometry::PowerSite& site : nothing.problem.sites) site.weight = 0.05;
  EXPECT_EQ(fit_of(nothing).status, geometry::FitStatus::met);
  expect_honest(nothing, fit_of(nothing), 1e-6);
  const FitScene none{unit_cube(), {}};
  EXPECT_EQ(fit_of(none).status, geometry::FitStatus::met);
}

TEST(VolumeFit, AGroupMeetsItsSumAndItsWeightsMoveAlike) {
  for (const double fill : {0.4, 0.9, 1.0}) {
    FitScene scene = fit_scene(60, fill, 13);
    auto& demands = scene.problem.demands;
    // Sites 50..59 in two groups of five.
    for (const std::size_t k : {std::size_t{50}, std::size_t{55}}) {
      for (std::size_t j = 1; j < 5; ++j) {
        demands[k].least += demands[k + j].least;
        demands[k].sites.push_back(static_cast<std::uint32_t>(k + j));
      }
      demands[k].most = demands[k].least;
    }
    demands[51] = demands[55];
    demands.resize(52);
    const geometry::VolumeFit fit = fit_of(scene);
    EXPECT_EQ(fit.status, geometry::FitStatus::met) << fill << " " << fit.max_relative_error;
    expect_honest(scene, fit, 1e-6);
    for (const std::size_t k : {std::size_t{50}, std::size_t{55}}) {
      for (std::size_t j = 1; j < 5; ++j) EXPECT_NEAR(fit.weights[k + j], fit.weights[k], 1e-9 * fit.weights[k]) << fill;
    }
  }
}

// Between its bounds a demand asks for nothing; below or above them it goes to the nearer bound and no further.
TEST(VolumeFit, IntervalsAreLeftAloneInsideAndHeldAtTheirEnds) {
  FitScene scene = fit_scene(30, 0.5, 14);
  const geometry::VolumeFit free = fit_of(scene);
  for (std::size_t i = 0; i < 30; ++i) scene.problem.sites[i].weight = free.weights[i];
  auto& demands = scene.problem.demands;
  for (std::size_t i = 0; i < 30; ++i) {
    const double v = free.volumes[i];
    if (i % 3 == 0) demands[i].least = 0.5 * v, demands[i].most = 2 * v;                                    // inside
    if (i % 3 == 1) demands[i].least = 0.3 * v, demands[i].most = 0.7 * v;                                  // too much now
    if (i % 3 == 2) demands[i].least = 1.2 * v, demands[i].most = std::numeric_limits<double>::infinity();  // too little
  }
  const geometry::VolumeFit fit = fit_of(scene);
  EXPECT_EQ(fit.status, geometry::FitStatus::met) << fit.max_relative_error;
  expect_honest(scene, fit, 1e-6);
  for (std::size_t i = 0; i < 30; ++i) {
    const double v = free.volumes[i];
    if (i % 3 == 0) { EXPECT_EQ(fit.weights[i], free.weights[i]) << i; }
    if (i % 3 == 1) { EXPECT_NEAR(fit.volumes[i], 0.68 * v, 0.021 * v) << i; }
    if (i % 3 == 2) { EXPECT_NEAR(fit.volumes[i], 1.22 * v, 0.021 * v) << i; }
  }
}

TEST(VolumeFit, SqueezedIntervalsGiveWayDownToTheirLeast) {
  // One half asks for 70 % exactly; the other would like 40 %, but needs no more than 20 %.
  FitScene scene = fit_scene(24, 1.0, 15);
  double exact = 0, loose = 0;
  for (std::size_t i = 0; i < 24; ++i) (i % 2 ? exact : loose) += scene.problem.demands[i].least;
  for (std::size_t i = 0; i < 24; ++i) {
    geometry::VolumeDemand& demand = scene.problem.demands[i];
    const double part = demand.least / (i % 2 ? exact : loose);
    demand.least = part * (i % 2 ? 0.7 : 0.2);
    demand.most = part * (i % 2 ? 0.7 : 0.4);
  }
  const geometry::VolumeFit fit = fit_of(scene);
  EXPECT_EQ(fit.status, geometry::FitStatus::met) << fit.max_relative_error << (fit.reasons.empty() ? "" : fit.reasons[0]);
  expect_honest(scene, fit, 1e-6);
}

// Six floor areas, one of them an interval, and two volumes.
FitScene scene_of_floors() {
  FitScene scene{box({0, 0, 0}, {60, 60, 40}), {}};
  Random random(16);
  for (std::uint32_t i = 0; i < 8; ++i) {
    scene.problem.sites.push_back({random_point(random, {5, 5, 5}, {55, 55, 35}), 0});
    geometry::VolumeDemand demand{{i}, 900.0 + 100 * i, 900.0 + 100 * i, geometry::VolumeDemand::Kind::floor_area, 3.5};
    if (i >= 6) demand = {{i}, 4000, 4000};
    if (i == 5) demand.most *= 1.3;
    scene.problem.demands.push_back(demand);
  }
  return scene;
}

TEST(VolumeFit, FloorAreasAreMetAsExactlyAsVolumes) {
  geometry::VolumeFitOptions options;
  options.tolerance = 1e-6;
  const geometry::VolumeFit fit = fit_of(scene_of_floors(), options);
  EXPECT_EQ(fit.status, geometry::FitStatus::met);
  EXPECT_LE(fit.max_relative_error, 1e-6);
  EXPECT_TRUE(fit.reasons.empty());
  EXPECT_LE(fit.evaluations, 40);
}

TEST(VolumeFit, SitesOfNoDemandKeepTheirWeightBitForBit) {
  FitScene scene = fit_scene(40, 0.5, 17);
  auto& demands = scene.problem.demands;
  for (std::size_t i = 0; i < 40; ++i)
    scene.problem.sites[i].weight = i % 4 == 0 ? 0.0123456789 + 1e-5 * static_cast<double>(i) : 0;
  std::erase_if(demands, [](const geometry::VolumeDemand& demand) { return demand.sites[0] % 4 == 0; });
  const geometry::VolumeFit fit = fit_of(scene);
  EXPECT_EQ(fit.status, geometry::FitStatus::met) << fit.max_relative_error;
  expect_honest(scene, fit, 1e-6);
  for (std::size_t i = 0; i < 40; i += 4) EXPECT_EQ(fit.weights[i], scene.problem.sites[i].weight);
}

TEST(VolumeFit, CancelledByItsListener) {
  const FitScene scene = fit_scene(60, 0.9, 18);
  int calls = 0;
  double first_error = 0, last_error = 0;
  geometry::VolumeFitOptions options;
  options.progress = [&](int steps, double error) {
    EXPECT_EQ(steps, ++calls);
    (calls == 1 ? first_error : last_error) = error;
    return calls < 3;
  };
  const geometry::VolumeFit fit = fit_of(scene, options);
  EXPECT_EQ(fit.status, geometry::FitStatus::cancelled);
  EXPECT_EQ(calls, 3);
  EXPECT_LT(last_error, first_error);
  expect_honest(scene, fit, 1e-6);
}

// Also where the volumes are met just then and only the floors would have to be corrected (found by the fuzzer).
TEST(VolumeFit, StopsWhereItsListenerSays) {
  const FitScene scene = scene_of_floors();
  bool was_stopped = false;
  for (int last = 1; last <= 40; ++last) {
    geometry::VolumeFitOptions options;
    options.tolerance = 0.01;
    options.progress = [&](int steps, double) { return steps < last; };
    const geometry::VolumeFit fit = fit_of(scene, options);
    EXPECT_LE(fit.evaluations, last);
    was_stopped = was_stopped || fit.status == geometry::FitStatus::cancelled;
  }
  EXPECT_TRUE(was_stopped);
}

TEST(VolumeFit, ThreadsChangeNoBit) {
  ThreadPool two(2), three(3);
  for (const double fill : {0.5, 1.0}) {
    const FitScene scene = fit_scene(static_cast<std::size_t>(rounds(300)) + 40, fill, 19);
    const geometry::VolumeFit alone = fit_of(scene);
    for (ThreadPool* pool : {&two, &three}) {
      geometry::VolumeFitOptions options;
      options.pool = pool;
      EXPECT_EQ(fit_of(scene, options).weights, alone.weights);
    }
  }
}

void expect_weights(const nlohmann::json& given) {
  SCOPED_TRACE(given.at("name").get<std::string>());
  std::vector<geometry::Plane> planes;
  for (const auto& p : given.at("boundary").at("planes")) planes.push_back({{p[0], p[1], p[2]}, p[3]});
  FitScene scene{from_planes(planes).value(), {}};
  for (std::uint32_t i = 0; i < given.at("sites").size(); ++i) {
    const auto& p = given["sites"][i];
    scene.problem.sites.push_back({{p[0], p[1], p[2]}, 0});
    scene.problem.demands.push_back({{i}, given["demands"][i], given["demands"][i]});
  }
  geometry::VolumeFitOptions options;
  options.tolerance = 1e-11;
  const geometry::VolumeFit fit = fit_of(scene, options);
  EXPECT_EQ(fit.status, geometry::FitStatus::met) << fit.max_relative_error;
  const double size = scene.domain.size();
  for (std::size_t i = 0; i < fit.weights.size(); ++i) {
    EXPECT_NEAR(fit.weights[i], given["weights"][i].get<double>(), 1e-8 * size * size) << i;
  }
}

TEST(VolumeFit, WeightsOfTheReference) {
  for (const auto& path : reference_files("fits")) {
    const auto all = nlohmann::json::parse(std::ifstream(path));
    EXPECT_GE(all.at("cases").size(), 3u);
    for (const auto& given : all.at("cases")) expect_weights(given);
  }
}

}  // namespace
}  // namespace bl::test
