// `import`: adds the surroundings of a site to a scene, and reports the result for every element.
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <optional>
#include <system_error>
#include <thread>

#include "core/base/printable.h"
#include "core/file/file_io.h"
#include "core/session/ledger.h"
#include "ui/cli/commands.h"
#include "ui/cli/interrupt.h"
#include "ui/cli/scene_loading.h"
#include "ui/cli/terminal.h"

namespace bl::cli {

namespace {

void print_counts(const making::ImportedScene& imported) {
  for (const auto& [file, report] : imported.reports) {
    if (report.total("file") > 0) continue;  // it could not be read, which is told as an error
    print_line(file, Colour::bold);
    TextTable table({{"outcome"}, {"kind"}, {"number", true}, {"what it is, or why not"}});
    for (const auto& [key, number] : report.counts()) {
      const auto& [outcome, kind, reason] = key;
      const Colour colour = outcome == importing::ImportOutcome::taken      ? Colour::plain
                            : outcome == importing::ImportOutcome::repaired ? Colour::yellow
                                                                            : Colour::dim;
      table.add({std::string(name_of(outcome)), kind, std::to_string(number), reason}, colour);
    }
    table.print();
    print_line("total: " + std::to_string(report.count(importing::ImportOutcome::taken)) + " taken, " +
               std::to_string(report.count(importing::ImportOutcome::repaired)) + " repaired, " +
               std::to_string(report.count(importing::ImportOutcome::skipped)) + " skipped of " +
               counted(report.total(), "element"));
  }
}

bool is_there(const std::string& file) {
  struct stat status {};
  return ::stat(file.c_str(), &status) == 0;
}

// Shows on a terminal how far an import is, and has Ctrl-C end it between two elements. Without a thread to be had it is silent.
class ImportDisplay {
 public:
  ImportDisplay(const std::vector<std::string>& files, importing::ImportWatch& watch) : files_(files), watch_(watch) {
    catch_interrupts();
    try {
      thread_ = std::thread([this] { run(); });
    } catch (const std::system_error&) {}
  }
  ~ImportDisplay() { end(); }
  ImportDisplay(const ImportDisplay&) = delete;
  ImportDisplay& operator=(const ImportDisplay&) = delete;

  void end() {
    is_over_ = true;
    if (thread_.joinable()) thread_.join();
  }
  /// While a person is asked a question.
  void pause(bool is_paused) {
    is_paused_ = is_paused;
    if (is_paused) std::this_thread::sleep_for(3 * kLook);
  }

 private:
  static constexpr std::chrono::milliseconds kLook{50};

  void run() {
    Progress progress;
    const bool is_terminal = ::isatty(STDERR_FILENO) == 1;
    while (!is_over_) {
      std::this_thread::sleep_for(kLook);
      if (is_interrupted()) watch_.is_stopped = true;
      if (is_paused_) progress.clear();
      else if (is_terminal && progress.is_due()) progress.show(line());
    }
  }

  std::string line() const {
    const std::size_t file = std::min<std::size_t>(watch_.file, files_.size() - 1), done = watch_.done, total = watch_.total;
    std::string text = files_[file] + ": " + watch_.step.load();
    if (done > 0) text += " " + std::to_string(done);
    return total > 0 ? text + " of " + std::to_string(total) : text;
  }

  const std::vector<std::string>& files_;
  importing::ImportWatch& watch_;
  std::atomic<bool> is_over_{false}, is_paused_{false};
  std::thread thread_;
};

// Waits until there is something to read, or somebody has pressed Ctrl-C: a read that waits would begin again after the signal.
bool is_answered() {
  constexpr int kLookEvery = 100;  // [ms]
  struct pollfd line {
    STDIN_FILENO, POLLIN, 0
  };
  while (!is_interrupted())
    if (::poll(&line, 1, kLookEvery) > 0) return true;
  std::fputc('\n', stderr);
  return false;
}

// Asks on the terminal what becomes of buildings that stand inside a site.
bool asks_to_clear(std::size_t buildings, const std::string& site) {
  std::fflush(stdout);
  std::fprintf(stderr, "%s\n",
               printable(counted(buildings, "building") + (buildings == 1 ? " stands" : " stand") + " inside the site `" + site +
                         "`. Keep " + (buildings == 1 ? "it" : "them") + ", so that nothing is built there, or clear the site?")
                   .c_str());
  std::fputs("keep / clear [keep]: ", stderr);
  std::fflush(stderr);
  char answer[16] = "";
  if (!is_answered() || std::fgets(answer, sizeof answer, stdin) == nullptr) return false;
  return answer[0] == 'c' || answer[0] == 'C';
}

// An old report must not stand for an import that failed.
bool write_import_report(const making::ImportOptions& options, const importing::ImportReports& reports) {
  if (options.report.empty()) return true;
  auto written = write_file(options.report, import_csv(reports));
  if (!written) print_error(options.report, written.error());
  return written.ok();
}

// Why none of the files was imported, in a row for each.
bool write_refusal(const making::ImportOptions& options, const std::string& why) {
  importing::ImportReports nothing;
  for (const std::string& file : options.files)
    nothing.emplace_back(file, importing::ImportReport()).second.skip("file", "", why);
  return write_import_report(options, nothing);
}

// Pictures alone: as `place` does it.
int import_pictures(const making::ImportOptions& options) {
  if (options.into.empty()) {
    complain("pictures are added to a scene: name the scene by --into");
    return kBadInput;
  }
  PlaceOptions place;
  place.files = options.files;
  place.into = options.into;
  place.out = options.out;
  place.is_forced = options.is_forced;
  place.media.licence = options.licence;
  return place_command(place);
}

// Writes the scene with all that was imported, and says what that is.
int write_imported(const making::ImportOptions& options, const making::ImportedScene& imported,
                   const std::vector<Problem>& problems, const std::string& text) {
  print_problems(options.out, problems);
  if (auto written = write_file(options.out, text); !written) {
    print_error(options.out, written.error());
    return kBadInput;
  }
  std::string made;
  for (const auto& [type, number] : imported.nodes) made += (made.empty() ? "" : ", ") + std::to_string(number) + " " + type;
  print_line("wrote " + options.out + ": " + (made.empty() ? "no new nodes" : "new nodes: " + made) + "; " +
             counted(imported.scene->nodes.size(), "node") + " in all");
  return kDone;
}

}  // namespace

int import_command(const making::ImportOptions& given) {
  if (std::all_of(given.files.begin(), given.files.end(), making::is_picture_name)) return import_pictures(given);
  making::ImportOptions options = given;
  if (options.keeps && options.clears) {
    complain("--keep and --clear contradict each other: choose one.");
    return kBadInput;
  }
  if (options.keeps || options.clears) options.inside = options.clears ? making::InsideChoice::clear : making::InsideChoice::keep;
  const Registry& registry = full_registry();
  Scene scene;
  if (!options.into.empty()) {
    auto reading = load_scene(options.into);
    if (!reading) {
      (void)write_refusal(options, "the scene to add to cannot be read");
      return kBadInput;
    }
    scene = std::move(reading->scene);
  }
  if (!options.is_forced && is_there(options.out)) {
    // Nothing is imported: accounts of what would have been are easily taken for done.
    print_error(options.out, {ErrorCode::conflict, "", "exists already; choose another name, or replace it with --force"});
    (void)write_refusal(options, "the scene to write exists already");
    return kBadInput;
  }
  importing::ImportWatch watch;
  options.context.watch = &watch;
  std::optional<ImportDisplay> display(std::in_place, options.files, watch);
  if (::isatty(STDIN_FILENO) == 1 && ::isatty(STDERR_FILENO) == 1)
    options.ask_to_clear = [&display, &watch](std::size_t buildings, const std::string& site) {
      display->pause(true);
      const bool is_clearing = asks_to_clear(buildings, site);
      if (is_interrupted()) watch.is_stopped = true;
      display->pause(false);
      return is_clearing;
    };
  const making::ImportedScene imported = making::import_context(scene, options, registry);
  std::vector<Problem> problems;
  std::string text;
  if (imported.scene) {
    (void)goes_on(&watch, "checking the scene", 0, 0);
    problems = check_scene(*imported.scene, registry);
    (void)goes_on(&watch, "writing the scene", 0, 0);
    text = write_scene(*imported.scene, registry);
  }
  display.reset();
  print_counts(imported);
  for (const std::string& note : imported.notes) print_line("note: " + note);
  for (const std::string& warning : imported.warnings) print_line("warning: " + warning, Colour::yellow);
  for (const auto& [file, error] : imported.errors) print_error(file, error);
  if (!write_import_report(options, imported.reports)) return kBadInput;
  if (is_interrupted()) return interrupt_exit_code();
  if (!imported.scene) return kBadInput;
  return write_imported(options, imported, problems, text);
}

}  // namespace bl::cli
