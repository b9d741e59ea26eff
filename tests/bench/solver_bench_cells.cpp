// Rows of cells: the diagram without balls, and shrink-wrapped cells.
#include <algorithm>
#include <cmath>

#include "core/base/parallel.h"
#include "core/geometry/yardstick.h"
#include "tests/bench/bench_voropp.h"
#include "tests/bench/solver_bench_rows.h"

namespace bl::cli::bench {

namespace {

// One set of sites with balls of some size; `plain` are the same sites as the others get them.
struct CellCase {
  std::string balls;
  std::vector<geometry::PowerSite> plain, sites;
  bool is_cut = false;  ///< do balls cut cells?
};

// Wider than the unit cube's diagonal, so that no ball cuts.
constexpr double kNoBalls = 3;

BenchTable cell_table(const std::string& name, const std::string& heading) {
  return {name,
          heading,
          {{"balls", "balls", true},
           {"sites", "sites"},
           {"threads", "threads"},
           {"fill %", "fill_percent"},
           {"ms", "milliseconds"},
           {"least ms", "least_milliseconds"},
           {"µs/cell", "microseconds_per_cell"},
           {"/CGAL", "ratio_to_cgal"},
           {"/Voro++", "ratio_to_voropp"},
           {"/1 thread", "ratio_to_one_thread"},
           {"least/1", "least_ratio_to_one_thread"},
           {"CGAL ms", "cgal_milliseconds"},
           {"Voro++ ms", "voropp_milliseconds"},
           {"differs by", "differs_from_voropp"},
           {"hash", "hash", true}}};
}

// Largest difference of a volume, as a share of the mean.
BenchCell difference([[maybe_unused]] const geometry::Domain& domain, [[maybe_unused]] const CellCase& set,
                     [[maybe_unused]] std::span<const geometry::CellMeasure> cells) {
#ifdef BL_VOROPP
  if (set.is_cut) return no_figure();
  const VoroppCells others = voropp_cells(domain.minimum, domain.maximum, set.plain);
  double most = 0;
  for (std::size_t i = 0; i < cells.size(); ++i) most = std::max(most, std::abs(cells[i].volume - others.volumes[i]));
  return tiny(most * static_cast<double>(cells.size()) / domain.volume);
#else
  return no_figure();
#endif
}

// Enters the diagram with each number of threads, then those it is compared with: CGAL, and Voro++ where it is there.
std::vector<Contender> contenders_of(const geometry::Domain& domain, const CellCase& set,
                                     const std::vector<std::unique_ptr<ThreadPool>>& pools) {
  std::vector<Contender> contenders;
  for (const auto& pool : pools) {
    // Everything anew each time: memory, search structure, cells.
    contenders.push_back({[&domain, &set, &pool] { (void)power_cells(domain, set.sites, plain_cells(pool.get())); }, {}, {}});
  }
  contenders.push_back({[&set] { (void)plain_triangulation(set.plain); }, {}, {}});
#ifdef BL_VOROPP
  contenders.push_back({[&domain, &set] { (void)voropp_cells(domain.minimum, domain.maximum, set.plain); }, {}, {}});
#endif
  return contenders;
}

Result<void> measure(const SolverBench& bench, const CellCase& set, BenchTable& table) {
  const geometry::Domain domain = unit_cube();
  const std::vector<int> threads = bench.threads();
  std::vector<std::unique_ptr<ThreadPool>> pools;
  for (const int count : threads) pools.push_back(std::make_unique<ThreadPool>(count));
  std::vector<Contender> contenders = contenders_of(domain, set, pools);
  take_turns(contenders, bench.rounds, bench.turn_seconds,
             [&] { return bench.goes_on("cells of " + std::to_string(set.sites.size()) + " sites"); });
  if (!bench.goes_on("")) return Error{ErrorCode::cancelled, "", "stopped"};
  const Contender& cgal = contenders[threads.size()];
  const Contender* voropp = contenders.size() > threads.size() + 1 ? &contenders.back() : nullptr;
  const auto ratio = [](double mine, double other) { return figure(mine / other, 2); };
  for (std::size_t t = 0; t < threads.size(); ++t) {
    const auto made = power_cells(domain, set.sites, plain_cells(pools[t].get()));
    if (!made) return made.error();
    const std::vector<geometry::CellMeasure>& cells = *made;
    const int count = threads[t];
    const double seconds = contenders[t].median.of(count);
    table.add({word(set.balls), figure(cells.size()), figure(static_cast<std::size_t>(count)),
               figure(100 * totals_of(cells).volume / domain.volume, 1), figure(1e3 * seconds, 3),
               figure(1e3 * contenders[t].least.of(count), 3), figure(1e6 * seconds / static_cast<double>(cells.size()), 2),
               ratio(seconds, cgal.median.of(count)), voropp ? ratio(seconds, voropp->median.of(count)) : no_figure(),
               count > 1 && threads.front() == 1 ? ratio(seconds, contenders.front().median.wall) : no_figure(),
               count > 1 && threads.front() == 1 ? ratio(contenders[t].least.wall, contenders.front().least.wall) : no_figure(),
               figure(1e3 * cgal.median.of(count), 3), voropp ? figure(1e3 * voropp->median.of(count), 3) : no_figure(),
               difference(domain, set, cells), word(hash_of(cells))});
  }
  return {};
}

// The weight that all sites have to gain until their balls fill so much of the cube.
double lift_to_fill(const std::vector<geometry::PowerSite>& sites, double fill) {
  const geometry::Domain domain = unit_cube();
  const double square = spacing_of(static_cast<int>(sites.size())) * spacing_of(static_cast<int>(sites.size()));
  double low = 0, high = 2 * square;
  for (int step = 0; step < 12; ++step) {
    const double middle = 0.5 * (low + high);
    const auto cells = power_cells(domain, lifted(sites, middle), plain_cells());
    if (!cells) break;
    (totals_of(*cells).volume < fill * domain.volume ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace

BenchTables bench_diagram(const SolverBench& bench) {
  BenchTable table =
      cell_table("diagram", "Diagram: random weighted points in a cube; volumes, neighbours, facet areas; no ball cuts");
  for (const int count : bench.sites({50, 500, 5000, 50000}, {50, 500})) {
    const auto sites = random_sites(count);
    if (auto done = measure(bench, {"none", sites, lifted(sites, kNoBalls), false}, table); !done) return done.error();
  }
  return std::vector<BenchTable>{table};
}

BenchTables bench_wrapped(const SolverBench& bench) {
  BenchTable table = cell_table("wrapped", "Shrink-wrapped cells: the same points with larger weights, cut by their balls");
  for (const int count : bench.sites({50, 500, 5000, 50000}, {500})) {
    const auto sites = random_sites(count);
    const double square = spacing_of(count) * spacing_of(count);
    if (auto done = measure(bench, {"+ s²/4", sites, lifted(sites, 0.25 * square), true}, table); !done) return done.error();
    const double lift = lift_to_fill(sites, 0.7);
    if (auto done = measure(bench, {"to 70 %", sites, lifted(sites, lift), true}, table); !done) return done.error();
  }
  return std::vector<BenchTable>{table};
}

}  // namespace bl::cli::bench
