// `erase`: takes a person out of a session file.
#include <chrono>

#include "core/base/plural.h"
#include "core/journal/journal.h"
#include "ui/cli/commands.h"
#include "ui/cli/terminal.h"

namespace bl::cli {

int erase_command(const EraseOptions& options) {
  const auto since = std::chrono::system_clock::now().time_since_epoch();
  journal::Journal::Options how;
  how.opened_at = std::chrono::duration_cast<std::chrono::milliseconds>(since).count();
  const auto opened = journal::Journal::open(options.session, full_registry(), how);
  if (!opened) {
    print_error(options.session, opened.error());
    return kBadInput;
  }
  const auto erased = (*opened)->erase(options.seat);
  if (!erased) {
    print_error(options.session, erased.error());
    return kBadInput;
  }
  if (auto closed = (*opened)->close(); !closed) {
    print_error(options.session, closed.error());
    return kBadInput;
  }
  print_line("seat " + std::to_string(options.seat) + ": erased " + how_many(erased->persons, "name") + ", " +
             how_many(erased->texts, "text") + ", " + how_many(erased->tokens, "token") + " and " +
             how_many(erased->refusals, "answer that named the person", "answers that named the person"));
  return kDone;
}

}  // namespace bl::cli
