// Fit problems for the tests of the fit and of the solver: sites, demands that fill a share of the domain, a judge.
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "core/geometry/volume_fit.h"
#include "tests/core/geometry/site_zoo.h"

namespace bl::test {

struct FitScene {
  geometry::Domain domain;
  geometry::FitProblem problem;
};

/// Random sites in the unit cube, demands log-uniform over a factor, that fill a share of it.
inline FitScene fit_scene(std::size_t count, double fill, std::uint64_t seed, double factor = 20) {
  FitScene scene{unit_cube(), {}};
  Random random(seed);
  double sum = 0;
  for (std::uint32_t i = 0; i < count; ++i) {
    scene.problem.sites.push_back({random_point(random, {0, 0, 0}, {1, 1, 1}), 0});
    const double wanted = std::pow(factor, random.uniform());
    scene.problem.demands.push_back({{i}, wanted, wanted});
    sum += wanted;
  }
  for (geometry::VolumeDemand& demand : scene.problem.demands) demand.least = demand.most = demand.least * fill / sum;
  return scene;
}

/// The volumes of these weights, from nothing but the sites.
inline std::vector<double> volumes_of(const geometry::Domain& domain, std::vector<geometry::PowerSite> sites,
                                      std::span<const double> weights) {
  for (std::size_t i = 0; i < sites.size(); ++i) sites[i].weight = weights[i];
  geometry::CellOptions options;
  options.with_shape = options.with_centroid = false;
  std::vector<double> volumes;
  const auto cells = power_cells(domain, sites, options).value();
  for (const geometry::CellMeasure& cell : cells) volumes.push_back(cell.volume);
  return volumes;
}

inline geometry::VolumeFit fit_of(const FitScene& scene, const geometry::VolumeFitOptions& options = {}) {
  auto fit = fit_volumes(scene.domain, scene.problem, options);
  EXPECT_TRUE(fit.ok()) << (fit.ok() ? "" : fit.error().text());
  return fit.ok() ? *fit : geometry::VolumeFit{};
}

/// Reported volumes are those of the reported weights; where the status says met, every demand is, to the tolerance.
inline void expect_honest(const FitScene& scene, const geometry::VolumeFit& fit, double tolerance) {
  ASSERT_EQ(fit.weights.size(), scene.problem.sites.size());
  for (const double weight : fit.weights) ASSERT_TRUE(std::isfinite(weight));
  const auto volumes = volumes_of(scene.domain, scene.problem.sites, fit.weights);
  for (std::size_t i = 0; i < volumes.size(); ++i) {
    EXPECT_NEAR(fit.volumes[i], volumes[i], 1e-12 * volumes[i] + 1e-14 * scene.domain.volume) << i;
  }
  double worst = 0;
  for (const geometry::VolumeDemand& demand : scene.problem.demands) {
    if (demand.kind != geometry::VolumeDemand::Kind::volume) return;
    double sum = 0;
    for (const std::uint32_t i : demand.sites) sum += volumes[i];
    const double bound = std::clamp(sum, demand.least, demand.most);
    worst = std::max(worst, bound > 0 ? std::abs(sum - bound) / bound : sum > 0 ? 1.0 : 0.0);
  }
  EXPECT_NEAR(fit.max_relative_error, worst, 1e-9 + 1e-6 * worst);
  EXPECT_EQ(fit.status == geometry::FitStatus::met, worst <= tolerance) << name_of(fit.status) << " " << worst;
  EXPECT_EQ(fit.losses.empty(), worst <= tolerance);
  if (fit.status != geometry::FitStatus::met && fit.status != geometry::FitStatus::cancelled) {
    EXPECT_FALSE(fit.reasons.empty());
  }
}

}  // namespace bl::test
