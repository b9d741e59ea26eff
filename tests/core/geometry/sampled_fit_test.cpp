// Demands under every metric: met as closely as the samples can tell, or a reason.
#include "core/geometry/inside/sampled_fit.h"

#include <array>
#include <cmath>

#include "tests/core/geometry/geometry_support.h"

namespace bl::test {
namespace {

constexpr std::array kFitMetrics{geometry::Metric::power, geometry::Metric::additive, geometry::Metric::multiplicative};

geometry::Domain plot() { return box({0, 0, 0}, {40, 30, 20}); }

// Sites anywhere in the plot, demands over a factor of six that fill a share of it.
geometry::FitProblem crowd(std::size_t count, double fill, std::uint64_t seed) {
  Random random(seed);
  geometry::FitProblem problem;
  double sum = 0;
  for (std::uint32_t i = 0; i < count; ++i) {
    problem.sites.push_back({random_point(random, {0, 0, 0}, {40, 30, 20}), 0});
    const double demand = random.uniform(1, 6);
    problem.demands.push_back({{i}, demand, demand});
    sum += demand;
  }
  for (geometry::VolumeDemand& demand : problem.demands) demand.least = demand.most = demand.least / sum * fill * 24000;
  return problem;
}

bool mentions(const geometry::VolumeFit& fit, std::string_view text) {
  return std::any_of(fit.reasons.begin(), fit.reasons.end(), [&](const std::string& r) { return r.find(text) != r.npos; });
}

TEST(SampledFit, MeetsDemandsUnderEveryMetric) {
  for (const geometry::Metric metric : kFitMetrics) {
    for (const double fill : {0.3, 0.7, 0.95, 1.0}) {
      const geometry::FitProblem problem = crowd(15, fill, 7);
      const auto fit = sampled_fit(plot(), problem, {.metric = metric, .samples = 80, .tolerance = 0.005});
      ASSERT_TRUE(fit.ok()) << fit.error().text();
      EXPECT_EQ(fit->status, geometry::FitStatus::met) << name_of(metric) << " " << fill;
      EXPECT_LE(fit->max_relative_error, 0.01) << name_of(metric) << " " << fill;
      EXPECT_LE(fit->evaluations, 25) << name_of(metric) << " " << fill;
      EXPECT_TRUE(fit->losses.empty());
      // Volumes are those of the weights.
      std::vector<geometry::PowerSite> sites = problem.sites;
      for (std::size_t i = 0; i < sites.size(); ++i) sites[i].weight = fit->weights[i];
      const auto cells = sampled_cells(plot(), sites, {.metric = metric, .samples = 80}).value();
      for (std::size_t i = 0; i < sites.size(); ++i) EXPECT_EQ(cells.cells[i].volume, fit->volumes[i]);
    }
  }
}

TEST(SampledFit, UnderThePowerMetricTheWeightsAreThoseOfTheExactFit) {
  const geometry::FitProblem problem = crowd(15, 0.7, 3);
  const auto fit = sampled_fit(plot(), problem, {.metric = geometry::Metric::power, .samples = 160, .tolerance = 1e-3}).value();
  const auto exact = fit_volumes(plot(), problem, {}).value();
  for (std::size_t i = 0; i < fit.weights.size(); ++i) {
    EXPECT_NEAR(std::sqrt(fit.weights[i]), std::sqrt(exact.weights[i]), 0.01 * std::sqrt(exact.weights[i])) << i;
  }
}

TEST(SampledFit, SaysWhatTheSamplesCannotTell) {
  const geometry::FitProblem problem = crowd(10, 0.6, 5);
  const auto fine =
      sampled_fit(plot(), problem, {.metric = geometry::Metric::additive, .samples = 40, .tolerance = 1e-6}).value();
  EXPECT_EQ(fine.status, geometry::FitStatus::met);
  EXPECT_TRUE(mentions(fine, "sample lines 1.000 m apart know the volume of site"));
  EXPECT_TRUE(mentions(fine, "which is coarser than the tolerance of 1e-06: take more samples or a larger tolerance"));
  const auto coarse =
      sampled_fit(plot(), problem, {.metric = geometry::Metric::additive, .samples = 40, .tolerance = 0.2}).value();
  EXPECT_EQ(coarse.status, geometry::FitStatus::met);
  EXPECT_TRUE(coarse.reasons.empty());
}

TEST(SampledFit, GroupsIntervalsAndFixedSites) {
  geometry::FitProblem problem;
  problem.sites = {{{8, 8, 10}, 0}, {{14, 10, 10}, 0}, {{30, 8, 10}, 0}, {{30, 24, 10}, 9}, {{10, 24, 10}, 0}};
  problem.demands = {{{0, 1}, 5000, 5000}, {{2}, 2000, 4000}, {{4}, 1500, 1500}};
  for (const geometry::Metric metric : kFitMetrics) {
    const auto fit = sampled_fit(plot(), problem, {.metric = metric, .samples = 80, .tolerance = 0.01}).value();
    EXPECT_EQ(fit.status, geometry::FitStatus::met) << name_of(metric);
    EXPECT_NEAR(fit.volumes[0] + fit.volumes[1], 5000, 60) << name_of(metric);
    EXPECT_GE(fit.volumes[2], 2000 * 0.98) << name_of(metric);
    EXPECT_LE(fit.volumes[2], 4000 * 1.02) << name_of(metric);
    EXPECT_NEAR(fit.volumes[4], 1500, 20) << name_of(metric);
    EXPECT_EQ(fit.weights[3], 9);
  }
}

TEST(SampledFit, FloorAreas) {
  geometry::FitProblem problem;
  problem.sites = {{{10, 10, 10}, 0}, {{28, 18, 10}, 0}};
  problem.demands = {{{0}, 800, 800, geometry::VolumeDemand::Kind::floor_area, 3}, {{1}, 3000, 3000}};
  const auto fit =
      sampled_fit(plot(), problem, {.metric = geometry::Metric::multiplicative, .samples = 80, .tolerance = 0.03}).value();
  EXPECT_EQ(fit.status, geometry::FitStatus::met);
  EXPECT_LE(fit.max_relative_error, 0.03);
}

TEST(SampledFit, WhatCannotBeHadIsScaledAndNamed) {
  geometry::FitProblem problem;
  problem.sites = {{{10, 15, 10}, 0}, {{30, 15, 10}, 0}};
  problem.demands = {{{0}, 20000, 20000}, {{1}, 10000, 10000}};
  for (const geometry::Metric metric : kFitMetrics) {
    const auto fit = sampled_fit(plot(), problem, {.metric = metric, .samples = 48, .tolerance = 0.01}).value();
    EXPECT_EQ(fit.status, geometry::FitStatus::infeasible) << name_of(metric);
    EXPECT_TRUE(mentions(fit, "the demands exceed the domain: 30000.0 m³ are asked for, 24000.0 m³ are there"));
    ASSERT_EQ(fit.losses.size(), 2u);
    EXPECT_NEAR(fit.volumes[0], 16000, 160) << name_of(metric);
    EXPECT_NEAR(fit.volumes[1], 8000, 80) << name_of(metric);
  }
}

TEST(SampledFit, SitesOutsideAndAtOnePlace) {
  geometry::FitProblem problem;
  problem.sites = {{{10, 15, 10}, 0}, {{30, 15, 10}, 0}, {{-4, 4, 10}, 0}, {{30, 15, 10}, 0}};
  problem.demands = {{{0}, 3000, 3000}, {{1}, 3000, 3000}, {{2}, 1000, 1000}, {{3}, 500, 500}};
  for (const geometry::Metric metric : kFitMetrics) {
    const auto fit = sampled_fit(plot(), problem, {.metric = metric, .samples = 64, .tolerance = 0.01}).value();
    EXPECT_EQ(fit.status, geometry::FitStatus::infeasible) << name_of(metric);
    ASSERT_EQ(fit.losses.size(), 1u) << name_of(metric);
    EXPECT_EQ(fit.losses[0].demand, 3u);
    EXPECT_TRUE(mentions(fit, "site 3 lies at the position of site 1, which is heavier or comes first"));
    EXPECT_NEAR(fit.volumes[2], 1000, 20) << name_of(metric);
  }
}

TEST(SampledFit, StopsWhenToldTo) {
  const geometry::FitProblem problem = crowd(15, 0.9, 7);
  const auto cancelled =
      sampled_fit(plot(), problem, {.samples = 40, .tolerance = 1e-3, .progress = [](int steps, double) { return steps < 2; }});
  EXPECT_EQ(cancelled->status, geometry::FitStatus::cancelled);
  EXPECT_EQ(cancelled->evaluations, 2);
  const auto limited = sampled_fit(plot(), problem, {.samples = 40, .tolerance = 1e-3, .most_steps = 1});
  EXPECT_EQ(limited->status, geometry::FitStatus::step_limit);
  EXPECT_TRUE(mentions(*limited, "stopped after 1 evaluations with an error of"));
}

TEST(SampledFit, StepsOfTicksComeToTheSame) {
  // One or four steps a call, each call starting from the state of the last: the weights come to rest and meet the demands.
  const geometry::FitProblem problem = crowd(12, 0.8, 4);
  std::vector<double> demands;
  for (const geometry::VolumeDemand& demand : problem.demands) demands.push_back(demand.least);
  for (const geometry::Metric metric : kFitMetrics) {
    for (const int steps : {1, 4}) {
      std::vector<geometry::PowerSite> sites = problem.sites;
      geometry::FitState state;
      bool is_met = false;
      for (int call = 0; call < 30; ++call) {
        const auto now = adapt_sampled_weights(plot(), sites, demands, {}, state,
                                               {.metric = metric, .samples = 48, .tolerance = 0.01, .most_steps = steps});
        ASSERT_TRUE(now.ok()) << now.error().text();
        for (std::size_t i = 0; i < sites.size(); ++i) sites[i].weight = now->report.weights[i];
        state = now->report.state;
        is_met = now->report.is_met;
      }
      EXPECT_TRUE(is_met) << name_of(metric) << " " << steps;
    }
  }
}

TEST(SampledFit, ThreadsLeaveNoTrace) {
  const geometry::FitProblem problem = crowd(25, 0.8, 11);
  for (const geometry::Metric metric : kFitMetrics) {
    geometry::SampledFitOptions options{.metric = metric, .samples = 32, .tolerance = 0.02};
    const auto one = sampled_fit(plot(), problem, options).value();
    ThreadPool pool(3);
    options.pool = &pool;
    const auto three = sampled_fit(plot(), problem, options).value();
    EXPECT_EQ(one.weights, three.weights) << name_of(metric);
    EXPECT_EQ(one.volumes, three.volumes) << name_of(metric);
    EXPECT_EQ(one.reasons, three.reasons) << name_of(metric);
  }
}

TEST(SampledFit, BadInputGetsASentence) {
  geometry::FitProblem problem = crowd(3, 0.5, 1);
  EXPECT_EQ(sampled_fit(plot(), problem, {.tolerance = 0}).error().message, "the tolerance has to be above zero");
  EXPECT_EQ(sampled_fit(plot(), problem, {.most_steps = 0}).error().message, "a fit takes at least one step");
  EXPECT_EQ(sampled_fit(geometry::Domain{}, problem).error().message, "the domain is empty");
  EXPECT_EQ(sampled_fit(plot(), problem, {.samples = -3}).error().message,
            "sampling takes at least one sample along the longest side");
  problem.demands[1].sites = {7};
  EXPECT_EQ(sampled_fit(plot(), problem).error().message, "demand 1 names site 7, which is not there");
  const std::vector<geometry::PowerSite> sites{{{1, 1, 1}, 0}};
  EXPECT_EQ(adapt_sampled_weights(plot(), sites, std::vector<double>{-1}, {}, {}, {}).error().message,
            "the demand of site 0 is negative");
  EXPECT_EQ(adapt_sampled_weights(plot(), sites, {}, {}, {}, {}).error().message,
            "there has to be one demand, and one lock or none, for each site");
  EXPECT_TRUE(sampled_fit(plot(), geometry::FitProblem{}).ok());
}

}  // namespace
}  // namespace bl::test
