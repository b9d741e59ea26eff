// `compare`: runs two scenes and lists every indicator and every setting that differs.
#include <algorithm>
#include <filesystem>

#include "core/base/stop.h"
#include "core/base/text.h"
#include "core/file/file_io.h"
#include "core/graph/sums_of_now.h"
#include "core/report/comparison.h"
#include "core/session/session.h"
#include "ui/cli/commands.h"
#include "ui/cli/interrupt.h"
#include "ui/cli/live_run.h"
#include "ui/cli/scene_loading.h"
#include "ui/cli/settle_watch.h"
#include "ui/cli/terminal.h"

namespace bl::cli {

namespace {

// Roundings of runs that end a little differently are no news.
constexpr double kLeastShare = 1e-6;
constexpr std::size_t kMostRows = 30;

std::shared_ptr<const State> outcome_of(const std::string& file, const SceneReading& reading, const CompareOptions& options) {
  auto session = Session::start(full_registry(), reading.scene, reading.state ? &*reading.state : nullptr, options.threads);
  if (!session) {
    print_error(file, session.error());
    return nullptr;
  }
  const long long most = options.ticks >= 0 ? options.ticks : options.max_ticks;
  SettleWatch watch;
  const StopScope scope(is_interrupted);
  LiveRun recordings(file, false, 0);
  Progress progress;
  std::shared_ptr<const State> before;
  for (long long done = 0; done < most && !is_interrupted(); ++done) {
    if (options.ticks < 0 && (*session)->state()->is_settled()) break;
    before = (*session)->state();
    recordings.before_tick(**session);
    if (!(*session)->tick()) break;
    if (progress.is_due()) progress.show(file + ": tick " + std::to_string((*session)->state()->tick));
    if (options.ticks < 0 && watch.is_hopeless(*(*session)->state())) break;
  }
  progress.clear();
  const auto state = most > 0 ? (*session)->state() : (*session)->look();
  print_line(file + ": " + (state->is_settled() ? "settled" : "not settled: " + why_not_settled(*state, before.get(), watch)) +
             ", tick " + std::to_string(state->tick) + ", hash " + hex_digits(state->hash));
  return std::make_shared<const State>(with_sums_of_now(*state));
}

void print_rows(const char* heading, const std::vector<report::IndicatorRow>& rows, std::size_t most) {
  if (rows.empty()) return;
  print_line();
  print_line(heading);
  TextTable table({{"node"}, {"indicator"}, {"first", true}, {"second", true}, {"difference", true}});
  for (std::size_t k = 0; k < std::min(rows.size(), most); ++k) {
    const report::IndicatorRow& row = rows[k];
    table.add({row.name.empty() ? "all" : row.name, row.label, row.first(), row.second(), row.difference()});
  }
  table.print();
  if (rows.size() > most) print_line("... and " + std::to_string(rows.size() - most) + " more; --report has them all");
}

void print_inputs(const report::Comparison& comparison) {
  print_line();
  print_line("Set differently:");
  for (const std::string& sentence : comparison.inputs) print_line("  " + sentence);
  for (const std::string& name : comparison.only_before) print_line("  " + name + ": only in the first");
  for (const std::string& name : comparison.only_after) print_line("  " + name + ": only in the second");
  if (comparison.inputs.empty() && comparison.only_before.empty() && comparison.only_after.empty()) print_line("  nothing");
}

// What a proposal is judged by comes first, then its volumes, then the rest.
void print_comparison(const report::Comparison& comparison) {
  std::vector<report::IndicatorRow> totals;
  std::copy_if(comparison.totals.begin(), comparison.totals.end(), std::back_inserter(totals),
               [](const report::IndicatorRow& row) { return row.is_seen(kLeastShare); });
  const bool is_same = totals.empty() && comparison.volumes.empty() && comparison.nodes.empty();
  if (!is_same || comparison.within_tolerance > 0) print_rows("Judged by:", comparison.first, comparison.first.size());
  if (!comparison.reasons_before.empty() || !comparison.reasons_after.empty()) {
    print_line();
    print_line("What holds back one of them only:");
  }
  for (const std::string& reason : comparison.reasons_before) print_line("  the first: " + reason);
  for (const std::string& reason : comparison.reasons_after) print_line("  the second: " + reason);
  print_rows("Volumes:", comparison.volumes, kMostRows);
  print_inputs(comparison);
  print_rows("Sums and means of all nodes:", totals, totals.size());
  print_rows("Other nodes:", comparison.nodes, kMostRows);
  print_line();
  if (is_same && comparison.within_tolerance == 0)
    return print_line("No difference: all " + std::to_string(comparison.same) + " numbers of nodes in both are the same.");
  const std::size_t others = comparison.volumes.size() + comparison.nodes.size();
  print_line((others == 0 ? "No number of a node differs by more than the tolerance; "
                          : std::to_string(others) + " numbers of nodes differ; ") +
             report::told_of_same(comparison));
}

}  // namespace

int compare_command(const CompareOptions& options) {
  catch_interrupts();
  // Both are read before either runs: a name that is wrong is said at once.
  const auto first = load_scene(options.first), second = load_scene(options.second);
  if (!first || !second) return kBadInput;
  const auto before = outcome_of(options.first, *first, options);
  if (!before) return kBadInput;
  const auto after = outcome_of(options.second, *second, options);
  if (!after) return kBadInput;
  if (is_interrupted()) print_line("stopped: both scenes are compared in their present state, settled or not", Colour::red);
  const report::Comparison comparison = report::compare(*before, *after, kLeastShare);
  print_comparison(comparison);
  if (options.report.empty()) return is_interrupted() ? interrupt_exit_code() : kDone;
  const auto name = [](const std::string& file) { return std::filesystem::path(file).stem().string(); };
  const std::string page = report::comparison_page(*before, *after, comparison, name(options.first), name(options.second));
  if (auto written = write_file(options.report, page); !written) {
    print_error(options.report, written.error());
    return kBadInput;
  }
  print_line("written: " + options.report);
  return is_interrupted() ? interrupt_exit_code() : kDone;
}

}  // namespace bl::cli
