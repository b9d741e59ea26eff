// The warm solver: whatever is dragged, added, removed or asked for, the true volumes are the demands.
#include "core/geometry/volume_solver.h"

#include <cmath>
#include <limits>
#include <numbers>

#include "tests/core/geometry/fit_scenes.h"

namespace bl::test {
namespace {

constexpr double kTolerance = 1e-3;

std::vector<double> demands_of(const FitScene& scene) {
  std::vector<double> demands;
  for (const geometry::VolumeDemand& demand : scene.problem.demands) demands.push_back(demand.least);
  return demands;
}

geometry::VolumeSolver started(const FitScene& scene) {
  geometry::VolumeSolver solver;
  EXPECT_TRUE(solver.start(scene.domain, scene.problem.sites, demands_of(scene)).ok());
  return solver;
}

geometry::SolveReport solve(geometry::VolumeSolver& solver, ThreadPool* pool = nullptr) {
  geometry::SolveOptions options;
  options.tolerance = kTolerance;
  options.pool = pool;
  auto report = solver.solve(options);
  EXPECT_TRUE(report.ok()) << (report.ok() ? "" : report.error().text());
  return report.ok() ? *report : geometry::SolveReport{};
}

// Largest relative error, from a diagram made anew from the weights; places without a demand are left out.
double true_error(const geometry::Domain& domain, const geometry::VolumeSolver& solver) {
  std::vector<geometry::PowerSite> sites;
  std::vector<double> demands;
  for (std::size_t i = 0; i < solver.sites().size(); ++i) {
    if (!(solver.demands()[i] > 0)) continue;
    EXPECT_TRUE(std::isfinite(solver.sites()[i].weight)) << i;
    sites.push_back(solver.sites()[i]);
    demands.push_back(solver.demands()[i]);
  }
  geometry::CellOptions options;
  options.with_shape = options.with_centroid = false;
  const auto cells = power_cells(domain, sites, options).value();
  double worst = 0;
  for (std::size_t k = 0; k < cells.size(); ++k) worst = std::max(worst, std::abs(cells[k].volume - demands[k]) / demands[k]);
  return worst;
}

void expect_met(const geometry::Domain& domain, geometry::VolumeSolver& solver, const std::string& when,
                ThreadPool* pool = nullptr) {
  const geometry::SolveReport report = solve(solver, pool);
  const double truth = true_error(domain, solver);
  EXPECT_EQ(report.status, geometry::FitStatus::met)
      << when << ": " << truth << (report.reasons.empty() ? "" : report.reasons[0]);
  EXPECT_LE(truth, kTolerance) << when << (report.was_local ? ", locally" : ", all anew") << ", reported " << report.error;
}

TEST(VolumeSolver, ADraggedSiteKeepsAllVolumesTrue) {
  const std::size_t count = static_cast<std::size_t>(rounds(560)) + 40;
  for (const double fill : {0.3, 0.7, 0.95, 1.0}) {
    const FitScene scene = fit_scene(count, fill, 51);
    geometry::VolumeSolver solver = started(scene);
    int local = 0;
    for (int frame = 0; frame < rounds(60) && !HasFailure(); ++frame) {
      const double t = 2 * std::numbers::pi * frame / 60;
      ASSERT_TRUE(solver.move(3, {0.5 + 0.16 * std::cos(t), 0.5 + 0.16 * std::sin(t), 0.4 + 0.1 * std::sin(3 * t)}).ok());
      const geometry::SolveReport report = solve(solver);
      local += report.was_local;
      EXPECT_EQ(report.status, geometry::FitStatus::met);
      EXPECT_LE(true_error(scene.domain, solver), kTolerance)
          << "fill " << fill << " frame " << frame << " local " << report.was_local;
    }
    std::printf("drag at %.0f %%: %d frames answered locally\n", 100 * fill, local);
  }
}

// Moves near and far, adds, removes and other demands, in any order; the sum of the demands stays as it was, roughly.
void walk(const FitScene& scene, std::uint64_t seed, int operations, bool check, ThreadPool* pool, std::vector<double>* weights) {
  geometry::VolumeSolver solver = started(scene);
  Random random(seed);
  double room = 0;
  const double filled = [&] {
    double sum = 0;
    for (const double demand : demands_of(scene)) sum += demand;
    return sum;
  }();
  std::vector<std::uint32_t> alive;
  for (std::uint32_t i = 0; i < scene.problem.sites.size(); ++i) alive.push_back(i);
  const double mean = filled / static_cast<double>(alive.size());
  for (int k = 0; k < operations && !testing::Test::HasFailure(); ++k) {
    const std::size_t at = random.below(alive.size());
    const std::uint32_t site = alive[at];
    const auto& sites = solver.sites();
    std::string what;
    switch (random.below(6)) {
      case 0: {
        what = "a step of " + std::to_string(site);
        ASSERT_TRUE(solver.move(site, sites[site].position + 0.02 * random_point(random, {-1, -1, -1}, {1, 1, 1})).ok());
        break;
      }
      case 1: {
        what = "a leap of " + std::to_string(site);
        ASSERT_TRUE(solver.move(site, random_point(random, {0, 0, 0}, {1, 1, 1})).ok());
        break;
      }
      case 2: {
        const std::uint32_t other = alive[random.below(alive.size())];
        what = std::to_string(site) + " beside " + std::to_string(other);
        ASSERT_TRUE(
            solver.move(site, sites[other].position + random_point(random, {-0.003, -0.003, 0.001}, {0.003, 0.003, 0.002})).ok());
        break;
      }
      case 3: {
        what = "add";
        const double demand = std::min(mean, room);
        if (!(demand > 0.01 * mean)) break;
        const auto place = solver.add(random_point(random, {0, 0, 0}, {1, 1, 1}), demand);
        ASSERT_TRUE(place.ok());
        room -= demand;
        alive.push_back(*place);
        break;
      }
      case 4: {
        what = "remove " + std::to_string(site);
        if (alive.size() < 10) break;
        room += solver.demands()[site];
        ASSERT_TRUE(solver.remove(site).ok());
        alive.erase(alive.begin() + static_cast<std::ptrdiff_t>(at));
        break;
      }
      default: {
        const double before = solver.demands()[site], after = std::min(before + room, before * random.uniform(0.5, 1.8));
        what = "demand of " + std::to_string(site) + " from " + std::to_string(before) + " to " + std::to_string(after);
        ASSERT_TRUE(solver.set_demand(site, after).ok());
        room += before - after;
        break;
      }
    }
    if (k % 3 == 1) continue;  // two at once
    if (check) {
      expect_met(scene.domain, solver, std::to_string(k) + ": " + what, pool);
    } else {
      solve(solver, pool);
    }
  }
  if (weights == nullptr) return;
  for (const geometry::PowerSite& site : solver.sites()) weights->push_back(site.weight);
}

TEST(VolumeSolver, RandomWalksStayTrue) {
  for (const double fill : {0.3, 0.7, 0.95, 1.0}) {
    for (const int count : {20, 200, 600}) {
      if (HasFailure()) return;
      SCOPED_TRACE("fill " + std::to_string(fill) + ", " + std::to_string(count) + " sites");
      const FitScene scene = fit_scene(static_cast<std::size_t>(count > 20 ? 20 + rounds(count - 20) : count), fill, 52);
      walk(scene, 90 + static_cast<std::uint64_t>(count), rounds(count > 200 ? 70 : 150) + 10, true, nullptr, nullptr);
    }
  }
}

TEST(VolumeSolver, TheSameCallsGiveTheSameBitsOnAnyThreads) {
  ThreadPool two(2);
  for (const double fill : {0.7, 1.0}) {
    const FitScene scene = fit_scene(static_cast<std::size_t>(rounds(120)) + 40, fill, 53);
    std::vector<double> first, second, together;
    walk(scene, 7, rounds(40) + 5, false, nullptr, &first);
    walk(scene, 7, rounds(40) + 5, false, nullptr, &second);
    walk(scene, 7, rounds(40) + 5, false, &two, &together);
    EXPECT_EQ(first, second);
    EXPECT_EQ(first, together);
  }
}

TEST(VolumeSolver, ALeapOntoLightNeighboursIsNoticed) {
  // A heavy site lands where it swallows small ones that it never bordered.
  FitScene scene = fit_scene(300, 0.3, 54);
  scene.problem.demands[0].least = scene.problem.demands[0].most = 0.05;
  geometry::VolumeSolver solver = started(scene);
  expect_met(scene.domain, solver, "start");
  Random random(3);
  for (int k = 0; k < rounds(30); ++k) {
    ASSERT_TRUE(solver.move(0, random_point(random, {0.1, 0.1, 0.1}, {0.9, 0.9, 0.9})).ok());
    expect_met(scene.domain, solver, "leap " + std::to_string(k));
  }
}

TEST(VolumeSolver, StrangePlacesAreAnsweredOrRefused) {
  const FitScene scene = fit_scene(60, 0.6, 55);
  geometry::VolumeSolver solver = started(scene);
  expect_met(scene.domain, solver, "start");
  const Point3 home = solver.sites()[5].position;
  // Onto another one: they are one place, and only one of them can live.
  ASSERT_TRUE(solver.move(5, solver.sites()[9].position).ok());
  geometry::SolveReport report = solve(solver);
  EXPECT_EQ(report.status, geometry::FitStatus::infeasible);
  ASSERT_FALSE(report.reasons.empty());
  EXPECT_NE(report.reasons[0].find("site "), std::string::npos);
  ASSERT_TRUE(solver.move(5, home).ok());
  expect_met(scene.domain, solver, "back from the same place");
  for (const Point3& place : {Point3{1.05, 0.5, 0.5}, Point3{-0.3, -0.3, 0.2}, Point3{3, 0.5, 0.5}}) {
    ASSERT_TRUE(solver.move(5, place).ok());
    expect_met(scene.domain, solver, "outside");
  }
  ASSERT_TRUE(solver.move(5, {1e6, 0, 0}).ok());
  report = solve(solver);
  if (report.status != geometry::FitStatus::met) { EXPECT_FALSE(report.reasons.empty()); }
  ASSERT_TRUE(solver.move(5, home).ok());
  expect_met(scene.domain, solver, "back from far away");
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(solver.move(5, {nan, 0, 0}).ok());
  EXPECT_FALSE(solver.move(60, home).ok());
  EXPECT_FALSE(solver.set_demand(5, -1).ok());
  EXPECT_FALSE(solver.set_demand(5, nan).ok());
  EXPECT_FALSE(solver.add({0, nan, 0}, 1).ok());
  EXPECT_FALSE(solver.remove(99).ok());
  expect_met(scene.domain, solver, "after refusals");
}

TEST(VolumeSolver, DemandsToNothingAndBackAndAboveWhatThereIs) {
  const FitScene scene = fit_scene(50, 0.8, 56);
  geometry::VolumeSolver solver = started(scene);
  expect_met(scene.domain, solver, "start");
  const double before = solver.demands()[7];
  ASSERT_TRUE(solver.set_demand(7, 0).ok());
  expect_met(scene.domain, solver, "to nothing");
  EXPECT_EQ(solver.volumes()[7], 0);
  ASSERT_TRUE(solver.move(7, {0.5, 0.5, 0.5}).ok());
  expect_met(scene.domain, solver, "moved without a demand");
  ASSERT_TRUE(solver.set_demand(7, before).ok());
  expect_met(scene.domain, solver, "and back");
  ASSERT_TRUE(solver.set_demand(7, 0.9).ok());
  const geometry::SolveReport report = solve(solver);
  EXPECT_EQ(report.status, geometry::FitStatus::infeasible);
  EXPECT_FALSE(report.reasons.empty());
  double sum = 0;
  for (const double volume : solver.volumes()) sum += volume;
  EXPECT_NEAR(sum, 1, 1e-9);
  ASSERT_TRUE(solver.move(7, {0.4, 0.4, 0.4}).ok());
  EXPECT_EQ(solve(solver).status, geometry::FitStatus::infeasible);
  ASSERT_TRUE(solver.set_demand(7, before).ok());
  expect_met(scene.domain, solver, "met again");
}

TEST(VolumeSolver, FromEmptyToEmpty) {
  geometry::VolumeSolver unstarted;
  EXPECT_FALSE(unstarted.solve().ok());
  geometry::VolumeSolver solver;
  ASSERT_TRUE(solver.start(unit_cube(), {}, {}).ok());
  EXPECT_EQ(solve(solver).status, geometry::FitStatus::met);
  Random random(4);
  std::vector<std::uint32_t> places;
  for (int k = 0; k < 100; ++k) {
    const auto place = solver.add(random_point(random, {0, 0, 0}, {1, 1, 1}), 0.008);
    ASSERT_TRUE(place.ok());
    places.push_back(*place);
    expect_met(unit_cube(), solver, "add " + std::to_string(k));
  }
  for (const std::uint32_t place : places) {
    ASSERT_TRUE(solver.remove(place).ok());
    expect_met(unit_cube(), solver, "remove " + std::to_string(place));
    EXPECT_EQ(solver.sites()[place].weight, 0);
    EXPECT_EQ(solver.volumes()[place], 0);
  }
  EXPECT_FALSE(solver.remove(places[0]).ok());
  EXPECT_EQ(*solver.add({0.5, 0.5, 0.5}, 0.3), 0u);
  expect_met(unit_cube(), solver, "one again");
}

// Changes that cancel each other, or follow each other, before anybody asks for a solution.
TEST(VolumeSolver, ManyChangesBetweenTwoSolves) {
  const FitScene scene = fit_scene(40, 0.5, 57);
  geometry::VolumeSolver solver = started(scene);
  // Before the first solve.
  ASSERT_TRUE(solver.remove(3).ok());
  ASSERT_TRUE(solver.add({0.2, 0.2, 0.2}, 0.01).ok());
  expect_met(scene.domain, solver, "changed before the first");
  const auto a = solver.add({0.3, 0.3, 0.3}, 0.01), b = solver.add({0.7, 0.3, 0.3}, 0.01);
  ASSERT_TRUE(a.ok() && b.ok());
  ASSERT_TRUE(solver.remove(*a).ok());
  expect_met(scene.domain, solver, "one of two new ones removed again");
  ASSERT_TRUE(solver.move(*b, {0.8, 0.3, 0.3}).ok());
  expect_met(scene.domain, solver, "the other moved");
  const auto c = solver.add({0.1, 0.8, 0.3}, 0.01);
  ASSERT_TRUE(c.ok());
  const auto d = solver.add({0.15, 0.8, 0.35}, 0.01);
  ASSERT_TRUE(d.ok());
  ASSERT_TRUE(solver.remove(*d).ok());
  ASSERT_TRUE(solver.remove(*c).ok());
  expect_met(scene.domain, solver, "both new ones removed");
  ASSERT_TRUE(solver.remove(8).ok());
  const auto e = solver.add({0.9, 0.9, 0.9}, 0.02);
  ASSERT_TRUE(e.ok());
  ASSERT_TRUE(solver.move(*e, {0.85, 0.85, 0.9}).ok());
  expect_met(scene.domain, solver, "removed and replaced");
  for (std::uint32_t i = 10; i < 30; ++i)
    ASSERT_TRUE(solver.move(i, solver.sites()[40 - i].position + Vector3{0.01, 0, 0.01}).ok());
  expect_met(scene.domain, solver, "half of them moved");
}

}  // namespace
}  // namespace bl::test
