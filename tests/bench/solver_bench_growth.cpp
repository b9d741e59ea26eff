// Rows of growth: time and memory of the diagram and of a fit, from a hundred sites to a hundred thousand.
#include <array>
#include <filesystem>

#include "core/drawing/line_chart.h"
#include "core/file/file_io.h"
#include "core/geometry/volume_fit.h"
#include "core/geometry/yardstick.h"
#include "tests/bench/bench_voropp.h"
#include "tests/bench/solver_bench_fit.h"

namespace bl::cli::bench {

namespace {

constexpr double kGrowthFill = 0.7;

struct GrowthCurve {
  const char *label, *key, *colour, *dashes;
};
constexpr std::array kCurves = {GrowthCurve{"diagram", "diagram", "#225599", ""},
                                GrowthCurve{"cold fit at 70 %, to 1e-6", "fit", "#aa3311", ""},
                                GrowthCurve{"CGAL, triangulation alone", "cgal", "#666a73", "6 2.5"},
                                GrowthCurve{"Voro++, diagram", "voropp", "#8a5a00", "2 2.5"}};

struct GrowthRow {
  int sites = 0;
  std::array<std::optional<double>, kCurves.size()> seconds, bytes;  // bytes: of all sites
  std::string diagram_hash, fit_hash;
};

Result<GrowthRow> measure(const SolverBench& bench, int count) {
  GrowthRow row;
  row.sites = count;
  const geometry::Domain domain = unit_cube();
  const geometry::FitProblem problem = fit_problem(count, kGrowthFill);
  const auto plain = random_sites(count), sites = lifted(plain, 3);
  std::vector<Contender> contenders(2);
  contenders[0].work = [&] {
    geometry::PowerDiagram diagram;
    (void)diagram.set_domain(domain);
    if (const auto cells = diagram.update(sites, plain_cells()); cells && row.diagram_hash.empty())
      row.diagram_hash = hash_of(*cells);
  };
  contenders[1].work = [&] {
    if (const auto fit = fit_volumes(domain, problem, {}); fit && row.fit_hash.empty()) row.fit_hash = hash_of(fit->volumes);
  };
  contenders.push_back({[&] { (void)plain_triangulation(plain); }, {}, {}});
#ifdef BL_VOROPP
  contenders.push_back({[&] { (void)voropp_cells(domain.minimum, domain.maximum, plain); }, {}, {}});
#endif
  const std::string what = "growth, " + std::to_string(count) + " sites";
  take_turns(contenders, std::min(3, bench.rounds), bench.turn_seconds, [&] { return bench.goes_on(what); });
  for (std::size_t c = 0; c < contenders.size(); ++c) {
    if (!bench.goes_on(what)) return Error{ErrorCode::cancelled, "", "stopped"};
    row.seconds[c] = contenders[c].median.processor;
    if (count >= kLeastMeasured) row.bytes[c] = peak_bytes(contenders[c].work);
  }
  return row;
}

Result<void> draw(const std::vector<GrowthRow>& rows, const std::string& folder) {
  drawing::ChartPanel time{"time per site [µs], one thread", "sites", {}, 0, ""};
  drawing::ChartPanel memory{"peak memory per site [bytes]", "sites", {}, 0, ""};
  for (std::size_t c = 0; c < kCurves.size(); ++c) {
    drawing::ChartLine seconds{kCurves[c].label, kCurves[c].colour, kCurves[c].dashes, {}}, bytes = seconds;
    for (const GrowthRow& row : rows) {
      const double count = row.sites;
      if (row.seconds[c]) seconds.points.push_back({count, 1e6 * *row.seconds[c] / count});
      if (row.bytes[c]) bytes.points.push_back({count, *row.bytes[c] / count});
    }
    if (seconds.points.empty()) continue;
    time.lines.push_back(std::move(seconds));
    memory.lines.push_back(std::move(bytes));
  }
  std::error_code ignored;  // a folder that cannot be made is told by the file that cannot be written
  std::filesystem::create_directories(folder, ignored);
  return write_file(
      folder + "/growth.svg",
      drawing::draw_chart({"growth",
                           "Growth of the solver",
                           "Time and peak memory per site over the number of sites, on logarithmic scales: the diagram "
                           "without balls, a cold fit, the plain triangulation of CGAL, and the diagram of Voro++.",
                           {time, memory}}));
}

}  // namespace

BenchTables bench_growth(const SolverBench& bench) {
  std::vector<BenchTable::Column> columns = {{"sites", "sites"}};
  for (const GrowthCurve& curve : kCurves) {
    const std::string key = curve.key;
    columns.push_back({key + " µs/site", key + "_microseconds_per_site"});
  }
  for (const GrowthCurve& curve : kCurves) {
    const std::string key = curve.key;
    columns.push_back({key + " B/site", key + "_bytes_per_site"});
  }
  columns.push_back({"diagram hash", "diagram_hash", true});
  columns.push_back({"fit hash", "fit_hash", true});
  BenchTable table("growth",
                   "Growth: diagram without balls, cold fit at 70 % to 1e-6, one thread; B: growth of the process while it works "
                   "(peak of the resident set, after what was free was given back)",
                   columns);
  std::vector<GrowthRow> rows;
  for (const int count : bench.sites({100, 300, 1000, 3000, 10000, 30000, 100000}, {100, 300})) {
    auto row = measure(bench, count);
    if (!row) return row.error();
    std::vector<BenchCell> cells = {figure(static_cast<std::size_t>(count))};
    add_figures(cells, row->seconds, 1e6 / count, 2);
    add_figures(cells, row->bytes, 1.0 / count, 0);
    cells.push_back(word(row->diagram_hash));
    cells.push_back(word(row->fit_hash));
    table.add(std::move(cells));
    rows.push_back(std::move(*row));
  }
  if (!bench.options.chart.empty()) {
    if (auto drawn = draw(rows, bench.options.chart); !drawn) return drawn.error();
  }
  return std::vector<BenchTable>{table};
}

}  // namespace bl::cli::bench
