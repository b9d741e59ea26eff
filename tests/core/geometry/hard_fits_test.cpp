// The hard cases of the mathematics, and demands that cannot be met: every one solved, or refused with the reason.
#include <cmath>

#include "tests/core/geometry/fit_scenes.h"

namespace bl::test {
namespace {

std::size_t many() { return static_cast<std::size_t>(rounds(460)) + 40; }

void refill(FitScene& scene, double fill) {
  double sum = 0;
  for (const geometry::VolumeDemand& demand : scene.problem.demands) sum += demand.least;
  for (geometry::VolumeDemand& demand : scene.problem.demands)
    demand.least = demand.most = demand.least * fill * scene.domain.volume / sum;
}

geometry::VolumeFit report(const char* name, const FitScene& scene, double tolerance = 1e-6) {
  SCOPED_TRACE(name);
  geometry::VolumeFitOptions options;
  options.tolerance = tolerance;
  const geometry::VolumeFit fit = fit_of(scene, options);
  std::printf("%-34s %-10s %3d steps %3d evaluations, error %.1e%s%s\n", name, std::string(name_of(fit.status)).c_str(),
              fit.iterations, fit.evaluations, fit.max_relative_error, fit.reasons.empty() ? "" : ": ",
              fit.reasons.empty() ? "" : fit.reasons[0].substr(0, 120).c_str());
  expect_honest(scene, fit, tolerance);
  return fit;
}

void expect_met(const char* name, const FitScene& scene) {
  EXPECT_EQ(report(name, scene).status, geometry::FitStatus::met) << name;
}

// Found among 63 sites: a start that looks along rays misses the sliver between being swallowed and swallowing.
TEST(HardFits, NearPairsAmongFewSitesAreMet) {
  for (const std::size_t count : {20, 63, 200}) {
    for (const double gap : {1e-3, 1e-4, 1e-5, 3e-6}) {
      FitScene scene = fit_scene(count, 0.7, 32);
      scene.problem.sites[7].position = scene.problem.sites[3].position + Vector3{gap, 0, 0};
      char name[64];
      std::snprintf(name, sizeof name, "%zu sites, pair at %.0e", count, gap);
      expect_met(name, scene);
    }
  }
}

TEST(HardFits, AllOfThemAreMet) {
  const auto placed = [](double fill, auto&& place) {
    FitScene scene = fit_scene(many(), fill, 31);
    for (std::uint32_t i = 0; i < scene.problem.sites.size(); ++i) {
      scene.problem.sites[i].position = place(scene.problem.sites[i].position, i);
    }
    return scene;
  };
  expect_met("corner cube of a tenth, 70 %", placed(0.7, [](const Point3& p, std::uint32_t) { return 0.1 * p; }));
  expect_met("corner cube of a tenth, 100 %", placed(1, [](const Point3& p, std::uint32_t) { return 0.1 * p; }));
  expect_met("coplanar, 70 %", placed(0.7, [](const Point3& p, std::uint32_t) { return Point3{p.x, p.y, 0.3}; }));
  expect_met("coplanar, 100 %", placed(1, [](const Point3& p, std::uint32_t) { return Point3{p.x, p.y, 0.3}; }));
  const double n = static_cast<double>(many());
  const auto on_line = [&](const Point3&, std::uint32_t i) { return Point3{(i + 0.5) / n, 0.5, 0.5}; };
  expect_met("collinear, 70 %", placed(0.7, on_line));
  expect_met("collinear, 100 %", placed(1, on_line));
  const auto lattice = [](const Point3&, std::uint32_t i) { return Point3{i % 8 + 0.5, i / 8 % 8 + 0.5, i / 64 + 0.5} / 8; };
  expect_met("lattice, 70 %", placed(0.7, lattice));
  expect_met("lattice, 100 %", placed(1, lattice));
  for (const double gap : {1e-4, 1e-5, 3e-6}) {
    for (const double fill : {0.7, 1.0}) {
      FitScene scene = fit_scene(many(), fill, 32);
      scene.problem.sites[7].position = scene.problem.sites[3].position + Vector3{gap, 0, 0};
      char name[64];
      std::snprintf(name, sizeof name, "pair at %.0e, %.0f %%", gap, 100 * fill);
      expect_met(name, scene);
    }
  }
  for (const double fill : {0.7, 1.0}) {
    expect_met(fill < 1 ? "demands over 1e4, 70 %" : "demands over 1e4, 100 %", fit_scene(many(), fill, 33, 1e4));
  }
  expect_met("fill 0.9999", fit_scene(many(), 0.9999, 34));
  expect_met("fill 0.999999", fit_scene(many(), 0.999999, 34));
  expect_met("fill exactly 1", fit_scene(many(), 1, 34));
  for (const double fill : {0.7, 1.0}) {
    FitScene slab = placed(fill, [](const Point3& p, std::uint32_t) { return Point3{p.x, p.y, 0.01 * p.z}; });
    slab.domain = box({0, 0, 0}, {1, 1, 0.01});
    refill(slab, fill);
    expect_met(fill < 1 ? "slab 1 x 1 x 0.01, 70 %" : "slab 1 x 1 x 0.01, 100 %", slab);
  }
  const auto outside = [](const Point3& p, std::uint32_t) { return 3 * p - Vector3{1, 1, 1}; };
  expect_met("most sites outside, 70 %", placed(0.7, outside));
  expect_met("most sites outside, 100 %", placed(1, outside));
  FitScene plan = fit_scene(many(), 0.7, 35);
  plan.domain = zoo_domain(4);
  refill(plan, 0.7);
  expect_met("plan with a hole, and sites there", plan);
  Random random(5);
  for (geometry::PowerSite& site : plan.problem.sites) {
    while (!plan.domain.contains(site.position)) site.position = random_point(random, {0, 0, 0}, {1, 1, 1});
  }
  refill(plan, 0.7);
  expect_met("plan with a hole, 70 %", plan);
}

// One among many, or every other one, is millions of times as large as the rest. There is room for all of them.
TEST(HardFits, DemandsThatLieFarApartAreMetOrSaidNotToBe) {
  std::size_t met = 0, tried = 0;
  for (const double ratio : {1e6, 1e7, 1e9})
    for (const double fill : {0.3, 0.9})
      for (const std::uint32_t count : {3u, 10u, 100u})
        for (const bool is_one : {true, false}) {
          FitScene scene = fit_scene(count, fill, 900);
          double sum = 0;
          for (std::uint32_t i = 0; i < count; ++i) sum += (is_one ? i == 0 : i % 2 != 0) ? 1 : 1 / ratio;
          for (std::uint32_t i = 0; i < count; ++i) {
            geometry::VolumeDemand& demand = scene.problem.demands[i];
            demand.least = demand.most = fill / sum * ((is_one ? i == 0 : i % 2 != 0) ? 1 : 1 / ratio);
          }
          const geometry::VolumeFit fit = fit_of(scene);
          const std::string name = std::to_string(count) + " over a factor " + std::to_string(ratio);
          EXPECT_NE(fit.status, geometry::FitStatus::infeasible) << name << ": that is not so";
          if (ratio == 1e6) { EXPECT_EQ(fit.status, geometry::FitStatus::met) << name << ", fill " << fill; }
          if (fit.status == geometry::FitStatus::step_limit) {
            ASSERT_FALSE(fit.reasons.empty());
            EXPECT_EQ(fit.reasons[0].find("not met after "), 0u) << fit.reasons[0];
          }
          ++tried;
          met += fit.status == geometry::FitStatus::met ? 1 : 0;
        }
  EXPECT_GE(met, tried - 2);
}

TEST(HardFits, CoincidentPairsAreRefusedByName) {
  for (const double gap : {0.0, 1e-10, 1e-8, 1e-6}) {
    FitScene scene = fit_scene(many(), 0.7, 32);
    scene.problem.sites[7].position = scene.problem.sites[3].position + Vector3{gap, 0, 0};
    char name[64];
    std::snprintf(name, sizeof name, "pair at %.0e", gap);
    const geometry::VolumeFit fit = report(name, scene);
    EXPECT_EQ(fit.status, geometry::FitStatus::infeasible);
    ASSERT_FALSE(fit.reasons.empty());
    EXPECT_NE(fit.reasons[0].find("site 3"), std::string::npos) << fit.reasons[0];
    EXPECT_NE(fit.reasons[0].find("site 7"), std::string::npos) << fit.reasons[0];
    EXPECT_EQ(fit.losses.size(), 1u);
  }
}

TEST(HardFits, MoreThanTheDomainIsScaledAndTheLossesAddUp) {
  const FitScene scene = fit_scene(many(), 1.05, 36);
  const geometry::VolumeFit fit = report("1.05 of the boundary", scene);
  EXPECT_EQ(fit.status, geometry::FitStatus::infeasible);
  ASSERT_FALSE(fit.reasons.empty());
  EXPECT_NE(fit.reasons[0].find("exceed"), std::string::npos) << fit.reasons[0];
  double lost = 0, had = 0;
  for (const geometry::VolumeLoss& loss : fit.losses) lost += loss.wanted - loss.had;
  for (const double volume : fit.volumes) had += volume;
  EXPECT_EQ(fit.losses.size(), scene.problem.demands.size());
  EXPECT_NEAR(lost, 0.05, 1e-6);
  EXPECT_NEAR(had, 1, 1e-9);
  EXPECT_LE(fit.iterations, 12);
}

TEST(HardFits, StarvedByAFixedNeighbourOrOutOfReach) {
  FitScene scene = fit_scene(10, 0.3, 37);
  // A fixed one that outweighs everybody in the domain.
  scene.problem.sites.push_back({{0.5, 0.5, 0.5}, 1e6});
  const geometry::VolumeFit starved = report("a fixed weight takes everything", scene);
  EXPECT_EQ(starved.status, geometry::FitStatus::infeasible);
  EXPECT_EQ(starved.weights.back(), 1e6);
  EXPECT_FALSE(starved.losses.empty());
  // A site far away, beside others: its cell can still be won, at a price of weight.
  scene = fit_scene(10, 0.3, 38);
  scene.problem.sites[4].position = {40, 0.5, 0.5};
  const geometry::VolumeFit far = report("one site 40 domains away", scene);
  EXPECT_TRUE(far.status == geometry::FitStatus::met || !far.losses.empty());
  scene.problem.sites[4].position = {1e7, 0.5, 0.5};
  const geometry::VolumeFit lost = report("one site 1e7 domains away", scene);
  EXPECT_EQ(lost.status, geometry::FitStatus::infeasible);
  ASSERT_EQ(lost.losses.size(), 1u) << "nobody else may pay for it";
  ASSERT_FALSE(lost.reasons.empty());
  EXPECT_EQ(lost.reasons[0].find("site 4 has 0 m³"), 0u) << lost.reasons[0];
  EXPECT_NE(lost.reasons[0].find("more than 3000 times the size of the domain away"), std::string::npos) << lost.reasons[0];
  scene.problem.sites[4].position = {4000, 0.5, 0.5};
  expect_met("one site 2300 domains away", scene);
}

// A fixed ball fills part of the domain; demands above the rest eat into it or are refused, but never lied about.
TEST(HardFits, DemandsBesideFixedWeights) {
  for (const double fill : {0.2, 0.5, 0.8, 0.99}) {
    FitScene scene = fit_scene(30, fill, 39);
    scene.problem.sites.push_back({{0.5, 0.5, 0.5}, 0.16});  // a ball of 0.268
    char name[64];
    std::snprintf(name, sizeof name, "%.0f %% beside a fixed ball of 27 %%", 100 * fill);
    const geometry::VolumeFit fit = report(name, scene);
    EXPECT_EQ(fit.weights.back(), 0.16);
    if (fill < 0.7) { EXPECT_EQ(fit.status, geometry::FitStatus::met) << fill; }
  }
}

TEST(HardFits, ZeroDemandsGetNothingAndHurtNobody) {
  FitScene scene = fit_scene(40, 0.8, 40);
  for (std::size_t i = 0; i < 40; i += 5) {
    scene.problem.demands[i].least = scene.problem.demands[i].most = 0;
    scene.problem.sites[i].weight = 0.1;
  }
  for (std::size_t i = 0; i < 40; ++i) {
    if (i % 5) scene.problem.sites[i].weight = 0.02;
  }
  const geometry::VolumeFit fit = report("zero demands", scene);
  EXPECT_EQ(fit.status, geometry::FitStatus::met);
  for (std::size_t i = 0; i < 40; i += 5) EXPECT_EQ(fit.volumes[i], 0) << i;
}

}  // namespace
}  // namespace bl::test
