// Runs the kinds of rows one after the other, prints them, and keeps them for the JSON file.
#include "tests/bench/solver_bench.h"

#include <algorithm>
#include <cstdio>

#include <nlohmann/json.hpp>

#include "core/file/file_io.h"
#include "tests/bench/solver_bench_rows.h"
#include "ui/cli/interrupt.h"

namespace bl::cli::bench {

namespace {

struct Kind {
  const char* name;
  BenchTables (*measure)(const SolverBench&);
};

constexpr Kind kKinds[] = {
    {"diagram", bench_diagram},   {"wrapped", bench_wrapped}, {"fit", bench_cold_fit},    {"drag", bench_drag},
    {"standing", bench_standing}, {"growth", bench_growth},   {"complex", bench_complex}, {"rays", bench_rays},
    {"traffic", bench_traffic},   {"study", bench_study},     {"tick", bench_tick},       {"plan", bench_plan},
    {"past", bench_past},         {"load", bench_load},       {"journal", bench_journal}, {"tick_growth", bench_tick_growth}};

constexpr const char* kMethod =
    "One thread: processor time; several: wall time. Medians of turns that all contenders took one after the other.\n"
    "CGAL: its plain regular triangulation of the same sites; Voro++: all radical cells of the same sites in the box, with "
    "volumes,\n"
    "neighbours and face areas. Hash: of the bits of all volumes.";

bool is_wanted(const BenchOptions& options, const char* name) {
  return options.rows.empty() || std::find(options.rows.begin(), options.rows.end(), name) != options.rows.end();
}

}  // namespace

int solver_bench(const BenchOptions& options) {
  catch_interrupts();
  const std::string machine = machine_line();
  print_line(machine);
  print_page(kMethod);
  Json rows = Json::array();
  for (const Kind& kind : kKinds) {
    if (!is_wanted(options, kind.name) || is_interrupted()) continue;
    Progress progress;
    SolverBench bench{options, progress};
    if (options.is_quick) bench.rounds = 1, bench.turn_seconds = 0;
    if (options.repeat > 0) bench.rounds = options.repeat;
    const auto tables = kind.measure(bench);
    progress.clear();
    if (!tables && !is_interrupted()) {
      print_error("bench --solver", tables.error());
      return kBadInput;
    }
    if (!tables) break;
    for (const BenchTable& table : *tables) {
      table.print();
      table.append_to(rows);
    }
    std::fflush(stdout);  // the whole run takes minutes: what is known is shown, in a file too
  }
  if (!options.json.empty()) {
    const Json all = {{"machine", machine}, {"rows", rows}};
    if (auto written = write_file(options.json, write_json(all, 2) + "\n"); !written) {
      print_error(options.json, written.error());
      return kBadInput;
    }
  }
  return is_interrupted() ? interrupt_exit_code() : kDone;
}

}  // namespace bl::cli::bench
