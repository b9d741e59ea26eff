// Rows of session files: how long a commit takes until it is on the disk, and how long a file takes to open.
#include <unistd.h>
#include <algorithm>
#include <filesystem>

#include "core/journal/journal.h"
#include "core/session/commands.h"
#include "tests/bench/solver_bench_rows.h"

namespace bl::cli::bench {

namespace {

// In the working folder, because the folder for temporary files often lies in memory; gone with its owner.
class SessionFile {
 public:
  SessionFile() : path_("journal-bench-" + std::to_string(getpid()) + ".blsession") { remove(); }
  ~SessionFile() { remove(); }
  SessionFile(const SessionFile&) = delete;
  SessionFile& operator=(const SessionFile&) = delete;
  const std::string& path() const { return path_; }

 private:
  void remove() const {
    std::error_code ignored;
    for (const char* part : {"", "-wal", "-holder"}) std::filesystem::remove(path_ + part, ignored);
  }
  std::string path_;
};

// What a person leaves behind who drags a value.
room::Record drag(std::int64_t last_seq, int entries) {
  room::Record record;
  for (std::int64_t seq = last_seq + 1; seq <= last_seq + entries; ++seq) {
    room::EntryRecord row;
    row.entry.seq = row.entry.tick = row.entry.gesture = seq;
    row.entry.author = "3";
    row.entry.source = {"p8f3a9c2", seq};
    row.entry.command = command<SetPort>({"school", {"smart_volume.demand"}, {std::to_string(5000 + seq)}});
    row.at = 1700000000000 + seq;
    record.entries.push_back(std::move(row));
  }
  record.runs.push_back({"p8f3a9c2", 3, last_seq + entries});
  return record;
}

Result<void> time_commits(const SolverBench& bench, int entries, int commits, int stored, BenchTable& table) {
  const SessionFile file;
  auto made = journal::Journal::create(file.path(), {.code = "TEST", .scene = "{}"}, full_registry(), {});
  if (!made) return made.error();
  std::vector<double> times;
  double all = 0;
  for (int k = 0; k < commits && bench.goes_on("commits of " + std::to_string(entries)); ++k) {
    const room::Record record = drag((*made)->last_seq(), entries);
    const double begin = now();
    if (auto done = (*made)->commit(record); !done) return done;
    times.push_back(now() - begin);
    all += times.back();
  }
  if (times.empty()) return {};
  while ((*made)->last_seq() < stored)
    if (auto done = (*made)->commit(drag((*made)->last_seq(), 1000)); !done) return done;
  if (auto done = (*made)->close(); !done) return done;
  std::string chain;
  std::vector<double> opening;
  for (int round = 0; round < bench.rounds && bench.goes_on("opening a session file"); ++round) {
    const double begin = now();
    const auto opened = journal::Journal::open(file.path(), full_registry(), {});
    opening.push_back(now() - begin);
    if (!opened) return opened.error();
    const auto loaded = (*opened)->load();
    if (!loaded) return loaded.error();
    chain = loaded->chain;
  }
  std::sort(times.begin(), times.end());
  table.add({figure(static_cast<std::size_t>(entries)), figure(1000 * median(times), 2),
             figure(1000 * times[(times.size() - 1) * 95 / 100], 2), figure(entries * static_cast<double>(times.size()) / all, 0),
             figure(static_cast<std::size_t>(std::max(stored, commits * entries))),
             opening.empty() ? no_figure() : figure(1000 * median(opening), 0), word(chain)});
  return {};
}

}  // namespace

BenchTables bench_journal(const SolverBench& bench) {
  BenchTable table{"journal",
                   "Session files: commits until they are on the disk, by the wall clock, and opening",
                   {{"entries a commit", "entries"},
                    {"median ms", "median_ms"},
                    {"95 in 100 within ms", "p95_ms"},
                    {"entries a second", "entries_per_second"},
                    {"entries stored", "stored"},
                    {"opening ms", "opening_ms"},
                    {"hash", "hash", true}}};
  const bool is_quick = bench.options.is_quick;
  for (const int entries : {1, 12, 64})
    if (auto done = time_commits(bench, entries, is_quick ? 10 : 300, is_quick ? 640 : 20000, table); !done) return done.error();
  return std::vector<BenchTable>{std::move(table)};
}

}  // namespace bl::cli::bench
