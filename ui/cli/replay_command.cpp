// `replay`: runs a log or a stored session again and compares every hash that it holds.
#include <optional>

#include "core/file/file_io.h"
#include "core/journal/export.h"
#include "core/journal/journal.h"
#include "core/session/session.h"
#include "ui/cli/commands.h"
#include "ui/cli/scene_loading.h"
#include "ui/cli/terminal.h"

namespace bl::cli {

namespace {

void warn(const std::string& file, const std::string& sentence) {
  print_error(file, {ErrorCode::parse, "", "warning: " + sentence});
}

Result<LogFile> log_of_text(const std::string& path, const std::string& text) {
  auto log = read_log(text, full_registry());
  if (!log) return log;
  if (log->is_cut_off) warn(path, "the last line is incomplete, as after a crash; it is left out");
  if (!log->has_end)
    warn(path, "the log has no end: it was cut off, or its program was stopped. What was done after tick " +
                   std::to_string(log->last_tick) + " is not in it");
  return log;
}

Result<LogFile> log_of_session(const std::string& path) {
  const auto journal = journal::Journal::open_to_read(path, full_registry());
  if (!journal) return journal.error();
  const auto all = (*journal)->load();
  if (!all) return all.error();
  if (!all->damage.empty()) return all->damage.front();
  for (const Error& error : all->unusable_snapshots) warn(path, error.text());
  auto log = read_log(journal::log_text((*journal)->room(), *all, full_registry()), full_registry());
  if (!log) return log.error().within("as a log");
  if (!log->has_end)
    warn(path, "no hash was stored after the last entry, as after a crash: how the session ended is not compared");
  return log;
}

}  // namespace

int replay_command(const ReplayOptions& options) {
  const auto text = read_file(options.log);
  if (!text) {
    print_error(options.log, text.error());
    return kBadInput;
  }
  // As every file of SQLite begins.
  const auto log = text->starts_with("SQLite format 3") ? log_of_session(options.log) : log_of_text(options.log, *text);
  if (!log) {
    print_error(options.log, log.error());
    return kBadInput;
  }
  const auto report = replay(*log, full_registry(), options.threads);
  if (!report) {
    print_error(options.log, report.error());
    return kBadInput;
  }
  print_line(std::to_string(report->entries) + (report->entries == 1 ? " entry" : " entries") + ", " +
             std::to_string(report->ticks) + " ticks, hash " + report->hash);
  if (report->first_mismatch) {
    print_line("differs from the log first at tick " + std::to_string(report->first_mismatch->tick) + ": the log has the hash " +
                   report->first_mismatch->hash,
               Colour::red);
    return kNotMet;
  }
  if (report->checks == 0) print_line("the log holds no hashes to compare with");
  else if (report->incomparable > 0)
    print_line("the hashes of the log are of scheme " + std::to_string(log->hash_scheme) +
                   " and cannot be compared with those of this "
                   "program, which are of scheme " +
                   std::to_string(kHashScheme),
               Colour::yellow);
  else print_line("agrees with all " + std::to_string(report->checks) + " checks", Colour::green);
  return kDone;
}

}  // namespace bl::cli
