// `rehearse`: many bots in one room over the network, and figures of how the room answers them.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <condition_variable>
#include <cstdio>
#include <memory>
#include <mutex>
#include <optional>

#include "core/room/secrets.h"
#include "core/serve/client.h"
#include "core/serve/readiness.h"
#include "ui/cli/commands.h"
#include "ui/cli/finding_lines.h"
#include "ui/cli/interrupt.h"
#include "ui/cli/rehearsal_bot.h"
#include "ui/cli/terminal.h"

namespace bl::cli {

namespace {

// Phones come one after the other. A connection that ends is made again, but where the room said that it is useless. [s]
constexpr double kBetweenArrivals = 0.03, kRetry = 1, kComingIn = 15, kLastAnswers = 10, kLastScreens = 2, kBetweenLines = 1;
constexpr double kMostOf = 0.95;
constexpr int kBadFrame = 4400, kNoSeat = 4401, kRemoved = 4403, kReplaced = 4409;

class Bell {
 public:
  void ring() {
    const std::lock_guard lock(mutex_);
    has_rung_ = true;
    wake_.notify_one();
  }
  void wait() {
    std::unique_lock lock(mutex_);
    wake_.wait_for(lock, std::chrono::milliseconds(20), [this] { return has_rung_; });
    has_rung_ = false;
  }

 private:
  std::mutex mutex_;
  std::condition_variable wake_;
  bool has_rung_ = false;
};

// A bot with its connection.
struct Attendant {
  std::unique_ptr<RehearsalBot> bot;
  std::unique_ptr<serve::Client> client;  // none: it waits for its next attempt
  bool has_come = false;
  double connect_at = 0;
  std::string end;  // why there is no further attempt
};

class Rehearsal {
 public:
  Rehearsal(serve::RoomAddress address, const RehearseOptions& options) : address_(std::move(address)), options_(&options) {}

  /// The exit code.
  int run() {
    complain("What the bots say stays in the room: rehearse in a room that is thrown away, such as one with another --journal.");
    if (!begin()) return is_interrupted() ? interrupt_exit_code() : kNotMet;
    print_line(lead_ == nullptr ? std::to_string(bots_.size()) + " bots take part."
                                : "One bot is the facilitator, and " + std::to_string(bots_.size() - 1) + " take part.");
    const double began = now();
    turn_until(
        [&] {
          tell_progress(now() - began);
          return now() - began >= options_->seconds;
        },
        false);
    if (lead_ != nullptr) lead_->bot->close_votes(now());
    const double over = now(), seconds = over - began;
    turn_until([&] { return unanswered() == 0 || now() - over > kLastAnswers; }, true);
    const double answered = now();
    turn_until([&] { return screens().second == 0 || now() - answered > kLastScreens; }, true);
    return tell(seconds);
  }

 private:
  void add(const std::string& invite) {
    const auto number = static_cast<std::uint64_t>(bots_.size());
    Attendant& one = bots_.emplace_back();
    one.bot = std::make_unique<RehearsalBot>(address_.code, invite, room::hex_of(room::system_random_bytes(16)),
                                             Random(static_cast<std::uint64_t>(options_->seed), number), tallies_);
    one.connect_at = now() + kBetweenArrivals * static_cast<double>(number);
  }

  // The first comes by the key, which says whose key it is; then all others come.
  bool begin() {
    const auto have_come = [&] {
      return std::all_of(bots_.begin(), bots_.end(), [](const Attendant& one) { return one.has_come || !one.end.empty(); });
    };
    std::string invite = address_.invite;
    if (!invite.empty()) {
      add(invite);
      wait_for_arrivals(have_come);
      if (!bots_.front().has_come) return complain_of_absence();
      if (bots_.front().bot->role() == "facilitator") {
        has_lead_ = true;
        invite.clear();
      }
    }
    while (bots_.size() < static_cast<std::size_t>(options_->bots) + (has_lead_ ? 1 : 0)) add(invite);
    wait_for_arrivals(have_come);
    std::set<std::int64_t> seats;
    for (const Attendant& one : bots_)
      if (one.has_come && &one != &bots_.front()) seats.insert(one.bot->seat());
    if (has_lead_) {
      lead_ = &bots_.front();
      lead_->bot->lead(std::move(seats));
    }
    return std::any_of(bots_.begin(), bots_.end(), [](const Attendant& one) { return one.has_come; }) || complain_of_absence();
  }

  bool complain_of_absence() const {
    const std::string& why = bots_.front().end.empty() ? last_end_ : bots_.front().end;
    complain("No bot came into the room" + (why.empty() ? "." : ": " + why + "."));
    return false;
  }

  template <class IsOver>
  void wait_for_arrivals(const IsOver& have_come) {
    const double began = now();
    turn_until([&] { return have_come() || now() - began > kComingIn; }, true);
  }

  template <class IsOver>
  void turn_until(const IsOver& is_over, bool is_quiet) {
    while (!is_over() && !is_interrupted()) {
      for (Attendant& one : bots_) turn(one, is_quiet);
      bell_.wait();
    }
  }

  void turn(Attendant& one, bool is_quiet) {
    if (!one.client && one.end.empty() && now() >= one.connect_at) {
      one.client = std::make_unique<serve::Client>(
          address_, [this] { bell_.ring(); }, options_->trust, serve::ConnectsAs::page);
      one.client->send(one.bot->hello());
    }
    if (!one.client) return;
    for (const serve::Happening& happening : one.client->take()) {
      if (const auto* arrived = std::get_if<serve::Arrived>(&happening)) one.bot->hear(arrived->frame, now());
      else if (const auto* closed = std::get_if<serve::Closed>(&happening)) return lose(one, *closed);
    }
    one.has_come = one.has_come || one.bot->is_welcome();
    for (std::string& frame : one.bot->say(now(), is_quiet)) one.client->send(std::move(frame));
  }

  void lose(Attendant& one, const serve::Closed& closed) {
    if (one.bot->is_welcome()) ++lost_;
    one.bot->lose();
    one.client.reset();
    one.connect_at = now() + kRetry;
    last_end_ = closed.why;
    const bool is_final =
        closed.code == kBadFrame || closed.code == kNoSeat || closed.code == kRemoved || closed.code == kReplaced;
    if (is_final) one.end = closed.why;
  }

  std::size_t unanswered() const {
    std::size_t sum = 0;
    for (const Attendant& one : bots_) sum += one.bot->waiting();
    return sum;
  }

  void tell_progress(double seconds);
  std::pair<std::vector<double>, std::int64_t> screens() const;
  int tell(double seconds) const;
  void print_answers() const;

  serve::RoomAddress address_;
  const RehearseOptions* options_;
  RehearsalTallies tallies_;
  std::string last_end_;
  int lost_ = 0;
  double line_at_ = 0;
  bool has_lead_ = false;
  Bell bell_;
  std::vector<Attendant> bots_;  // after what their threads use
  Attendant* lead_ = nullptr;
};

// The smallest value that so many of them do not exceed.
double quantile(std::vector<double> values, double part) {
  std::sort(values.begin(), values.end());
  const auto rank = static_cast<std::size_t>(std::ceil(part * static_cast<double>(values.size())));
  return values[std::max<std::size_t>(rank, 1) - 1];
}

std::string decimals(double value, int count) {
  char text[32];
  std::snprintf(text, sizeof text, "%.*f", count, value);
  return text;
}

void Rehearsal::print_answers() const {
  TextTable table(
      {{"kind"}, {"said", true}, {"answered", true}, {"refused", true}, {"p50 ms", true}, {"p95 ms", true}, {"reasons"}});
  for (const auto& [kind, tally] : tallies_) {
    std::int64_t refused = 0;
    std::string reasons;
    for (const auto& [why, count] : tally.refused) {
      refused += count;
      reasons += (reasons.empty() ? "" : ", ") + why + " " + std::to_string(count);
    }
    const auto time = [&](double part) {
      return tally.answers.empty() ? "-" : decimals(1000 * quantile(tally.answers, part), 0);
    };
    table.add({kind, std::to_string(tally.said), std::to_string(tally.answers.size()), std::to_string(refused), time(0.5),
               time(0.95), reasons});
  }
  table.print();
}

// A line each second, for programs that wait for the end.
void Rehearsal::tell_progress(double seconds) {
  if (!options_->shows_progress || seconds < line_at_) return;
  line_at_ = seconds + kBetweenLines;
  std::int64_t said = 0;
  for (const auto& [kind, tally] : tallies_) said += tally.said;
  print_line("progress: " + decimals(seconds, 0) + " of " + decimals(options_->seconds, 0) + " s, " + std::to_string(said) +
             " operations, " + std::to_string(unanswered()) + " without an answer");
  std::fflush(stdout);  // whoever reads it waits
}

// How long each stored comment and proposal took to be on all screens, and how many are missing on some. A bot that is away has
// none.
std::pair<std::vector<double>, std::int64_t> Rehearsal::screens() const {
  std::vector<double> times;
  std::int64_t missing = 0;
  for (const Attendant& author : bots_)
    for (const auto& [name, told] : author.bot->told()) {
      if (!told.is_stored) continue;
      double last = told.said;
      bool is_everywhere = true;
      for (const Attendant& one : bots_) {
        if (!one.bot->is_welcome()) continue;
        const auto seen = one.bot->seen().find(name);
        if (seen == one.bot->seen().end()) is_everywhere = false;
        else last = std::max(last, seen->second);
      }
      if (is_everywhere) times.push_back(last - told.said);
      else ++missing;
    }
  return {std::move(times), missing};
}

int Rehearsal::tell(double seconds) const {
  print_answers();
  serve::Rehearsed figures{.bots = bots_.size(), .lost_connections = lost_};
  std::size_t bytes = 0, with_card = 0;
  double silence = 0;
  for (const Attendant& one : bots_) {
    figures.came += one.has_come ? 1 : 0;
    figures.doubled += one.bot->doubled();
    bytes += one.bot->bytes();
    with_card += one.bot->has_card() ? 1 : 0;
    silence = std::max(silence, one.bot->longest_silence(now()));
  }
  figures.why_absent = last_end_;
  std::vector<double> answers;
  for (const auto& [kind, tally] : tallies_) {
    figures.said += tally.said;
    for (const auto& [why, count] : tally.refused) figures.refused += count;
    answers.insert(answers.end(), tally.answers.begin(), tally.answers.end());
  }
  figures.unanswered = static_cast<std::int64_t>(unanswered());
  const auto [times, missing] = screens();
  figures.lost = missing;
  figures.told = missing + static_cast<std::int64_t>(times.size());
  if (!answers.empty()) figures.answers = quantile(std::move(answers), kMostOf);
  if (!times.empty()) figures.screens = quantile(times, kMostOf);
  print_line("The longest silence of the room was " + decimals(silence, 1) + " s. Each bot was sent " +
             decimals(static_cast<double>(bytes) / 1000 / seconds / static_cast<double>(figures.came), 1) + " kB a second.");
  if (with_card == 0)
    print_line("No bot had a role card, so none moved or proposed anything." +
               std::string(has_lead_ ? " The scene has none." : " With the facilitator's key, the cards are dealt out."));
  const bool is_bad = print_findings(serve::judge_rehearsal(figures));
  if (is_interrupted()) return interrupt_exit_code();
  return is_bad ? kNotMet : kDone;
}

}  // namespace

int rehearse_command(const RehearseOptions& options) {
  auto address = serve::room_address(options.room);
  if (!address) {
    print_error("rehearse", address.error());
    return kBadInput;
  }
  catch_interrupts();
  return Rehearsal(std::move(*address), options).run();
}

}  // namespace bl::cli
