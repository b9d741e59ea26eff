// Connects again and again. Each connection begins with a whole copy, so nothing has to be known of what was missed.
#include "core/serve/second.h"

#include <condition_variable>
#include <mutex>
#include <optional>

#include <nlohmann/json.hpp>

#include "core/journal/copy.h"
#include "core/journal/packed.h"
#include "core/serve/client.h"
#include "core/serve/following.h"
#include "core/serve/guest.h"
#include "core/wire/base64.h"
#include "core/wire/messages.h"
#include "core/wire/operations.h"

namespace bl::serve {

namespace {

constexpr double kBetweenTries = 1, kBetweenLooks = 0.1, kBetweenSentences = 30;  // [s]

class Second {
 public:
  Second(const SecondOptions& options, std::unique_ptr<journal::Copy> copy) : options_(options), copy_(std::move(copy)) {}

  Result<SecondEnd> run() {
    heard_ = options_.clock->now();
    connect();
    while (true) {
      wait();
      if (auto done = read(); !done) return done.error();
      if (options_.is_over()) return SecondEnd::over;
      if (options_.is_told_to_take_over() || is_due()) {
        if (is_connected()) options_.say("The first laptop is there: stop the room on it before this one takes over.");
        else if (!copy_->is_of_use()) options_.say("There is no whole copy of the room yet: it cannot be taken over.");
        else return take_over();
      }
      if (is_connected()) continue;
      const double now = options_.clock->now();
      if (now - told_ >= kBetweenSentences) {
        told_ = now;
        options_.say("The first laptop has been away for " + std::to_string(static_cast<int>(now - heard_)) + " s.");
      }
      if (!client_ && now >= try_at_) connect();
    }
  }

 private:
  bool is_connected() const { return client_ && is_following_; }

  // Whoever said goodbye in order may come back; then only people decide.
  bool is_due() const {
    return options_.take_over_after > 0 && has_followed_ && !is_connected() && !has_said_goodbye_ &&
           options_.clock->now() - heard_ >= options_.take_over_after;
  }

  Result<SecondEnd> take_over() {
    client_.reset();
    if (auto closed = copy_->close(); !closed) return closed.error();
    return SecondEnd::takes_over;
  }

  void connect() {
    is_following_ = false;
    packed_.clear();
    last_ = -1;
    client_.emplace(
        options_.first,
        [this] {
          const std::lock_guard lock(mutex_);
          has_news_ = true;
          wake_.notify_all();
        },
        options_.authorities);
    wire::Hello hello;
    hello.room = options_.first.code;
    hello.run = "second laptop";
    hello.kind = "follower";
    hello.token = options_.token;
    client_->send(wire::write_message(hello));
    client_->send(wire::write_message(Follow{options_.is_safe, options_.address}));
  }

  void wait() {
    std::unique_lock lock(mutex_);
    if (!has_news_) options_.clock->wait(wake_, lock, options_.clock->now() + kBetweenLooks);
    has_news_ = false;
  }

  Result<void> read() {
    if (!client_) return {};
    std::int64_t kept = -1;
    for (Happening& happening : client_->take()) {
      if (const auto* closed = std::get_if<Closed>(&happening)) return lose(*closed);
      const auto* arrived = std::get_if<Arrived>(&happening);
      if (arrived == nullptr) continue;
      const auto stored = hear(arrived->frame);
      if (!stored) {
        if (stored.error().code != ErrorCode::parse && stored.error().code != ErrorCode::conflict) return stored.error();
        if (!copy_->is_of_use()) return stored.error();
        options_.say(stored.error().text() + "; the copy begins anew.");
        return again();
      }
      kept = std::max(kept, *stored);
    }
    // One word for all of them.
    if (kept >= 0) client_->send(wire::write_message(Kept{kept}));
    return {};
  }

  // The number up to which all is stored now; -1 where nothing was.
  Result<std::int64_t> hear(const std::string& text) {
    const auto frame = wire::read_frame(text);
    if (!frame) return frame.error();
    const std::string t = (*frame)["t"].get<std::string>();
    if (t == "copy") {
      const auto part = wire::read_message<CopyPart>(*frame);
      if (!part) return part.error();
      const auto bytes = wire::bytes_of_base64(part->part);
      if (!bytes) return bytes.error();
      packed_ += *bytes;
      return part->is_last ? take(*part) : Result<std::int64_t>(-1);
    }
    if (t != "changes") return -1;
    const auto changes = wire::read_message<Changes>(*frame);
    if (!changes) return changes.error();
    if (!is_following_ || changes->n != last_ + 1) return Error{ErrorCode::conflict, options_.path, "a change is missing"};
    const auto bytes = wire::bytes_of_base64(changes->bytes);
    if (!bytes) return bytes.error();
    if (auto repeated = copy_->repeat(*bytes); !repeated) return repeated.error();
    return last_ = changes->n;
  }

  Result<std::int64_t> take(const CopyPart& last) {
    const auto bytes = journal::unpack({std::exchange(packed_, {}), last.size, last.digest});
    if (!bytes) return bytes.error();
    if (auto taken = copy_->take(*bytes); !taken) {
      // Another room in this file, say: trying again would not help.
      return Error{ErrorCode::io, taken.error().place, taken.error().message};
    }
    is_following_ = has_followed_ = true;
    has_said_goodbye_ = false;
    told_ = 0;
    options_.say("This laptop follows room " + options_.first.code + ": all of it is in " + options_.path + ".");
    return last_ = last.n;
  }

  Result<void> again() {
    client_.reset();
    try_at_ = options_.clock->now() + kBetweenTries;
    return {};
  }

  Result<void> lose(const Closed& closed) {
    if (closed.code == static_cast<int>(CloseCode::no_seat) && !has_followed_)
      return Error{ErrorCode::conflict, options_.first.host_and_port(), closed.why};
    const bool was_following = is_connected();
    const bool is_refused = closed.code == static_cast<int>(CloseCode::no_seat);
    if (was_following || is_refused) heard_ = options_.clock->now();  // whoever refuses is there
    has_said_goodbye_ = has_said_goodbye_ || (was_following && closed.code == static_cast<int>(CloseCode::draining));
    if (was_following || told_ == 0) {
      told_ = options_.clock->now();
      if (is_refused) {
        options_.say("The first laptop refuses this one (" + closed.why +
                     "). Start this one again with the key that the first has printed.");
        return again();
      }
      options_.say("The first laptop is away (" + closed.why + "). This one goes on trying.");
      if (copy_->is_of_use())
        options_.say("To go on with the room here: switch the first laptop off, then press Enter, or send SIGUSR1.");
    }
    return again();
  }

  const SecondOptions& options_;
  std::unique_ptr<journal::Copy> copy_;
  std::mutex mutex_;
  std::condition_variable wake_;
  bool has_news_ = false;
  std::string packed_;
  std::int64_t last_ = -1;
  bool is_following_ = false, has_followed_ = false, has_said_goodbye_ = false;
  double heard_ = 0, try_at_ = 0, told_ = 0;
  std::optional<Client> client_;  // last: it wakes the rest
};

}  // namespace

Result<SecondEnd> follow(const SecondOptions& options) {
  auto copy = journal::Copy::open(options.path, options.opened_at);
  if (!copy) return copy.error();
  return Second(options, std::move(*copy)).run();
}

}  // namespace bl::serve
