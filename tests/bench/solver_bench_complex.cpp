// Rows of the cell complex: what it costs to keep it live while one site changes, against building it anew.
#include <algorithm>
#include <utility>

#include "core/base/hash.h"
#include "core/geometry/cell_complex.h"
#include "tests/bench/solver_bench_rows.h"

namespace bl::cli::bench {

namespace {

struct ComplexRun {
  std::vector<double> diagram_seconds, complex_seconds, cells, elements, changes;
};

double change_count(const geometry::ComplexChange& change) {
  return static_cast<double>(change.added.size() + change.removed.size() + change.changed.size());
}

// Frames in each of which another site is moved by a tenth of the distance between neighbours, or gains weight.
Result<ComplexRun> run_frames(const SolverBench& bench, bool is_move, geometry::PowerDiagram& diagram,
                              geometry::CellComplex& complex, std::vector<geometry::PowerSite>& sites) {
  geometry::CellOptions options;
  options.with_outlines = true;
  ComplexRun run;
  const int count = static_cast<int>(sites.size()), frames = bench.options.is_quick ? 5 : 40;
  const double step = 0.1 * spacing_of(count);
  for (int frame = 0; frame < frames && bench.goes_on("complex of " + std::to_string(count) + " sites"); ++frame) {
    geometry::PowerSite& site = sites[static_cast<std::size_t>(frame) * 7919 % sites.size()];
    if (is_move) {
      site.position += Vector3{step, -step, step};
    } else {
      site.weight += step * step;
    }
    const double began = processor_time();
    if (auto made = diagram.update(sites, options); !made) return made.error();
    const double middle = processor_time();
    if (auto done = complex.update(diagram, sites); !done) return done.error();
    run.complex_seconds.push_back(processor_time() - middle);
    run.diagram_seconds.push_back(middle - began);
    run.cells.push_back(static_cast<double>(complex.work().cells_visited));
    run.elements.push_back(static_cast<double>(complex.work().elements_made));
    run.changes.push_back(change_count(complex.change()));
  }
  if (!bench.goes_on("")) return Error{ErrorCode::cancelled, "", "stopped"};
  return run;
}

std::string hash_of_listing(const geometry::CellComplex& complex) {
  Hash hash;
  hash.add(complex.listing());
  return hash.hex();
}

Result<void> measure_complex(const SolverBench& bench, int count, BenchTable& table) {
  geometry::PowerDiagram diagram;
  geometry::CellComplex complex;
  std::vector<geometry::PowerSite> sites = random_sites(count);
  geometry::CellOptions options;
  options.with_outlines = true;
  if (auto set = diagram.set_domain(unit_cube()); !set) return set.error();
  if (auto made = diagram.update(sites, options); !made) return made.error();
  if (auto built = complex.update(diagram, sites); !built) return built.error();
  const std::size_t all = complex.work().elements_made;
  for (const bool is_move : {true, false}) {
    auto run = run_frames(bench, is_move, diagram, complex, sites);
    if (!run) return run.error();
    std::vector<double> build;
    geometry::CellComplex anew;
    for (int round = 0; round < std::max(1, bench.rounds); ++round) {
      anew = geometry::CellComplex();
      const double began = processor_time();
      if (auto built = anew.update(diagram, sites, true); !built) return built.error();
      build.push_back(processor_time() - began);
    }
    const bool is_same = anew.listing() == complex.listing();
    const double most = *std::max_element(run->complex_seconds.begin(), run->complex_seconds.end());
    table.add(
        {word(is_move ? "move" : "weight"), figure(static_cast<std::size_t>(count)), figure(all), figure(1e3 * median(build), 2),
         figure(1e3 * median(run->diagram_seconds), 3), figure(1e3 * median(run->complex_seconds), 3), figure(1e3 * most, 3),
         figure(median(run->cells), 0), figure(median(run->elements), 0), figure(median(run->changes), 0),
         figure(median(build) / median(run->complex_seconds), 0), word(is_same ? "yes" : "NO"), word(hash_of_listing(complex))});
  }
  return {};
}

}  // namespace

BenchTables bench_complex(const SolverBench& bench) {
  BenchTable table("complex", "Cell complex: one site changes per frame; facets, edges and vertices with their names are kept up",
                   {{"change", "change", true},
                    {"sites", "sites"},
                    {"elements", "elements"},
                    {"build ms", "build_milliseconds"},
                    {"cells ms", "diagram_milliseconds"},
                    {"update ms", "update_milliseconds"},
                    {"worst ms", "worst_update_milliseconds"},
                    {"cells", "cells_visited"},
                    {"remade", "elements_made"},
                    {"listed", "changes_listed"},
                    {"build/update", "build_over_update"},
                    {"same", "same_as_built", true},
                    {"hash", "hash", true}});
  for (const int count : bench.sites({500, 5000, 50000}, {500})) {
    if (auto done = measure_complex(bench, count, table); !done) return done.error();
  }
  return std::vector<BenchTable>{table};
}

}  // namespace bl::cli::bench
