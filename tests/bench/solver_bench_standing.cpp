// Rows of standing volumes: fits of whole storeys on a convex plot, and one volume dragged, beside as many balls in the same run.
#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include "core/base/hash.h"
#include "core/base/random.h"
#include "core/geometry/footprint_fit.h"
#include "core/geometry/volume_fit.h"
#include "core/geometry/volume_solver.h"
#include "tests/bench/solver_bench_fit.h"

namespace bl::cli::bench {

namespace {

using geometry::FloorDemand;
using geometry::FootprintFit;
using geometry::StandingSite;

constexpr double kPlotSpacing = 40, kPlotCover = 0.5, kTopSetback = 1.5, kCourtDepth = 7;  // [m]; the share of the plot
constexpr double kDragTolerance = 1e-3, kShareOfSpacing = 0.01;

struct StandingCase {
  geometry::Domain plot;
  std::vector<StandingSite> sites;
  std::vector<FloorDemand> demands;
};

// What a disc of this radius has on all storeys: the last one stands back, and what lies deeper than the depth is a courtyard.
double floor_of_disc(double radius, int storeys, double depth) {
  const auto disc = [](double r) { return r > 0 ? std::numbers::pi * r * r : 0.0; };
  const auto plate = [&](double r) { return disc(r) - disc(r - depth); };
  return (storeys - 1) * plate(radius) + plate(radius - kTopSetback);
}

// Free discs of these floors would cover half of the plot; two to seven storeys, footprints over a factor of 8.
StandingCase standing_case(int count, double depth) {
  StandingCase made;
  const double side = kPlotSpacing * std::sqrt(static_cast<double>(count));
  const std::vector<Point3> plan{{0, 0, 0}, {side, 0, 0}, {side, side, 0}, {0, side, 0}};
  made.plot = *geometry::extrude(plan, 0, 60);
  Random random(20070);
  std::vector<double> shares;
  double sum = 0;
  for (int i = 0; i < count; ++i) {
    StandingSite& site = made.sites.emplace_back();
    site.site.position.x = side * random.uniform();
    site.site.position.y = side * random.uniform();
    const int storeys = 2 + static_cast<int>(random.below(6));
    site.runs = {{storeys - 1, 0}, {1, kTopSetback}};
    site.depth = depth;
    shares.push_back(random.uniform(1, 8));
    sum += shares.back();
  }
  for (std::uint32_t i = 0; i < made.sites.size(); ++i) {
    const double radius = std::sqrt(shares[i] / sum * kPlotCover * side * side / std::numbers::pi);
    const double floor = floor_of_disc(radius, made.sites[i].storeys(), depth);
    made.demands.push_back({{i}, floor, floor});
  }
  return made;
}

struct Fitted {
  FootprintFit report;
  std::vector<StandingSite> sites;
  geometry::FootprintDiagram diagram;
};

Result<Fitted> fitted(const StandingCase& standing) {
  Fitted made{{}, standing.sites, {}};
  if (auto set = made.diagram.set_domain(standing.plot); !set) return set.error();
  auto report = fit_footprints(made.diagram, made.sites, standing.demands);
  if (!report) return report.error();
  made.report = std::move(*report);
  return made;
}

std::string hash_of_weights(const std::vector<StandingSite>& sites) {
  Hash hash;
  for (const StandingSite& site : sites) hash.add(site.site.weight);
  return hash.hex();
}

Result<void> add_cold(const SolverBench& bench, int count, double depth, BenchTable& table) {
  const StandingCase standing = standing_case(count, depth);
  const auto made = fitted(standing);
  if (!made) return made.error();
  const geometry::Domain cube = unit_cube();
  const geometry::FitProblem balls = fit_problem(count, kPlotCover);
  std::vector<Contender> contenders = {{[&] { (void)fitted(standing); }, {}, {}},
                                       {[&] { (void)fit_volumes(cube, balls); }, {}, {}}};
  const std::string name = std::isinf(depth) ? "cold" : "cold, courtyards";
  const std::string what = std::to_string(count) + " standing volumes, " + name;
  take_turns(contenders, bench.rounds, bench.turn_seconds, [&] { return bench.goes_on(what); });
  if (!bench.goes_on(what)) return Error{ErrorCode::cancelled, "", "stopped"};
  table.add({word(name), figure(static_cast<std::size_t>(count)), figure(1e3 * contenders[0].median.processor, 3),
             figure(1e3 * contenders[0].least.processor, 3), figure(1e3 * contenders[1].median.processor, 3),
             figure(static_cast<std::size_t>(made->report.steps)), figure(static_cast<std::size_t>(made->report.evaluations)),
             figure(static_cast<std::size_t>(count)), tiny(made->report.error), word(made->report.is_met ? "yes" : "no"),
             word(hash_of_weights(made->sites))});
  return {};
}

struct Dragged {
  std::vector<double> seconds;  // per frame
  double error = 0, measured = 0;
  int steps = 0, evaluations = 0;
  bool is_met = true;
  std::string hash;
};

Result<Dragged> drag_standing(const StandingCase& standing, Fitted made, int frames) {
  geometry::FootprintFitOptions options;
  options.tolerance = kDragTolerance;
  options.is_local = true;
  options.is_final = false;
  Dragged run;
  Hash hash;
  for (int frame = 0; frame < frames; ++frame) {
    // Round a circle of 16 corners, so that it stays among the same others.
    constexpr double kX[] = {1, 0.9, 0.7, 0.4, 0, -0.4, -0.7, -0.9, -1, -0.9, -0.7, -0.4, 0, 0.4, 0.7, 0.9};
    Point3& at = made.sites[made.sites.size() / 2].site.position;
    at.x += kShareOfSpacing * kPlotSpacing * kX[frame / 4 % 16];
    at.y += kShareOfSpacing * kPlotSpacing * kX[(frame / 4 + 12) % 16];
    const double before = processor_time();
    const auto report = fit_footprints(made.diagram, made.sites, standing.demands, options);
    run.seconds.push_back(processor_time() - before);
    if (!report) return report.error();
    run.steps += report->steps;
    run.evaluations += report->evaluations;
    run.measured += static_cast<double>(made.diagram.made().size()) / frames;
    run.error = std::max(run.error, report->error);
    run.is_met = run.is_met && report->is_met;
    for (const StandingSite& site : made.sites) hash.add(site.site.weight);
  }
  run.hash = hash.hex();
  return run;
}

// As many balls, of which one moves by the same share of the distance between neighbours.
Result<double> drag_balls(int count, int frames) {
  geometry::VolumeSolver solver;
  if (auto started = solver.start(unit_cube(), without_weights(random_sites(count)), random_demands(count, kPlotCover)); !started)
    return started.error();
  if (auto solved = solver.solve(); !solved) return solved.error();
  const auto dragged = static_cast<std::uint32_t>(count / 2);
  Point3 at = solver.sites()[dragged].position;
  std::vector<double> seconds;
  for (int frame = 0; frame < frames; ++frame) {
    at.x += (frame / 8 % 2 == 0 ? 1 : -1) * kShareOfSpacing * spacing_of(count);
    const double before = processor_time();
    if (auto moved = solver.move(dragged, at); !moved) return moved.error();
    if (auto solved = solver.solve(); !solved) return solved.error();
    seconds.push_back(processor_time() - before);
  }
  return median(seconds);
}

Result<void> add_drag(const SolverBench& bench, int count, BenchTable& table) {
  if (!bench.goes_on("drag among " + std::to_string(count) + " standing volumes"))
    return Error{ErrorCode::cancelled, "", "stopped"};
  const StandingCase standing = standing_case(count, StandingSite::kAnyDepth);
  const int frames = bench.options.is_quick ? 16 : 128;
  std::vector<std::vector<double>> seconds(static_cast<std::size_t>(frames));
  std::vector<double> balls;
  Dragged last;
  for (int round = 0; round < std::min(3, bench.rounds); ++round) {
    auto start = fitted(standing);
    if (!start) return start.error();
    auto run = drag_standing(standing, std::move(*start), frames);
    if (!run) return run.error();
    if (round > 0 && run->hash != last.hash) return Error{ErrorCode::internal, "standing", "the same drag had other results"};
    for (std::size_t f = 0; f < seconds.size(); ++f) seconds[f].push_back(run->seconds[f]);
    last = std::move(*run);
    const auto other = drag_balls(count, frames);
    if (!other) return other.error();
    balls.push_back(*other);
  }
  // Each frame counts with its median, so that it is not slow by what else the machine was doing.
  std::vector<double> each;
  for (const std::vector<double>& one : seconds) each.push_back(median(one));
  const auto mean = [&](int sum) { return figure(static_cast<double>(sum) / frames, 2); };
  table.add({word("one dragged"), figure(static_cast<std::size_t>(count)), figure(1e3 * median(each), 3),
             figure(1e3 * *std::min_element(each.begin(), each.end()), 3), figure(1e3 * median(balls), 3), mean(last.steps),
             mean(last.evaluations), figure(last.measured, 0), tiny(last.error), word(last.is_met ? "yes" : "no"),
             word(last.hash)});
  return {};
}

}  // namespace

BenchTables bench_standing(const SolverBench& bench) {
  BenchTable table("standing",
                   "Standing volumes: round, two to seven storeys, the last one 1.5 m back, half of a square plot covered; cold "
                   "to 1e-6, courtyards "
                   "beyond 7 m, and one dragged by 1 % of the spacing a frame to 0.1 %; one thread, beside as many balls",
                   {{"work", "case", true},
                    {"sites", "sites"},
                    {"ms", "milliseconds"},
                    {"least ms", "least_milliseconds"},
                    {"balls ms", "balls_milliseconds"},
                    {"steps", "newton_steps"},
                    {"evaluations", "evaluations"},
                    {"measured", "footprints_per_evaluation"},
                    {"error", "largest_relative_error"},
                    {"met", "is_met", true},
                    {"hash", "hash", true}});
  for (const int count : bench.sites({1000}, {100})) {
    for (const double depth : {StandingSite::kAnyDepth, kCourtDepth})
      if (auto done = add_cold(bench, count, depth, table); !done) return done.error();
    if (auto done = add_drag(bench, count, table); !done) return done.error();
  }
  return std::vector<BenchTable>{table};
}

}  // namespace bl::cli::bench
