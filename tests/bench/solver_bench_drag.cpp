// Rows of drags: one site moves through the others by a hundredth of the domain a frame, and every volume keeps its demand.
#include <algorithm>
#include <cmath>
#include <memory>

#include "core/base/hash.h"
#include "core/geometry/volume_solver.h"
#include "core/geometry/yardstick.h"
#include "tests/bench/solver_bench_rows.h"

namespace bl::cli::bench {

namespace {

constexpr double kTolerance = 1e-3, kStep = 0.01;
constexpr double kDragFills[] = {0.3, 0.7, 0.95, 1.0};
const Point3 kBegin = {0.2, 0.3, 0.25};
const Vector3 kWay = {0.6, 0.48, 0.64};  // a unit vector: sixty frames end well inside the cube

struct DragCase {
  geometry::Domain domain;
  std::vector<geometry::PowerSite> sites;
  std::vector<double> demands;
  std::uint32_t dragged = 0;
  int frames = 60, check_every = 1;
};

// What one drag from beginning to end was like.
struct DragRun {
  std::vector<double> seconds;  // per frame
  double start_seconds = 0, error = 0, cells = 0;
  std::size_t refits = 0;
  std::string hash;
  std::vector<geometry::PowerSite> fitted;  // before the first frame
};

DragCase drag_case(const SolverBench& bench, int count, double fill) {
  DragCase drag;
  drag.domain = unit_cube();
  drag.sites = without_weights(random_sites(count));
  drag.demands = random_demands(count, fill);
  // The nearest to the beginning of those that are no smaller than the mean: a small one would disturb few others.
  double nearest = 1e300;
  for (std::uint32_t i = 0; i < drag.sites.size(); ++i) {
    const double away = squared_norm(drag.sites[i].position - kBegin);
    if (drag.demands[i] * count < fill || !(away < nearest)) continue;
    nearest = away;
    drag.dragged = i;
  }
  if (bench.options.is_quick) drag.frames = 6;
  if (count > 5000) drag.check_every = 6;
  return drag;
}

// The largest error of the cells as they really are, all of them made anew.
double true_error(const DragCase& drag, const geometry::VolumeSolver& solver) {
  const auto cells = power_cells(drag.domain, solver.sites(), plain_cells());
  if (!cells) return 1;
  double error = 0;
  for (std::size_t i = 0; i < cells->size(); ++i) {
    error = std::max(error, std::abs((*cells)[i].volume - drag.demands[i]) / drag.demands[i]);
  }
  return error;
}

// `sites`: without weights, or with those that another run has found: then the start takes next to no time.
Result<DragRun> drag_once(const SolverBench& bench, const DragCase& drag, std::span<const geometry::PowerSite> sites, int threads,
                          bool is_checked) {
  ThreadPool pool(threads);
  geometry::SolveOptions options;
  options.tolerance = kTolerance;
  options.pool = &pool;
  DragRun run;
  geometry::VolumeSolver solver;
  const Clocks began = clocks_now();
  if (auto started = solver.start(drag.domain, sites, drag.demands); !started) return started.error();
  if (auto solved = solver.solve(options); !solved) return solved.error();
  const Clocks ready = clocks_now();
  run.start_seconds = Clocks{ready.wall - began.wall, ready.processor - began.processor}.of(threads);
  run.fitted.assign(solver.sites().begin(), solver.sites().end());
  Hash hash;
  Point3 position = drag.sites[drag.dragged].position;
  for (int frame = 1; frame <= drag.frames; ++frame) {
    if (!bench.goes_on("drag in " + std::to_string(drag.sites.size()) + " sites, frame " + std::to_string(frame))) {
      return Error{ErrorCode::cancelled, "", "stopped"};
    }
    position = position + kWay * kStep;
    const Clocks before = clocks_now();
    if (auto moved = solver.move(drag.dragged, position); !moved) return moved.error();
    const auto report = solver.solve(options);
    const Clocks after = clocks_now();
    if (!report) return report.error();
    run.seconds.push_back(Clocks{after.wall - before.wall, after.processor - before.processor}.of(threads));
    run.cells += static_cast<double>(report->cells_made) / drag.frames;
    run.refits += report->was_local ? 0 : 1;
    for (const double volume : solver.volumes()) hash.add(volume);
    if (is_checked && frame % drag.check_every == 0) run.error = std::max(run.error, true_error(drag, solver));
  }
  run.hash = hash.hex();
  return run;
}

// The same drag several times: each frame counts with its median, so that a frame is worst by itself and not by what else the
// machine was doing.
void add_row(const DragCase& drag, double fill, int threads, const std::vector<DragRun>& runs, double error, double cgal,
             BenchTable& table) {
  std::vector<double> frames;
  for (std::size_t f = 0; f < runs.front().seconds.size(); ++f) {
    std::vector<double> seconds;
    for (const DragRun& run : runs) seconds.push_back(run.seconds[f]);
    frames.push_back(median(seconds));
  }
  const double middle = median(frames);
  table.add({figure(drag.sites.size()), figure(100 * fill, 0), figure(static_cast<std::size_t>(threads)), figure(1e3 * middle, 3),
             figure(1e3 * *std::max_element(frames.begin(), frames.end()), 3), figure(middle / cgal, 3), figure(1e3 * cgal, 2),
             figure(1e3 * runs.front().start_seconds, 1), figure(100 * error, 4), figure(runs.front().cells, 0),
             figure(runs.front().refits), word(runs.front().hash)});
}

Result<void> add_rows(const SolverBench& bench, int count, double fill, BenchTable& table) {
  const DragCase drag = drag_case(bench, count, fill);
  const std::vector<int> threads = bench.threads();
  std::vector<std::vector<DragRun>> runs(threads.size());
  std::vector<Clocks> yardsticks;
  double error = 0;
  for (int round = 0; round < std::min(3, bench.rounds); ++round) {
    for (std::size_t t = 0; t < threads.size(); ++t) {
      const auto& sites = round == 0 ? drag.sites : runs[t].front().fitted;
      auto run = drag_once(bench, drag, sites, threads[t], round == 0 && t == 0);
      if (!run) return run.error();
      if (round > 0 && run->hash != runs[t].front().hash)
        return Error{ErrorCode::internal, "drag", "the same drag had other results"};
      error = std::max(error, run->error);
      runs[t].push_back(std::move(*run));
    }
    const Clocks before = clocks_now();
    (void)plain_triangulation(drag.sites);
    const Clocks after = clocks_now();
    yardsticks.push_back({after.wall - before.wall, after.processor - before.processor});
  }
  for (std::size_t t = 0; t < threads.size(); ++t) {
    std::vector<double> seconds;
    for (const Clocks& one : yardsticks) seconds.push_back(one.of(threads[t]));
    add_row(drag, fill, threads[t], runs[t], error, median(seconds), table);
  }
  return {};
}

}  // namespace

BenchTables bench_drag(const SolverBench& bench) {
  BenchTable table(
      "drag",
      "Drag: one site moves by 1 % of the domain a frame, 60 frames (quick: 6); all volumes within 0.1 %; error: true, of the "
      "frames that were checked",
      {{"sites", "sites"},
       {"fill %", "fill_percent"},
       {"threads", "threads"},
       {"median ms", "median_milliseconds"},
       {"worst ms", "worst_milliseconds"},
       {"median/CGAL", "ratio_to_cgal"},
       {"CGAL ms", "cgal_milliseconds"},
       {"start ms", "start_milliseconds"},
       {"error %", "largest_error_percent"},
       {"cells/frame", "cells_per_frame"},
       {"full fits", "full_fits"},
       {"hash", "hash", true}});
  for (const int count : bench.sites({1000, 5000, 10000, 20000}, {200})) {
    for (const double fill : kDragFills) {
      if (auto done = add_rows(bench, count, fill, table); !done) return done.error();
    }
  }
  return std::vector<BenchTable>{table};
}

}  // namespace bl::cli::bench
