// `minutes`: writes the minutes of a session file into a folder.
#include "core/base/moment.h"
#include "core/base/plural.h"
#include "core/journal/journal.h"
#include "core/minutes/minutes.h"
#include "ui/cli/commands.h"
#include "ui/cli/terminal.h"

namespace bl::cli {

namespace {

Result<minutes::Account> account_of_file(const std::string& path) {
  const auto journal = journal::Journal::open_to_read(path, full_registry());
  if (!journal) return journal.error();
  const auto all = (*journal)->load();
  if (!all) return all.error();
  // Damage has the file as its place already.
  if (!all->damage.empty()) return all->damage.front();
  auto account = minutes::account_of((*journal)->room(), *all, full_registry());
  if (!account) return account.error().within(path);
  return account;
}

}  // namespace

int minutes_command(const MinutesOptions& options) {
  auto account = account_of_file(options.session);
  if (!account) {
    print_error(options.session, account.error());
    return kBadInput;
  }
  account->zone = read_zone(options.zone).value_or(0);  // the command line has been checked
  const auto written = minutes::write_minutes(options.out, *account);
  if (!written) {
    print_error(options.out, written.error());
    return kBadInput;
  }
  print_line(how_many(account->entries, "entry", "entries") + ", log hash " + (account->chain.empty() ? "none" : account->chain));
  print_line(how_many(*written, "file") + " written into " + options.out);
  return kDone;
}

}  // namespace bl::cli
