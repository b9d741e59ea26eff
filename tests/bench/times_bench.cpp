// Prints the parts of a tick, and kinds, nodes and links by what they take, the slowest first.
#include "tests/bench/times_bench.h"

#include <algorithm>
#include <cctype>

#include <nlohmann/json.hpp>

#include "core/base/text.h"
#include "core/file/file_io.h"
#include "core/reading/figures.h"
#include "core/reading/time_rows.h"
#include "core/session/session.h"
#include "ui/cli/commands.h"
#include "ui/cli/interrupt.h"
#include "ui/cli/terminal.h"

namespace bl::cli::bench {

namespace {

using reading::TimeGrouping;
using reading::TimeRow;

constexpr auto kSpan = reading::TimeSpan::all;
constexpr std::size_t kPrinted = 10;  // nodes and links; the JSON file has all of them
constexpr std::pair<TimeGrouping, const char*> kGroupings[] = {
    {TimeGrouping::kinds, "kind"}, {TimeGrouping::nodes, "node"}, {TimeGrouping::links, "link"}};

struct Measured {
  TimeTable table;
  std::string hash;
};

Result<Measured> measured_times(const BenchCase& bench, int threads, int ticks, Progress& progress) {
  auto session = Session::start(full_registry(), bench.scene, bench.state ? &*bench.state : nullptr, threads);
  if (!session) return session.error();
  (*session)->tick();  // the first one compiles, and finds all volumes without a weight
  TickTimes times(now);
  (*session)->measure(&times);
  for (int t = 0; t < ticks && !is_interrupted(); ++t) {
    (*session)->tick();
    progress.show(bench.name + ", " + counted(static_cast<std::size_t>(threads), "thread") + ", tick " + std::to_string(t + 1));
  }
  if (is_interrupted()) return Error{ErrorCode::cancelled, bench.name, "stopped"};
  return Measured{times.table(), hex_digits((*session)->state()->hash)};
}

std::string percent_text(double share) { return fixed(100 * share, 1); }

void print_parts_of(const TimeTable& table) {
  TextTable parts({{"part of the tick"}, {"time", true}, {"share %", true}});
  const double tick = reading::tick_seconds(table, kSpan);
  for (std::size_t k = 0; k < kTickParts; ++k) {
    const double seconds = reading::part_seconds(table, static_cast<TickPart>(k), kSpan);
    parts.add(
        {reading::label_of(static_cast<TickPart>(k)), reading::duration(seconds), percent_text(tick > 0 ? seconds / tick : 0)});
  }
  parts.print();
}

void print_rows(const TimeTable& table, TimeGrouping grouping, const char* word) {
  const std::vector<TimeRow> rows = reading::time_rows(table, grouping, kSpan);
  if (rows.empty()) return;
  TextTable text({{word},
                  {grouping == TimeGrouping::nodes   ? "role"
                   : grouping == TimeGrouping::links ? "kind"
                                                     : "of these"},
                  {"time a tick", true},
                  {"share %", true},
                  {"runs", true},
                  {"pairs", true},
                  {"each", true},
                  {"beside", true}});
  const std::size_t shown = grouping == TimeGrouping::kinds ? rows.size() : std::min(rows.size(), kPrinted);
  for (std::size_t k = 0; k < shown; ++k) {
    const TimeRow& row = rows[k];
    text.add({reading::label_of(table, grouping, row), reading::kind_text(grouping, row), reading::duration(row.seconds),
              percent_text(row.share), reading::readable(row.evaluations), row.is_link() ? reading::readable(row.pairs) : "",
              reading::duration(row.each()), row.is_analysis ? reading::duration(row.beside) : ""});
  }
  print_line();
  text.print();
  if (shown < rows.size()) print_line("and " + std::to_string(rows.size() - shown) + " more", Colour::dim);
}

Json rows_json(const TimeTable& table, TimeGrouping grouping) {
  Json rows = Json::array();
  for (const TimeRow& row : reading::time_rows(table, grouping, kSpan)) {
    Json one = {{"kind", row.kind == nullptr ? "" : row.kind->id},
                {"part", row.is_link()                ? "links"
                         : row.part == TickPart::sets ? "sets"
                                                      : "roles"},
                {"seconds", row.seconds},
                {"share", row.share},
                {"evaluations", row.evaluations},
                {"pairs", row.pairs},
                {"beside_seconds", row.beside}};
    if (grouping == TimeGrouping::kinds) one["members"] = row.members;
    else one["id"] = row.is_link() ? table.plan->links[row.index].id : table.plan->nodes[row.index].id;
    rows.push_back(std::move(one));
  }
  return rows;
}

Json case_json(const std::string& name, int threads, const Measured& measured) {
  const TimeTable& table = measured.table;
  Json parts = Json::object();
  for (std::size_t k = 0; k < kTickParts; ++k) {
    std::string key = reading::label_of(static_cast<TickPart>(k));
    key.front() = static_cast<char>(std::tolower(static_cast<unsigned char>(key.front())));
    parts[key] = reading::part_seconds(table, static_cast<TickPart>(k), kSpan);
  }
  Json json = {{"case", name},
               {"threads", threads},
               {"ticks", table.ticks.evaluations},
               {"seconds", reading::tick_seconds(table, kSpan)},
               {"hash", measured.hash},
               {"parts", std::move(parts)}};
  for (const auto& [grouping, word] : kGroupings) json[std::string(word) + "s"] = rows_json(table, grouping);
  return json;
}

}  // namespace

int times_bench(const std::vector<BenchCase>& cases, const BenchOptions& options) {
  Json all = Json::array();
  for (const BenchCase& bench : cases)
    for (const int threads : options.threads.empty() ? std::vector<int>{1} : options.threads) {
      Progress progress;
      const auto measured = measured_times(bench, threads, options.ticks, progress);
      progress.clear();
      if (!measured && is_interrupted()) return interrupt_exit_code();
      if (!measured) {
        print_error(bench.name, measured.error());
        return kBadInput;
      }
      if (!all.empty()) print_line();
      print_line(bench.name + ": " + reading::duration(reading::tick_seconds(measured->table, kSpan)) + " a tick, mean of " +
                     std::to_string(measured->table.ticks.evaluations) + ", " +
                     counted(static_cast<std::size_t>(threads), "thread") + ", hash " + measured->hash,
                 Colour::bold);
      print_parts_of(measured->table);
      for (const auto& [grouping, word] : kGroupings) print_rows(measured->table, grouping, word);
      all.push_back(case_json(bench.name, threads, *measured));
    }
  if (options.json.empty()) return kDone;
  if (auto written = write_file(options.json, write_json(all) + "\n"); !written) {
    print_error(options.json, written.error());
    return kBadInput;
  }
  return kDone;
}

}  // namespace bl::cli::bench
