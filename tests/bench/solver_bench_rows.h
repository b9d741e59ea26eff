// The rows of the solver's bench: what they share, and who measures which.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/define/json_text.h"
#include "core/geometry/domain.h"
#include "core/geometry/power_cells.h"
#include "tests/bench/bench_command.h"
#include "tests/bench/bench_tools.h"
#include "ui/cli/commands.h"
#include "ui/cli/terminal.h"

namespace bl::cli::bench {

/// One figure: as people read it, and as it is.
struct BenchCell {
  std::string text;
  std::optional<double> number;  ///< nothing: a word, or nothing was measured
};
BenchCell figure(double value, int decimals);
BenchCell figure(std::size_t value);
/// With so many digits that count, however small it is.
BenchCell tiny(double value);
BenchCell word(const std::string& text);
BenchCell no_figure();
/// Figures `scale` times as large, in a row; none where nothing was measured.
void add_figures(std::vector<BenchCell>& cells, std::span<const std::optional<double>> measured, double scale, int decimals);

/// Rows under one heading, printed for people and written as JSON from the same figures.
class BenchTable {
 public:
  struct Column {
    std::string header;  ///< for people
    std::string key;     ///< in JSON
    bool is_word = false;
  };
  BenchTable(std::string name, std::string heading, std::vector<Column> columns)
      : name_(std::move(name)), heading_(std::move(heading)), columns_(std::move(columns)) {}
  void add(std::vector<BenchCell> cells) { rows_.push_back(std::move(cells)); }
  void print() const;
  /// Appends one object per row, with "rows" saying which kind it is.
  void append_to(Json& rows) const;

 private:
  std::string name_, heading_;
  std::vector<Column> columns_;
  std::vector<std::vector<BenchCell>> rows_;
};

/// What all rows are measured with.
struct SolverBench {
  const BenchOptions& options;
  Progress& progress;
  int rounds = 5;
  double turn_seconds = 0.1;

  /// The sizes that were asked for, or those that suit the rows.
  std::vector<int> sites(std::vector<int> usual, std::vector<int> quick) const;
  std::vector<int> threads() const { return options.threads.empty() ? std::vector<int>{1, 2} : options.threads; }
  /// Shows what is being measured; false after Ctrl-C.
  bool goes_on(const std::string& what) const;
};

// --- Sets of sites, the same on every machine ---------------------------------------------------------------------------------

geometry::Domain unit_cube();
/// About the distance between neighbours of so many sites in the unit cube [m].
double spacing_of(int count);
/// Uniform in the unit cube, weights uniform in [0, (spacing / 2)²].
std::vector<geometry::PowerSite> random_sites(int count, std::uint64_t seed = 20070);
/// The same diagram with larger balls.
std::vector<geometry::PowerSite> lifted(std::vector<geometry::PowerSite> sites, double more_weight);
/// Sites whose weights are yet to be found.
std::vector<geometry::PowerSite> without_weights(std::vector<geometry::PowerSite> sites);
/// Log-uniform over a factor of 20; their sum is `fill` of the unit cube.
std::vector<double> random_demands(int count, double fill, std::uint64_t seed = 20070);

/// Volumes, neighbours and facet areas, nothing else.
geometry::CellOptions plain_cells(ThreadPool* pool = nullptr);

std::string hash_of(std::span<const double> volumes);
std::string hash_of(std::span<const geometry::CellMeasure> cells);

/// Fills of the boundary that fits are measured at.
inline constexpr double kFills[] = {0.3, 0.7, 0.95, 0.99, 1.0};

/// Below so many sites the pages that a system hands out are larger than the memory that is to be measured.
inline constexpr int kLeastMeasured = 1000;

// --- Rows ---------------------------------------------------------------------------------------------------------------------

using BenchTables = Result<std::vector<BenchTable>>;
/// All cells of the diagram, without balls.
BenchTables bench_diagram(const SolverBench& bench);
/// All cells of the diagram, cut by balls.
BenchTables bench_wrapped(const SolverBench& bench);
/// Weights found from nothing; with `--seeds` the most steps of many sets.
BenchTables bench_cold_fit(const SolverBench& bench);
/// One site dragged through the others, frame by frame.
BenchTables bench_drag(const SolverBench& bench);
/// Whole storeys on a plot instead of balls: fits from nothing, and one volume dragged.
BenchTables bench_standing(const SolverBench& bench);
/// Time and memory over the number of sites.
BenchTables bench_growth(const SolverBench& bench);
/// The cell complex kept live while one site changes.
BenchTables bench_complex(const SolverBench& bench);
/// Rays to the sun among casters, against a loop over all triangles.
BenchTables bench_rays(const SolverBench& bench);
/// Equilibria of traffic against bi-conjugate Frank-Wolfe, shortest ways against Boost.Graph.
BenchTables bench_traffic(const SolverBench& bench);
/// Whole ticks, against ticks that evaluate everything.
BenchTables bench_tick(const SolverBench& bench);
/// Ticks and memory over the number of volumes, beside the solver alone.
BenchTables bench_tick_growth(const SolverBench& bench);
/// Plans and states after one edit, against compiling the whole scene.
BenchTables bench_plan(const SolverBench& bench);
/// Memory of ten thousand ticks that a rewind can reach, and the time of a rewind.
BenchTables bench_past(const SolverBench& bench);
/// Reading a scene file, the first state, the first tick.
BenchTables bench_load(const SolverBench& bench);
BenchTables bench_journal(const SolverBench& bench);
/// Feedback against Newton on a scene.
BenchTables bench_study(const SolverBench& bench);

}  // namespace bl::cli::bench
