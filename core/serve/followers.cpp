// The copy and the changes come from the disk's thread in their order, so a copy has exactly the changes before it.
#include "core/serve/followers.h"

#include <algorithm>

#include <nlohmann/json.hpp>

#include "core/serve/following.h"
#include "core/serve/gate.h"
#include "core/serve/room_frames.h"
#include "core/wire/base64.h"
#include "core/wire/operations.h"

namespace bl::serve {

namespace {

constexpr std::size_t kPart = 96 << 10;          // of a copy, before it becomes text [bytes]
constexpr std::size_t kUnsentMost = 512 << 10;   // so much is on its way at once [bytes]
constexpr std::size_t kWaitingMost = 64u << 20;  // who is behind by more begins anew [bytes]

}  // namespace

Followers::Followers(journal::Writer& writer, OnOwnThread on_own_thread, host::Clock& clock)
    : writer_(&writer), on_own_thread_(std::move(on_own_thread)), clock_(&clock) {}

Followers::~Followers() { is_alive_.reset(); }

void Followers::add(const std::shared_ptr<Guest>& guest, bool is_by_key) {
  Follower& follower = followers_[guest.get()];
  follower.guest = guest;
  follower.is_by_key = is_by_key;
}

void Followers::send_away_by_key(const std::string& why) {
  std::vector<std::shared_ptr<Guest>> all;
  for (const auto& [key, follower] : followers_)
    if (follower.is_by_key) all.push_back(follower.guest);
  for (const auto& guest : all) {
    guest->close(CloseCode::no_seat, why);
    leave(*guest);
  }
}

// Pages make links of it, so it is no more than a protocol, a host and a port.
bool Followers::note_address(const std::string& address) {
  static constexpr std::size_t kMostAddresses = 8, kLongestAddress = 120;
  if (address.empty()) return true;
  const std::size_t end = address.find("://");
  const bool is_web = end != std::string::npos && (address.substr(0, end) == "http" || address.substr(0, end) == "https");
  if (!is_web || address.size() > kLongestAddress || plain_host(std::string_view(address).substr(end + 3)).empty()) return false;
  if (std::find(addresses_.begin(), addresses_.end(), address) != addresses_.end()) return true;
  if (addresses_.size() == kMostAddresses) addresses_.erase(addresses_.begin());
  addresses_.push_back(address);
  return true;
}

bool Followers::leave(Guest& guest) {
  if (followers_.erase(&guest) == 0) return false;
  if (followers_.empty())
    writer_->perform(
        [](journal::Journal& journal) {
          journal.stop_copying();
          return Result<void>();
        },
        {});
  release();
  return true;
}

void Followers::close() {
  for (auto& [key, follower] : followers_) follower.guest->close(CloseCode::draining, "the room is being closed");
  followers_.clear();
  release();
}

bool Followers::hear(Guest& guest, std::string_view text) {
  const auto found = followers_.find(&guest);
  if (found == followers_.end()) return false;
  Follower& follower = found->second;
  const auto frame = wire::read_frame(text);
  const std::string t = frame ? (*frame)["t"].get<std::string>() : "";
  if (t == "kept") {
    const auto kept = wire::read_message<Kept>(*frame);
    if (!kept || kept->n < follower.copied || kept->n > last_ || !follower.has_all)
      return guest.close(CloseCode::bad_frame, "there is nothing of that number to keep"), true;
    follower.kept = std::max(follower.kept, kept->n);
    release();
  } else if (t == "follow" && !follower.is_asked) {
    const auto follow = wire::read_message<Follow>(*frame);
    if (!follow) return guest.close(CloseCode::bad_frame, follow.error().text()), true;
    if (!note_address(follow->address)) return guest.close(CloseCode::bad_frame, "this is no address of a laptop"), true;
    follower.is_safe = follow->is_safe;
    follower.is_asked = true;
    ask_for_copy(follower.guest);
  } else {
    guest.close(CloseCode::bad_frame, "a follower says `follow` once, and what it has kept");
  }
  return true;
}

void Followers::ask_for_copy(const std::shared_ptr<Guest>& guest) {
  const std::weak_ptr<bool> is_alive = is_alive_;
  auto copy = std::make_shared<Result<journal::Packed>>(Error{});
  const auto on_change = [this, is_alive, post = on_own_thread_](const Result<std::string>& changes) {
    post([this, is_alive, changes] {
      if (!is_alive.expired()) changed(changes);
    });
  };
  writer_->perform(
      [copy, on_change](journal::Journal& journal) -> Result<void> {
        auto bytes = journal.copied(on_change);
        if (bytes) *copy = journal::pack(*bytes);
        else *copy = bytes.error();
        return {};  // that a copy fails is no failure of the room
      },
      [this, is_alive, guest, copy, post = on_own_thread_](const Result<void>& done) {
        if (!done) *copy = done.error();
        post([this, is_alive, guest, copy] {
          if (!is_alive.expired()) take_copy(*guest, *copy);
        });
      });
}

void Followers::take_copy(Guest& guest, const Result<journal::Packed>& packed) {
  const auto found = followers_.find(&guest);
  if (found == followers_.end()) return;
  if (!packed) return guest.close(CloseCode::draining, "the session file cannot be copied now");
  Follower& follower = found->second;
  follower.packed = packed->bytes;
  follower.digest = packed->digest;
  follower.size = packed->size;
  follower.copied = last_;
  send_copy(follower);
}

void Followers::send_copy(Follower& follower) {
  while (!follower.digest.empty() && !follower.has_all && follower.guest->unsent() < kUnsentMost) {
    CopyPart part;
    part.n = follower.copied;
    part.part = wire::base64_of(std::string_view(follower.packed).substr(follower.sent, kPart));
    follower.sent = std::min(follower.sent + kPart, follower.packed.size());
    follower.has_all = part.is_last = follower.sent == follower.packed.size();
    if (part.is_last) {
      part.size = follower.size;
      part.digest = follower.digest;
      follower.packed = {};
    }
    follower.guest->send(frame_of_message(part));
  }
  while (follower.has_all && !follower.waiting.empty() && follower.guest->unsent() < kUnsentMost) {
    follower.waiting_bytes -= follower.waiting.front()->size();
    follower.guest->send(std::move(follower.waiting.front()));
    follower.waiting.pop_front();
  }
}

void Followers::changed(const Result<std::string>& changes) {
  ++last_;
  const auto frame = changes ? frame_of_message(Changes{last_, wire::base64_of(*changes)}) : nullptr;
  for (auto& [key, follower] : followers_) {
    if (follower.digest.empty()) continue;  // it is in the copy that is still to come
    if (frame && follower.waiting_bytes + frame->size() < kWaitingMost) {
      follower.waiting_bytes += frame->size();
      follower.waiting.push_back(frame);
      send_copy(follower);
    } else {
      follower.guest->close(CloseCode::draining, "the copy begins anew");
    }
  }
}

std::size_t Followers::safe_count() const {
  return static_cast<std::size_t>(
      std::count_if(followers_.begin(), followers_.end(), [](const auto& one) { return one.second.is_waited_for(); }));
}

void Followers::when_kept(std::function<void()> tell) {
  if (held_.empty() && safe_count() == 0) return tell();
  held_.push_back({last_, clock_->now(), std::move(tell)});
  release();
}

void Followers::release() {
  const auto is_kept = [&](std::int64_t n) {
    return std::all_of(followers_.begin(), followers_.end(),
                       [n](const auto& one) { return !one.second.is_waited_for() || one.second.kept >= n; });
  };
  while (!held_.empty() && is_kept(held_.front().n)) {
    const auto tell = std::move(held_.front().tell);
    held_.pop_front();
    tell();
  }
}

void Followers::turn() {
  for (auto& [key, follower] : followers_) send_copy(follower);
  if (held_.empty() || clock_->now() - held_.front().since < kPatience) return;
  // Who is waited for in vain is sent away, and comes back with a copy of its own.
  std::vector<std::shared_ptr<Guest>> late;
  for (const auto& [key, follower] : followers_)
    if (follower.is_waited_for() && follower.kept < held_.front().n) late.push_back(follower.guest);
  for (const auto& guest : late) {
    guest->close(CloseCode::draining, "the copy has not kept up");
    leave(*guest);
  }
}

}  // namespace bl::serve
