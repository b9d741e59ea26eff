// What a start along rays may never do, whatever the sites and demands: lose a cell, a fit that is met without it, or a bit.
#include <cmath>
#include <string>

#include "tests/core/geometry/fit_scenes.h"

namespace bl::test {
namespace {

constexpr int kHardKinds = 10;
const char* const kHardNames[kHardKinds] = {
    "demands over 20", "demands over 1e6",  "one demand 100 times", "one demand 1000 times",   "one demand 10 000 times",
    "on a line",       "nearly in a plane", "in a thin tower",      "two thirds in a cluster", "in close pairs"};

// Sets that rays find hard: very unlike demands, sites that are crowded in one direction or more.
FitScene hard_scene(int kind, std::size_t count, double fill, std::uint64_t seed) {
  FitScene scene = fit_scene(count, fill, seed, kind == 0 ? 20 : kind == 1 ? 1e6 : kind < 5 ? 3 : 5);
  auto& demands = scene.problem.demands;
  const double least = 1.5 * fill / static_cast<double>(count);
  if (kind >= 2 && kind < 5) demands[5].least = std::pow(10.0, kind) * least;
  if (kind == 7) scene.domain = box({0, 0, 0}, {0.03, 0.03, 1});
  for (std::size_t i = 0; i < count; ++i) {
    Point3& p = scene.problem.sites[i].position;
    if (kind == 5) p = {0.5, 0.5, p.z};
    if (kind == 6) p.x = 0.5 + 0.02 * (p.x - 0.5);
    if (kind == 7) p = {0.03 * p.x, 0.03 * p.y, p.z};
    if (kind == 8 && i < 2 * count / 3) p = Point3{0.1, 0.1, 0.1} + 0.15 * p;
    if (kind == 9 && i % 2) p = scene.problem.sites[i - 1].position + (1e-3 / std::cbrt(static_cast<double>(count))) * Vector3{p};
  }
  double sum = 0;
  for (const geometry::VolumeDemand& demand : demands) sum += demand.least;
  for (geometry::VolumeDemand& demand : demands) demand.least = demand.most = demand.least * fill * scene.domain.volume / sum;
  return scene;
}

template <class Body>
void for_hard_scenes(const Body& body) {
  for (int kind = 0; kind < kHardKinds; ++kind) {
    for (const std::size_t count : {12, 20, 30, 100}) {
      for (const double fill : {0.1, 0.7, 0.89}) {
        for (int seed = 0; seed < rounds(4); ++seed) {
          SCOPED_TRACE(std::string(kHardNames[kind]) + ", " + std::to_string(count) + " sites, fill " + std::to_string(fill) +
                       ", seed " + std::to_string(seed));
          body(hard_scene(kind, count, fill, 100 + static_cast<std::uint64_t>(seed)));
        }
      }
    }
  }
}

// The next number above a demand as its upper bound: the same to any tolerance, but no longer one number, and so not for rays.
FitScene without_rays(FitScene scene) {
  for (geometry::VolumeDemand& demand : scene.problem.demands) demand.most = std::nextafter(demand.least, 1e300);
  return scene;
}

struct Count {
  int all = 0, with = 0, without = 0;

  void add(const FitScene& scene) {
    const geometry::VolumeFit fit = fit_of(scene), even = fit_of(without_rays(scene));
    ++all;
    with += fit.status == geometry::FitStatus::met ? 1 : 0;
    without += even.status == geometry::FitStatus::met ? 1 : 0;
    if (even.status == geometry::FitStatus::met) {
      EXPECT_EQ(fit.status, geometry::FitStatus::met) << "error " << fit.max_relative_error << " after " << fit.evaluations
                                                      << " evaluations, without rays met after " << even.evaluations;
    }
    expect_honest(scene, fit, 1e-6);
  }
};

TEST(RayLaw, RaysNeverTurnMetIntoSomethingElse) {
  Count count;
  for_hard_scenes([&](const FitScene& scene) { count.add(scene); });
  std::printf("%d hard sets: %d met with rays, %d without\n", count.all, count.with, count.without);
}

TEST(RayLaw, NorDoTheyAmongAllSortsOfSites) {
  Count count;
  for (int kind = 0; kind < kZooKinds; ++kind) {
    for (const double fill : {0.3, 0.89}) {
      for (int seed = 0; seed < rounds(4); ++seed) {
        const SiteSet set = zoo_set(kind, 30, 50 + static_cast<std::uint64_t>(seed));
        SCOPED_TRACE(set.name + ", fill " + std::to_string(fill) + ", seed " + std::to_string(seed));
        FitScene scene = fit_scene(set.sites.size(), fill, 7 + static_cast<std::uint64_t>(seed));
        scene.domain = set.domain;
        for (std::size_t i = 0; i < set.sites.size(); ++i) scene.problem.sites[i].position = set.sites[i].position;
        for (geometry::VolumeDemand& demand : scene.problem.demands) demand.most = demand.least *= set.domain.volume;
        count.add(scene);
      }
    }
  }
  std::printf("%d sets of all sorts: %d met with rays, %d without\n", count.all, count.with, count.without);
}

TEST(RayLaw, NoCellIsEmptyOnceTheStartIsMade) {
  int begun = 0, lost = 0;
  for_hard_scenes([&](const FitScene& scene) {
    geometry::FitProblem problem = scene.problem;
    const geometry::FitOptions options{.method = geometry::FitMethod::newton, .steps = 1, .tolerance = 1e-9};
    const auto least = [](const geometry::FitReport& report) {
      return *std::min_element(report.volumes.begin(), report.volumes.end());
    };
    auto report = adapt_weights(scene.domain, problem, {}, options).value();
    ++begun;
    if (least(report) > 0) return;
    ++lost;
    EXPECT_FALSE(report.began_with_rays);
    for (std::size_t i = 0; i < problem.sites.size(); ++i) problem.sites[i].weight = report.weights[i];
    report = adapt_weights(scene.domain, problem, report.state, options).value();
    EXPECT_GT(least(report), 0);
  });
  std::printf("%d starts, %d of them made anew without rays\n", begun, lost);
}

TEST(RayLaw, ThreadsLeaveNoTraceInHardSets) {
  ThreadPool two(2), three(3);
  for (int kind = 0; kind < kHardKinds; ++kind) {
    for (const double fill : {0.1, 0.7, 0.89}) {
      SCOPED_TRACE(std::string(kHardNames[kind]) + ", fill " + std::to_string(fill));
      const FitScene scene = hard_scene(kind, 300, fill, 9);
      geometry::VolumeFitOptions options;
      options.most_steps = 3;
      const geometry::VolumeFit alone = fit_of(scene, options);
      for (ThreadPool* pool : {&two, &three}) {
        options.pool = pool;
        EXPECT_EQ(fit_of(scene, options).weights, alone.weights);
      }
    }
  }
}

}  // namespace
}  // namespace bl::test
