// Fitting weights to demands: convergence at every fill, one step at a time, locks, losses and repair.
#include "core/geometry/demand_fit.h"

#include <cmath>
#include <cstdio>

#include "tests/core/geometry/geometry_support.h"

namespace bl::test {
namespace {

struct Scene {
  geometry::ConvexDomain domain;
  std::vector<geometry::PowerSite> sites;
  std::vector<double> demands;
};

// Random sites in a cube of 100 m, demands over a factor of 20 that fill a share of it.
Scene make_scene(std::size_t count, double fill, std::uint64_t seed = 7) {
  Scene scene{box({0, 0, 0}, {100, 100, 100}), {}, {}};
  Random random(seed);
  double sum = 0;
  for (std::size_t i = 0; i < count; ++i) {
    scene.sites.push_back({random_point(random, {0, 0, 0}, {100, 100, 100}), 0});
    scene.demands.push_back(1 + 19 * std::pow(random.uniform(), 2));
    sum += scene.demands.back();
  }
  for (double& demand : scene.demands) demand *= fill * scene.domain.volume / sum;
  return scene;
}

geometry::FitReport fit(const Scene& scene, const geometry::FitOptions& options, std::span<const std::uint8_t> locked = {}) {
  auto report = adapt_weights(scene.domain, scene.sites, scene.demands, locked, {}, options);
  EXPECT_TRUE(report.ok()) << (report.ok() ? "" : report.error().text());
  return report.ok() ? *report : geometry::FitReport{};
}

void use(std::vector<geometry::PowerSite>& sites, const geometry::FitReport& report) {
  for (std::size_t i = 0; i < sites.size(); ++i) sites[i].weight = report.weights[i];
}

void expect_met(const Scene& scene, const geometry::FitReport& report, double tolerance) {
  EXPECT_TRUE(report.is_met) << report.error;
  std::vector<geometry::PowerSite> sites = scene.sites;
  use(sites, report);
  const auto cells = cells_of(scene.domain, sites);
  for (std::size_t i = 0; i < sites.size(); ++i) {
    EXPECT_NEAR(cells[i].volume, report.demands[i], tolerance * report.demands[i]) << i;
    EXPECT_NEAR(cells[i].volume, report.volumes[i], 1e-12 * report.demands[i]) << i;
  }
}

TEST(DemandFit, FeedbackMeetsDemandsAtEveryFill) {
  for (const std::size_t count : {std::size_t{60}, std::size_t{1000}}) {
    for (const double fill : {0.3, 0.5, 0.7, 0.9}) {
      SCOPED_TRACE(std::to_string(count) + " sites, fill " + std::to_string(fill));
      const Scene scene = make_scene(count, fill);
      geometry::FitOptions options;
      options.steps = 150;
      const geometry::FitReport report = fit(scene, options);
      expect_met(scene, report, 0.01);
      std::printf("feedback: %zu sites, fill %.0f %%: %d steps to 1 %%\n", count, 100 * fill, report.steps);
    }
  }
}

TEST(DemandFit, NewtonMeetsDemandsInAHandfulOfSteps) {
  for (const std::size_t count : {std::size_t{60}, std::size_t{1000}}) {
    for (const double fill : {0.3, 0.7, 0.95, 0.99}) {
      SCOPED_TRACE(std::to_string(count) + " sites, fill " + std::to_string(fill));
      const Scene scene = make_scene(count, fill);
      geometry::FitOptions options;
      options.method = geometry::FitMethod::newton;
      options.steps = 30;
      options.tolerance = 1e-6;
      const geometry::FitReport report = fit(scene, options);
      expect_met(scene, report, 1e-6);
      EXPECT_LE(report.steps, 16);
      std::printf("newton: %zu sites, fill %.0f %%: %d steps to 1e-6\n", count, 100 * fill, report.steps);
    }
  }
}

TEST(DemandFit, SavedStateMakesSingleStepsEqualToManyInOneCall) {
  for (const geometry::FitMethod method : {geometry::FitMethod::feedback, geometry::FitMethod::newton}) {
    const Scene scene = make_scene(40, 0.8);
    geometry::FitOptions options;
    options.method = method;
    options.steps = 12;
    options.tolerance = 1e-12;
    const geometry::FitReport at_once = fit(scene, options);
    options.steps = 1;
    ThreadPool pool(3);
    options.pool = &pool;
    auto sites = scene.sites;
    geometry::FitState state;
    for (int i = 0; i < 12; ++i) {
      const auto report = adapt_weights(scene.domain, sites, scene.demands, {}, state, options);
      ASSERT_TRUE(report.ok());
      use(sites, *report);
      state = report->state;
    }
    for (std::size_t i = 0; i < sites.size(); ++i) EXPECT_EQ(sites[i].weight, at_once.weights[i]) << i;
  }
}

TEST(DemandFit, ConstantGainIsTheRuleOf2007) {
  const Scene scene = make_scene(10, 0.2);
  auto sites = scene.sites;
  for (geometry::PowerSite& site : sites) site.weight = 100;
  const auto cells = cells_of(scene.domain, sites);
  geometry::FitOptions options;
  options.gain = 1e-4;
  const auto report = adapt_weights(scene.domain, sites, scene.demands, {}, {}, options);
  ASSERT_TRUE(report.ok());
  for (std::size_t i = 0; i < sites.size(); ++i) {
    EXPECT_DOUBLE_EQ(report->weights[i], 100 + 1e-4 * (scene.demands[i] - cells[i].volume));
  }
}

TEST(DemandFit, LockedWeightsStay) {
  Scene scene = make_scene(30, 0.5);
  std::vector<std::uint8_t> locked(30, 0);
  for (std::size_t i = 0; i < 30; i += 5) {
    locked[i] = 1;
    scene.sites[i].weight = 150;
  }
  for (const geometry::FitMethod method : {geometry::FitMethod::feedback, geometry::FitMethod::newton}) {
    geometry::FitOptions options;
    options.method = method;
    options.steps = 100;
    const geometry::FitReport report = fit(scene, options, locked);
    EXPECT_TRUE(report.is_met) << report.error;
    for (std::size_t i = 0; i < 30; i += 5) EXPECT_EQ(report.weights[i], 150);
  }
}

TEST(DemandFit, TooMuchIsScaledAndSaysWhoLoses) {
  const Scene scene = make_scene(20, 1.25);
  geometry::FitOptions options;
  options.method = geometry::FitMethod::newton;
  options.steps = 60;
  const geometry::FitReport report = fit(scene, options);
  EXPECT_TRUE(report.is_met) << report.error;
  EXPECT_NE(report.infeasible.find("80.0 %"), std::string::npos) << report.infeasible;
  ASSERT_EQ(report.losses.size(), 20u);
  EXPECT_NEAR(report.losses[3].granted, 0.8 * report.losses[3].demand, 1e-9 * report.losses[3].demand);
  options.method = geometry::FitMethod::feedback;
  options.steps = 190;
  EXPECT_LT(fit(scene, options).error, 0.05);
}

TEST(DemandFit, CoincidentSitesLoseTheirDemandAndSayIt) {
  Scene scene = make_scene(10, 0.3);
  scene.sites[7].position = scene.sites[2].position;
  geometry::FitOptions options;
  options.steps = 100;
  const geometry::FitReport report = fit(scene, options);
  EXPECT_TRUE(report.is_met);
  ASSERT_EQ(report.losses.size(), 1u);
  EXPECT_EQ(report.losses[0].site, 7u);
  EXPECT_EQ(report.losses[0].granted, 0);
}

TEST(DemandFit, EmptiedCellsComeBack) {
  for (const geometry::FitMethod method : {geometry::FitMethod::feedback, geometry::FitMethod::newton}) {
    Scene scene = make_scene(30, 0.6);
    geometry::FitOptions options;
    options.method = method;
    options.steps = 150;
    use(scene.sites, fit(scene, options));
    // Dragged into the middle of the largest neighbour, and next to another site.
    const auto largest =
        static_cast<std::size_t>(std::max_element(scene.demands.begin(), scene.demands.end()) - scene.demands.begin());
    const std::size_t dragged = largest == 4 ? 5 : 4, close = largest == 9 ? 10 : 9;
    scene.sites[dragged].position = scene.sites[largest].position + Vector3{0.5, 0.2, 0.1};
    scene.sites[close].position = scene.sites[dragged].position + Vector3{0.1, 0.4, -0.3};
    const geometry::FitReport report = fit(scene, options);
    EXPECT_TRUE(report.is_met) << report.error << " steps " << report.steps;
  }
}

// Arrangements in which many sites lie outside their own cells, or whose cells are all thin.
TEST(DemandFit, NewtonMeetsDemandsOfHardArrangements) {
  const auto expect_fit = [](const char* name, Scene scene, auto&& place) {
    SCOPED_TRACE(name);
    for (geometry::PowerSite& site : scene.sites) site.position = place(site.position);
    geometry::FitOptions options;
    options.method = geometry::FitMethod::newton;
    options.steps = 150;
    const geometry::FitReport report = fit(scene, options);
    EXPECT_TRUE(report.is_met) << report.error;
    std::printf("newton, %s: %d steps to 1 %%\n", name, report.steps);
  };
  for (const double fill : {0.3, 0.9}) {
    const Scene scene = make_scene(100, fill);
    expect_fit("in one corner", scene, [](const Point3& p) { return 0.1 * p; });
    expect_fit("mostly outside", scene, [](const Point3& p) { return 3 * p - Vector3{100, 100, 100}; });
    expect_fit("on one line", scene, [](const Point3& p) { return Point3{50, 50, p.z}; });
    expect_fit("in one plane", scene, [](const Point3& p) { return Point3{p.x, p.y, 30}; });
  }
  Scene slab = make_scene(100, 0.9);
  slab.domain = box({0, 0, 0}, {100, 100, 1});
  for (double& demand : slab.demands) demand *= 0.01;
  expect_fit("slab", slab, [](const Point3& p) { return Point3{p.x, p.y, 0.01 * p.z}; });
}

// A site moved a little in every tick, one step a tick: the others keep their volumes on the way.
TEST(DemandFit, NewtonFollowsADrag) {
  Scene scene = make_scene(60, 0.7);
  geometry::FitOptions options;
  options.method = geometry::FitMethod::newton;
  options.steps = 30;
  use(scene.sites, fit(scene, options));
  options.steps = 2;
  geometry::FitState state;
  double worst = 0;
  for (int tick = 0; tick < 60; ++tick) {
    scene.sites[0].position = Point3{50 + 40 * std::cos(0.05 * tick), 50 + 40 * std::sin(0.05 * tick), 30.0 + tick * 0.5};
    const auto report = adapt_weights(scene.domain, scene.sites, scene.demands, {}, state, options);
    ASSERT_TRUE(report.ok());
    use(scene.sites, *report);
    state = report->state;
    if (tick > 3) worst = std::max(worst, report->error);
  }
  EXPECT_LT(worst, 0.5);
  std::printf("drag, two steps a tick: largest error %.3f\n", worst);
}

TEST(DemandFit, FewSitesAndSitesOutside) {
  const geometry::ConvexDomain domain = box({0, 0, 0}, {10, 10, 10});
  for (const geometry::FitMethod method : {geometry::FitMethod::feedback, geometry::FitMethod::newton}) {
    geometry::FitOptions options;
    options.method = method;
    options.steps = 100;
    const auto one =
        adapt_weights(domain, std::vector<geometry::PowerSite>{{{1, 1, 1}, 0}}, std::vector<double>{500}, {}, {}, options);
    ASSERT_TRUE(one.ok());
    EXPECT_TRUE(one->is_met);
    const std::vector<geometry::PowerSite> sites{{{5, 5, 5}, 0}, {{-2, 5, 5}, 0}, {{5, 13, 12}, 0}};
    const auto outside = adapt_weights(domain, sites, std::vector<double>{300, 100, 50}, {}, {}, options);
    ASSERT_TRUE(outside.ok());
    EXPECT_TRUE(outside->is_met) << outside->error;
    const auto none = adapt_weights(domain, {}, {}, {}, {}, options);
    ASSERT_TRUE(none.ok());
    EXPECT_TRUE(none->is_met);
  }
}

TEST(DemandFit, BadDemandsAreRefused) {
  const geometry::ConvexDomain domain = unit_cube();
  const std::vector<geometry::PowerSite> sites{{{0.5, 0.5, 0.5}, 0}};
  EXPECT_FALSE(adapt_weights(domain, sites, std::vector<double>{-1}, {}, {}, {}).ok());
  EXPECT_FALSE(adapt_weights(domain, sites, std::vector<double>{std::nan("")}, {}, {}, {}).ok());
  EXPECT_FALSE(adapt_weights(domain, sites, std::vector<double>{1, 2}, {}, {}, {}).ok());
  geometry::FitOptions options;
  options.damping = 0;
  EXPECT_FALSE(adapt_weights(domain, sites, std::vector<double>{0.1}, {}, {}, options).ok());
}

TEST(DemandFit, SitesWithoutDemandGetNothing) {
  Scene scene = make_scene(12, 0.4);
  scene.demands[5] = 0;
  geometry::FitOptions options;
  options.steps = 100;
  const geometry::FitReport report = fit(scene, options);
  EXPECT_TRUE(report.is_met);
  EXPECT_EQ(report.weights[5], 0);
  EXPECT_EQ(report.volumes[5], 0);
}

}  // namespace
}  // namespace bl::test
