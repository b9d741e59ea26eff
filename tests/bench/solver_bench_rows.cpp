// Tables and sets of sites that all rows of the solver's bench share.
#include "tests/bench/solver_bench_rows.h"

#include <array>
#include <cmath>
#include <cstdio>

#include <nlohmann/json.hpp>

#include "core/base/hash.h"
#include "core/base/random.h"
#include "core/base/text.h"
#include "ui/cli/interrupt.h"

namespace bl::cli::bench {

BenchCell figure(double value, int decimals) { return {fixed(value, decimals), value}; }
BenchCell figure(std::size_t value) { return {std::to_string(value), static_cast<double>(value)}; }
BenchCell word(const std::string& text) { return {text, std::nullopt}; }
BenchCell no_figure() { return {"", std::nullopt}; }

void add_figures(std::vector<BenchCell>& cells, std::span<const std::optional<double>> measured, double scale, int decimals) {
  for (const auto& value : measured) cells.push_back(value ? figure(scale * *value, decimals) : no_figure());
}

BenchCell tiny(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.1e", value);
  return {text.data(), value};
}

void BenchTable::print() const {
  std::vector<TextTable::Column> columns;
  for (const Column& column : columns_) columns.push_back({column.header, !column.is_word});
  TextTable table(std::move(columns));
  for (const auto& row : rows_) {
    std::vector<std::string> texts;
    for (const BenchCell& cell : row) texts.push_back(cell.text.empty() ? "-" : cell.text);
    table.add(std::move(texts));
  }
  print_line();
  print_line(heading_, Colour::bold);
  table.print();
}

void BenchTable::append_to(Json& rows) const {
  for (const auto& row : rows_) {
    Json object = {{"rows", name_}};
    for (std::size_t c = 0; c < columns_.size(); ++c) {
      const BenchCell& cell = row[c];
      object[columns_[c].key] = cell.number ? Json(*cell.number) : cell.text.empty() ? Json(nullptr) : Json(cell.text);
    }
    rows.push_back(std::move(object));
  }
}

std::vector<int> SolverBench::sites(std::vector<int> usual, std::vector<int> quick) const {
  return !options.sites.empty() ? options.sites : options.is_quick ? std::move(quick) : std::move(usual);
}

bool SolverBench::goes_on(const std::string& what) const {
  progress.show(what);
  return !is_interrupted();
}

geometry::Domain unit_cube() {
  const std::array<Point3, 4> plan = {Point3{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  return *geometry::extrude(plan, 0, 1);
}

double spacing_of(int count) {
  // The library's cube root may differ in its last digits from machine to machine, and the sites shall not.
  return std::round(1e6 / std::cbrt(static_cast<double>(count))) / 1e6;
}

std::vector<geometry::PowerSite> random_sites(int count, std::uint64_t seed) {
  Random random(seed);
  const double most = 0.25 * spacing_of(count) * spacing_of(count);
  std::vector<geometry::PowerSite> sites(static_cast<std::size_t>(count));
  for (geometry::PowerSite& site : sites) {
    site.position.x = random.uniform();
    site.position.y = random.uniform();
    site.position.z = random.uniform();
    site.weight = random.uniform(0, most);
  }
  return sites;
}

std::vector<geometry::PowerSite> lifted(std::vector<geometry::PowerSite> sites, double more_weight) {
  for (geometry::PowerSite& site : sites) site.weight += more_weight;
  return sites;
}

std::vector<geometry::PowerSite> without_weights(std::vector<geometry::PowerSite> sites) {
  for (geometry::PowerSite& site : sites) site.weight = 0;
  return sites;
}

std::vector<double> random_demands(int count, double fill, std::uint64_t seed) {
  Random random(seed, 1);
  std::vector<double> demands(static_cast<std::size_t>(count));
  double sum = 0;
  for (double& demand : demands) {
    // 20 to the power of k / 65536, by products of its powers of two: the library's own power differs from machine to machine.
    demand = 1;
    double power = 1.0000457122916249;
    for (std::uint64_t k = random.below(65536); k > 0; k /= 2, power *= power) {
      if (k % 2 == 1) demand *= power;
    }
    sum += demand;
  }
  for (double& demand : demands) demand *= fill / sum;
  return demands;
}

geometry::CellOptions plain_cells(ThreadPool* pool) {
  geometry::CellOptions options;
  options.with_shape = options.with_centroid = false;
  options.pool = pool;
  return options;
}

std::string hash_of(std::span<const double> volumes) {
  Hash hash;
  for (const double volume : volumes) hash.add(volume);
  return hash.hex();
}

std::string hash_of(std::span<const geometry::CellMeasure> cells) {
  std::vector<double> volumes;
  for (const geometry::CellMeasure& cell : cells) volumes.push_back(cell.volume);
  return hash_of(volumes);
}

}  // namespace bl::cli::bench
