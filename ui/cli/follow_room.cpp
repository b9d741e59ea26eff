// `serve --follow`: the second laptop, until it takes over.
#include <poll.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <csignal>

#include "core/serve/second.h"
#include "ui/cli/commands.h"
#include "ui/cli/interrupt.h"
#include "ui/cli/own_addresses.h"
#include "ui/cli/terminal.h"

namespace bl::cli {

namespace {

std::atomic<bool> is_told{false};
static_assert(std::atomic<bool>::is_always_lock_free);

void remember_takeover(int) { is_told = true; }

void catch_takeover() {
  struct sigaction action {};
  action.sa_handler = remember_takeover;
  sigemptyset(&action.sa_mask);
  action.sa_flags = SA_RESTART;
  sigaction(SIGUSR1, &action, nullptr);
}

// Enter on the terminal. What is no terminal says nothing.
bool has_entered_a_line() {
  pollfd in{.fd = STDIN_FILENO, .events = POLLIN, .revents = 0};
  if (isatty(STDIN_FILENO) == 0 || ::poll(&in, 1, 0) != 1 || (in.revents & POLLIN) == 0) return false;
  char buffer[256];
  return ::read(STDIN_FILENO, buffer, sizeof buffer) > 0;
}

}  // namespace

std::optional<int> follow_room(ServeOptions& options) {
  const auto first = serve::room_address(options.follow);
  if (!first) {
    print_error("--follow", first.error());
    return kBadInput;
  }
  if (options.journal.empty() || options.token.empty()) {
    print_error("--follow", {ErrorCode::missing, "", "expects --token KEY and --journal FILE"});
    return kBadInput;
  }
  using namespace std::chrono;
  serve::SecondOptions second;
  second.first = *first;
  second.token = options.token;
  second.path = options.journal;
  if (options.port != 0) second.address = own_addresses(options, options.port).front();
  second.authorities = options.trust;
  second.is_safe = options.is_safe;
  second.take_over_after = options.take_over;
  second.opened_at = duration_cast<milliseconds>(system_clock::now().time_since_epoch()).count();
  second.is_over = is_interrupted;
  second.is_told_to_take_over = [] { return has_entered_a_line() || is_told.exchange(false); };
  second.say = [](const std::string& sentence) { complain(sentence); };
  catch_interrupts();
  catch_takeover();
  if (!first->is_secure) complain("Without a certificate everybody in this network can read what this laptop is sent.");
  const auto end = serve::follow(second);
  if (!end) {
    print_error(options.follow, end.error());
    return kBadInput;
  }
  if (*end == serve::SecondEnd::over) return kDone;
  complain("This laptop takes the room over.");
  options.sources = {options.journal};
  return std::nullopt;
}

}  // namespace bl::cli
