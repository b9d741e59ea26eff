// Rows of opening a scene: reading the file, the first state, the first tick.
#include "core/base/text.h"
#include "core/define/registry.h"
#include "core/file/scene_file.h"
#include "core/session/session.h"
#include "tests/bench/random_scene.h"
#include "tests/bench/solver_bench_rows.h"

namespace bl::cli::bench {

namespace {

Result<void> time_load(const SolverBench& bench, int count, BenchTable& table) {
  const auto scene = linked_scene(count, 0.7);
  if (!scene) return scene.error();
  const std::string text = write_scene(*scene, full_registry());
  std::vector<double> reading, starting, ticking;
  std::string hash;
  for (int round = 0; round < bench.rounds && bench.goes_on("opening " + std::to_string(count) + " volumes"); ++round) {
    const double begin = processor_time();
    const SceneReading read = read_scene(text, full_registry());
    const double there = processor_time();
    const auto session = Session::start(full_registry(), read.scene, nullptr, 1);
    const double started = processor_time();
    if (!session) return session.error();
    (*session)->tick();
    ticking.push_back(processor_time() - started);
    reading.push_back(there - begin);
    starting.push_back(started - there);
    hash = hex_digits((*session)->state()->hash);
  }
  table.add({figure(static_cast<std::size_t>(count)), figure(static_cast<double>(text.size()) / 1e6, 2),
             figure(1000 * median(reading), 1), figure(1000 * median(starting), 1),
             figure(1000 * (median(reading) + median(starting)), 1), figure(1000 * median(ticking), 1), word(hash)});
  return {};
}

}  // namespace

BenchTables bench_load(const SolverBench& bench) {
  BenchTable table{"load",
                   "Opening a scene with three links to sets",
                   {{"volumes", "sites"},
                    {"file MB", "megabytes"},
                    {"reading ms", "reading_ms"},
                    {"first state ms", "state_ms"},
                    {"both ms", "both_ms"},
                    {"first tick ms", "tick_ms"},
                    {"hash", "hash", true}}};
  for (const int count : bench.sites({1000, 10000, 30000}, {60}))
    if (auto done = time_load(bench, count, table); !done) return done.error();
  return std::vector<BenchTable>{std::move(table)};
}

}  // namespace bl::cli::bench
