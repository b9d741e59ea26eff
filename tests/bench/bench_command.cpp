// `bench`: how long a tick takes, where the time goes, and how that compares with the plain triangulation of the same sites.
#include <algorithm>
#include <array>
#include <memory>
#include <numeric>
#include <optional>

#include <nlohmann/json.hpp>

#include "core/base/text.h"
#include "core/file/file_io.h"
#include "core/geometry/power_neighbours.h"
#include "core/geometry/yardstick.h"
#include "core/reading/views/volume.h"
#include "core/session/session.h"
#include "tests/bench/bench_command.h"
#include "tests/bench/bench_tools.h"
#include "tests/bench/bench_voropp.h"
#include "tests/bench/random_scene.h"
#include "tests/bench/solver_bench.h"
#include "tests/bench/times_bench.h"
#include "ui/cli/commands.h"
#include "ui/cli/interrupt.h"
#include "ui/cli/scene_loading.h"
#include "ui/cli/terminal.h"

namespace bl::cli::bench {

namespace {

struct Row {
  std::string name, hash;
  std::size_t sites = 0;
  int threads = 1;
  double seconds = 0;                                // of one tick
  PhaseTimes phases;                                 // of one tick
  double triangulation = 0, cells = 0, volumes = 0;  // seconds of the solver's tick, dealt out (README.md)
  std::optional<double> yardstick, voropp;
};

// One evaluation of the diagram taken apart: triangulation, cells on top of it, and the rest (floor areas, what meshes are made
// from) on top of that. The solver's own time is dealt out in these shares; it makes several evaluations in a tick, of which one
// has the rest.
void take_apart(const State& state, int repeat, Row& row) {
  const std::vector<geometry::PowerSite> sites = sites_of(state);
  const auto domain = domain_of(state);
  if (sites.empty()) return;
  row.yardstick = median_seconds(repeat, [&] { (void)plain_triangulation(sites); });
#ifdef BL_VOROPP
  if (domain) row.voropp = median_seconds(repeat, [&] { (void)voropp_total_volume(domain->minimum, domain->maximum, sites); });
#endif
  if (!domain) return;
  std::vector<std::uint32_t> all(sites.size());
  std::iota(all.begin(), all.end(), 0u);
  geometry::PowerNeighbours neighbours;
  const double triangulation = median_seconds(repeat, [&] { (void)find_power_neighbours(sites, all, neighbours); });
  ThreadPool pool(row.threads);
  geometry::CellOptions options;
  options.pool = &pool;
  options.with_shape = false;
  const double plain = std::max(triangulation, median_seconds(repeat, [&] { (void)power_cells(*domain, sites, options); }));
  options.with_shape = true;
  options.tessellation_depth = 1;
  const double full = std::max(plain, median_seconds(repeat, [&] { (void)power_cells(*domain, sites, options); }));
  // With k plain evaluations and a full one: k = (solve - full) / plain, which is at least 0.
  const double evaluations = std::max(0.0, (row.phases.solve - full) / plain) + 1;
  row.triangulation = std::min(row.phases.solve, evaluations * triangulation);
  row.volumes = std::min(row.phases.solve - row.triangulation, full - plain);
  row.cells = row.phases.solve - row.triangulation - row.volumes;
}

constexpr std::size_t kPhases = 4;

std::array<double, kPhases> phases_of(const PhaseTimes& times) { return {times.links, times.nodes, times.solve, times.commit}; }

Result<Row> measured(const BenchCase& bench, int threads, const BenchOptions& options, Progress& progress) {
  Row row;
  row.name = bench.name;
  row.threads = threads;
  std::vector<double> totals;
  std::array<std::vector<double>, kPhases> phases;
  std::shared_ptr<const State> last;
  for (int r = 0; r < options.repeat && !is_interrupted(); ++r) {
    auto session = Session::start(full_registry(), bench.scene, bench.state ? &*bench.state : nullptr, threads, now);
    if (!session) return session.error();
    (*session)->tick();  // the first one compiles, and finds all volumes without a weight
    // The phases are added up from the start of the session; what the measured ticks took is the difference.
    const std::array<double, kPhases> before = phases_of((*session)->times());
    const double began = now();
    for (int t = 0; t < options.ticks && !is_interrupted(); ++t) {
      (*session)->tick();
      progress.show(bench.name + ", " + counted(static_cast<std::size_t>(threads), "thread") + ", run " + std::to_string(r + 1) +
                    ", tick " + std::to_string(t + 1));
    }
    totals.push_back((now() - began) / options.ticks);
    const std::array<double, kPhases> after = phases_of((*session)->times());
    for (std::size_t p = 0; p < kPhases; ++p) phases[p].push_back((after[p] - before[p]) / options.ticks);
    last = (*session)->state();
  }
  if (is_interrupted() || last == nullptr) return Error{ErrorCode::cancelled, bench.name, "stopped"};
  row.seconds = median(totals);
  row.phases = {median(phases[0]), median(phases[1]), median(phases[2]), median(phases[3])};
  row.hash = hex_digits(last->hash);
  row.sites = reading::rows<reading::VolumeFigures>(*last).size();
  take_apart(*last, options.repeat, row);
  return row;
}

double microseconds_per_cell(const Row& row) { return row.sites == 0 ? 0 : row.seconds * 1e6 / static_cast<double>(row.sites); }

std::vector<std::string> cells_of(const Row& row) {
  const auto share = [&](double seconds) { return row.seconds > 0 ? fixed(100 * seconds / row.seconds, 0) : "0"; };
  const auto milliseconds = [](const std::optional<double>& seconds) {
    return seconds ? fixed(1000 * *seconds, 3) : std::string("-");
  };
  const double accounted = row.triangulation + row.cells + row.volumes + row.phases.links + row.phases.nodes;
  return {row.name,
          std::to_string(row.sites),
          std::to_string(row.threads),
          fixed(1000 * row.seconds, 3),
          share(row.triangulation),
          share(row.cells),
          share(row.volumes),
          share(row.phases.links),
          share(row.phases.nodes),
          share(std::max(0.0, row.seconds - accounted)),
          fixed(microseconds_per_cell(row), 2),
          milliseconds(row.yardstick),
          milliseconds(row.voropp),
          row.hash};
}

Json row_json(const Row& row) {
  const auto or_null = [](const std::optional<double>& seconds) { return seconds ? Json(*seconds) : Json(nullptr); };
  return {{"case", row.name},
          {"sites", row.sites},
          {"threads", row.threads},
          {"seconds", row.seconds},
          {"microseconds_per_cell", microseconds_per_cell(row)},
          {"yardstick_seconds", or_null(row.yardstick)},
          {"voropp_seconds", or_null(row.voropp)},
          {"hash", row.hash},
          {"phases",
           {{"triangulation", row.triangulation},
            {"cells", row.cells},
            {"volumes", row.volumes},
            {"links", row.phases.links},
            {"nodes", row.phases.nodes},
            {"solve", row.phases.solve},
            {"commit", row.phases.commit}}}};
}

std::optional<std::vector<BenchCase>> cases_of(const BenchOptions& options) {
  std::vector<BenchCase> cases;
  for (const std::string& file : options.scenes) {
    auto reading = load_scene(file);
    if (!reading) return std::nullopt;
    cases.push_back({file, std::move(reading->scene), std::move(reading->state)});
  }
  std::vector<int> sites = options.sites;
  if (sites.empty() && cases.empty()) sites = {100, 1000};
  for (const int count : sites) {
    auto scene = random_scene(count, full_registry());
    if (!scene) {
      print_error("--sites", scene.error());
      return std::nullopt;
    }
    cases.push_back({"random-" + std::to_string(count), std::move(*scene), std::nullopt});
  }
  return cases;
}

}  // namespace

int bench_command(const BenchOptions& given) {
  if (given.is_solver) return solver_bench(given);
  BenchOptions options = given;
  if (options.repeat == 0) options.repeat = 3;
  const auto cases = cases_of(options);
  if (!cases) return kBadInput;
  catch_interrupts();
  if (options.is_times) return times_bench(*cases, options);
  TextTable table({{"case"},
                   {"sites", true},
                   {"threads", true},
                   {"ms/tick", true},
                   {"triangulation %", true},
                   {"cells %", true},
                   {"volumes %", true},
                   {"links %", true},
                   {"nodes %", true},
                   {"rest %", true},
                   {"µs/cell", true},
                   {"yardstick ms", true},
                   {"Voro++ ms", true},
                   {"hash"}});
  Json rows = Json::array();
  {
    Progress progress;
    for (const BenchCase& bench : *cases)
      for (const int threads : options.threads.empty() ? std::vector<int>{1} : options.threads) {
        const auto row = measured(bench, threads, options, progress);
        if (!row && is_interrupted()) break;
        if (!row) {
          progress.clear();
          print_error(bench.name, row.error());
          return kBadInput;
        }
        table.add(cells_of(*row));
        rows.push_back(row_json(*row));
      }
  }
  table.print();
  print_line(
      "yardstick: CGAL's plain regular triangulation of the same sites, once; Voro++: all radical cells in the box around the "
      "boundary, once");
  if (!options.json.empty())
    if (auto written = write_file(options.json, write_json(rows) + "\n"); !written) {
      print_error(options.json, written.error());
      return kBadInput;
    }
  return is_interrupted() ? interrupt_exit_code() : kDone;
}

}  // namespace bl::cli::bench
