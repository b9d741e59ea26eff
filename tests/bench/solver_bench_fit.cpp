// Rows of cold fits: weights from nothing to a millionth, against the plain triangulation of the same sites.
#include <algorithm>

#include "core/base/text.h"
#include "core/geometry/volume_fit.h"
#include "core/geometry/yardstick.h"
#include "tests/bench/solver_bench_fit.h"

namespace bl::cli::bench {

geometry::FitProblem fit_problem(int count, double fill, std::uint64_t seed) {
  geometry::FitProblem problem;
  problem.sites = without_weights(random_sites(count, seed));
  const std::vector<double> demands = random_demands(count, fill, seed);
  for (std::uint32_t i = 0; i < demands.size(); ++i) {
    geometry::VolumeDemand& wanted = problem.demands.emplace_back();
    wanted.sites = {i};
    wanted.least = wanted.most = demands[i];
  }
  return problem;
}

namespace {

geometry::VolumeFitOptions fit_options() {
  geometry::VolumeFitOptions options;
  options.tolerance = 1e-6;
  return options;
}

Result<void> add_row(const SolverBench& bench, int count, double fill, BenchTable& table) {
  const geometry::Domain domain = unit_cube();
  const geometry::FitProblem problem = fit_problem(count, fill);
  const auto fit = fit_volumes(domain, problem, fit_options());
  if (!fit) return fit.error();
  std::vector<Contender> contenders = {{[&] { (void)fit_volumes(domain, problem, fit_options()); }, {}, {}},
                                       {[&] { (void)plain_triangulation(problem.sites); }, {}, {}}};
  const std::string what = "fit of " + std::to_string(count) + " sites, " + fixed(100 * fill, 0) + " %";
  take_turns(contenders, bench.rounds, bench.turn_seconds, [&] { return bench.goes_on(what); });
  if (!bench.goes_on(what)) return Error{ErrorCode::cancelled, "", "stopped"};
  const double seconds = contenders[0].median.processor, cgal = contenders[1].median.processor;
  table.add({figure(static_cast<std::size_t>(count)), figure(100 * fill, 0), figure(1e3 * seconds, 2),
             figure(1e3 * contenders[0].least.processor, 2), figure(1e6 * seconds / count, 1), figure(seconds / cgal, 2),
             figure(1e3 * cgal, 2), figure(static_cast<std::size_t>(fit->iterations)),
             figure(static_cast<std::size_t>(fit->evaluations)), tiny(fit->max_relative_error),
             word(std::string(name_of(fit->status))), word(hash_of(fit->volumes))});
  return {};
}

// The worst of many random sets.
Result<void> add_seeds(const SolverBench& bench, int count, double fill, BenchTable& table) {
  const geometry::Domain domain = unit_cube();
  int most_steps = 0, most_evaluations = 0;
  std::size_t failures = 0;
  std::vector<double> steps, volumes;
  double error = 0;
  std::string worst;
  for (int seed = 1; seed <= bench.options.seeds; ++seed) {
    if (!bench.goes_on(std::to_string(count) + " sites, seed " + std::to_string(seed))) {
      return Error{ErrorCode::cancelled, "", "stopped"};
    }
    const auto fit = fit_volumes(domain, fit_problem(count, fill, static_cast<std::uint64_t>(seed)), fit_options());
    if (!fit) return fit.error();
    failures += fit->status != geometry::FitStatus::met;
    if (fit->iterations > most_steps) worst = std::to_string(seed);
    most_steps = std::max(most_steps, fit->iterations);
    most_evaluations = std::max(most_evaluations, fit->evaluations);
    error = std::max(error, fit->max_relative_error);
    steps.push_back(fit->iterations);
    volumes.insert(volumes.end(), fit->volumes.begin(), fit->volumes.end());
  }
  table.add({figure(static_cast<std::size_t>(count)), figure(100 * fill, 0), figure(steps.size()), figure(median(steps), 1),
             figure(static_cast<std::size_t>(most_steps)), word(worst), figure(static_cast<std::size_t>(most_evaluations)),
             tiny(error), figure(failures), word(hash_of(volumes))});
  return {};
}

BenchTable seeds_table() {
  return {"seeds",
          "Cold fits of many random sets",
          {{"sites", "sites"},
           {"fill %", "fill_percent"},
           {"sets", "sets"},
           {"median steps", "median_newton_steps"},
           {"most steps", "most_newton_steps"},
           {"in set", "set_of_most_steps"},
           {"most evaluations", "most_evaluations"},
           {"error", "largest_relative_error"},
           {"not met", "failures"},
           {"hash", "hash", true}}};
}

}  // namespace

BenchTables bench_cold_fit(const SolverBench& bench) {
  BenchTable table("fit", "Cold fit to 1e-6, demands log-uniform over a factor of 20, one thread",
                   {{"sites", "sites"},
                    {"fill %", "fill_percent"},
                    {"ms", "milliseconds"},
                    {"least ms", "least_milliseconds"},
                    {"µs/site", "microseconds_per_site"},
                    {"/CGAL", "ratio_to_cgal"},
                    {"CGAL ms", "cgal_milliseconds"},
                    {"steps", "newton_steps"},
                    {"evaluations", "evaluations"},
                    {"error", "largest_relative_error"},
                    {"status", "status", true},
                    {"hash", "hash", true}});
  for (const int count : bench.sites({500, 5000}, {100})) {
    for (const double fill : kFills) {
      if (auto done = add_row(bench, count, fill, table); !done) return done.error();
    }
  }
  std::vector<BenchTable> tables = {table};
  if (bench.options.seeds == 0) return tables;
  tables.push_back(seeds_table());
  for (const int count : bench.sites({500}, {100})) {
    for (const double fill : kFills) {
      if (auto done = add_seeds(bench, count, fill, tables.back()); !done) return done.error();
    }
  }
  return tables;
}

}  // namespace bl::cli::bench
