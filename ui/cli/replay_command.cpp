// `replay`: runs a log again and compares every hash that it holds.
#include "core/file/file_io.h"
#include "core/session/session.h"
#include "ui/cli/commands.h"
#include "ui/cli/scene_loading.h"
#include "ui/cli/terminal.h"

namespace bl::cli {

int replay_command(const ReplayOptions& options) {
  const auto text = read_file(options.log);
  if (!text) {
    print_error(options.log, text.error());
    return kBadInput;
  }
  const auto log = read_log(*text, full_registry());
  if (!log) {
    print_error(options.log, log.error());
    return kBadInput;
  }
  if (log->is_cut_off)
    print_error(options.log, {ErrorCode::parse, "", "warning: the last line is incomplete, as after a crash; it is left out"});
  if (!log->has_end)
    print_error(options.log,
                {ErrorCode::parse, "",
                 "warning: the log has no end: it was cut off, or its program was stopped. What was done after tick " +
                     std::to_string(log->last_tick) + " is not in it"});
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
