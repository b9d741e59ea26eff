// Rows of history: what it takes to keep every tick of a long negotiation within reach, and to go back to one of them.
#include <algorithm>

#include "core/base/random.h"
#include "core/base/text.h"
#include "core/define/registry.h"
#include "core/host/past.h"
#include "tests/bench/random_scene.h"
#include "tests/bench/solver_bench_rows.h"

namespace bl::cli::bench {

namespace {

constexpr int kSamples = 12;
Result<void> time_past(const SolverBench& bench, int count, int ticks, BenchTable& table) {
  const auto scene = restless_scene(count, 0.7);
  if (!scene) return scene.error();
  Simulation simulation(full_registry(), 1);
  simulation.set_scene(*scene);
  for (int t = 0; t < 3; ++t) simulation.step();
  const std::int64_t first = simulation.state()->tick;
  host::Past past;
  std::vector<std::uint64_t> hashes;
  double keeping = 0, ticking = 0;
  const auto grown = peak_bytes([&] {
    for (int t = 0; t < ticks && bench.goes_on("history of " + std::to_string(count) + " volumes, tick " + std::to_string(t));
         ++t) {
      const double begin = processor_time();
      hashes.push_back(simulation.state()->hash);
      past.add(simulation.state());
      const double kept = processor_time();
      simulation.step();
      keeping += kept - begin;
      ticking += processor_time() - kept;
    }
  });
  // Back to some ticks, the farthest from a packed state among them.
  Simulation again(full_registry(), 1);
  again.set_scene(*scene);
  Random random(20070);
  std::vector<double> seconds;
  bool is_same = true;
  for (int s = 0; s < kSamples && bench.goes_on("rewinds"); ++s) {
    const std::size_t which =
        s == 0 ? std::min<std::size_t>(host::Past::kPackedEvery, hashes.size() - 1) : random.below(hashes.size());
    const double begin = processor_time();
    if (auto done = past.recompute(first + static_cast<std::int64_t>(which), again); !done) return done;
    seconds.push_back(processor_time() - begin);
    is_same = is_same && again.state()->hash == hashes[which];
  }
  if (!is_same) return Error{ErrorCode::internal, "", "a tick that was computed again comes to another state"};
  const double per_tick = hashes.empty() ? 0 : 1000 / static_cast<double>(hashes.size());
  table.add({figure(static_cast<std::size_t>(count)), figure(hashes.size()),
             figure(static_cast<std::size_t>(past.oldest() - first)), grown ? figure(*grown / 1e6, 1) : no_figure(),
             figure(per_tick * keeping, 3), figure(per_tick * ticking, 2), figure(1000 * median(seconds), 1),
             figure(1000 * *std::max_element(seconds.begin(), seconds.end()), 1), word(hex_digits(simulation.state()->hash))});
  return {};
}

}  // namespace

BenchTables bench_past(const SolverBench& bench) {
  BenchTable table{"past",
                   "Every tick within reach of a rewind while all volumes move",
                   {{"volumes", "sites"},
                    {"ticks", "ticks"},
                    {"given up", "given_up"},
                    {"memory MB", "megabytes"},
                    {"keeping ms", "keeping_ms"},
                    {"tick ms", "tick_ms"},
                    {"rewind ms", "rewind_ms"},
                    {"worst rewind ms", "worst_rewind_ms"},
                    {"hash", "hash", true}}};
  for (const int count : bench.sites({1000}, {60}))
    if (auto done = time_past(bench, count,
                              bench.options.is_quick     ? 70
                              : bench.options.ticks > 20 ? bench.options.ticks
                                                         : 10000,
                              table);
        !done)
      return done.error();
  return std::vector<BenchTable>{std::move(table)};
}

}  // namespace bl::cli::bench
