// What is said goes to the room, then to the disk, then to those who wait for it.
#include "core/serve/room_host.h"

#include <algorithm>

#include <nlohmann/json.hpp>

#include "core/file/scene_file.h"
#include "core/room/refusals.h"
#include "core/serve/room_frames.h"
#include "core/wire/operations.h"

namespace bl::serve {

namespace {

// Views follow ticks, not less than so long after the last ones: at ten ticks a second every other one, which comes a little
// early or late. Where no tick comes they go out a turn later, so that a tick that is due comes first [s].
constexpr double kBetweenViews = 0.18, kWithoutTick = 0.25;
constexpr std::size_t kCloseAbove = 1 << 20;  // what a guest has not taken yet [bytes]

std::set<std::string> known_views(const std::vector<std::string>& names) {
  std::set<std::string> known;
  for (const std::string& name : names)
    if (wire::is_view(name)) known.insert(name);
  return known;
}

std::string role_name(Role role) { return std::string(kRoleNames[static_cast<std::size_t>(role)]); }

}  // namespace

// --- Connections ----------------------------------------------------------------------------------------------------

void RoomHost::say(const std::function<void(room::Now now)>& words) {
  session_->say([&](Ledger&, std::int64_t tick) { words(room::Now{tick, options_.wall_time()}); });
  is_changed_ = true;
}

bool RoomHost::greet(const std::shared_ptr<Guest>& guest, const wire::Hello& hello) {
  if (hello.kind == "follower") return greet_follower(guest, hello);
  std::int64_t seat = hello.token.empty() ? 0 : room_->seat_of_token(hello.token);
  std::string token;
  if (seat == 0 && !hello.token.empty()) {
    guest->close(CloseCode::no_seat, "this token opens no seat");
    return false;
  }
  if (seat == 0) {
    room::Invitation invitation{.name = hello.name, .language = hello.lang};
    const auto invited = std::find_if(invites_.begin(), invites_.end(),
                                      [&](const auto& one) { return room::is_same_secret(one.second, hello.invite); });
    if (!hello.invite.empty() && invited == invites_.end()) {
      guest->close(CloseCode::no_seat, was_invite(hello.invite) ? "the facilitator has renewed the keys: ask for a new invitation"
                                                                : "this invitation is not one of this room");
      return false;
    }
    if (hello.invite.empty()) {
      invitation.is_by_code = true;
      if (hello.kind == "beamer") invitation.role = Role::viewer;
    } else
      invitation.role = static_cast<Role>(std::find(kRoleNames.begin(), kRoleNames.end(), invited->first) - kRoleNames.begin());
    std::variant<room::Admission, room::Refusal> admitted = room::Refusal{};
    say([&](room::Now now) { admitted = room_->admit(invitation, now); });
    if (const auto* refusal = std::get_if<room::Refusal>(&admitted)) {
      guest->close(CloseCode::no_seat, refusal->text);
      return false;
    }
    seat = std::get<room::Admission>(admitted).seat;
    token = std::get<room::Admission>(admitted).token;
  }
  if (room_->greet(seat, hello.run, hello.unacked) < 0) {
    guest->close(CloseCode::no_seat, "this run belongs to another seat");
    flush();
    return false;
  }
  for (auto other = visitors_.begin(); other != visitors_.end();) {
    if (other->second.run != hello.run) {
      ++other;
      continue;
    }
    other->second.guest->close(CloseCode::replaced, "the same page has connected again");
    other = visitors_.erase(other);
  }
  Visitor& visitor = visitors_[guest.get()];
  visitor = {guest, seat, hello.run, hello.kind, known_views(hello.views)};
  visitor.is_window = hello.kind == "desktop" && !hello.fingerprint.empty();
  visitor.is_ticking = visitor.is_window && ticks_alike(hello);
  visitor.has = hello.have;
  say([&](room::Now now) { room_->note_presence(seat, true, now); });
  const bool is_known = hello.epoch == 0 || hello.epoch == epoch();
  welcome(visitor, token, is_known ? hello.have : 0, is_known ? hello.tick : 0);
  flush();
  return true;
}

// Told once the seat is stored: a token that a crash could forget is given to nobody.
void RoomHost::welcome(Visitor& visitor, const std::string& token, std::int64_t have, std::int64_t tick) {
  Guest* key = visitor.guest.get();
  tellings_.push_back([this, key, token, have, tick] {
    const auto found = visitors_.find(key);
    if (found == visitors_.end()) return;
    Visitor& who = found->second;
    const room::Seat* seat = room_->state().seat(who.seat);
    if (seat == nullptr) return;
    wire::Welcome message;
    message.you = JsonValue::of({{"seat", who.seat},
                                 {"role", role_name(seat->role)},
                                 {"name", seat->name},
                                 {"colour", seat->colour},
                                 {"areas", seat->areas},
                                 {"card", seat->card}});
    message.room = JsonValue::of({{"code", code_}, {"title", title_}});
    message.limits = JsonValue::of({{"text", room::kLongestText}, {"parts", room::kMostParts}});
    message.epoch = epoch();
    message.seq = stored_seq_;
    message.tick = session_->moment()->state->tick;
    message.rate = room_->state().rate;
    message.done = room_->greet(who.seat, who.run, 0);
    message.token = token;
    message.addresses = addresses();
    if (who.is_window) message.mode = who.is_ticking ? "ticks" : "values";
    who.guest->send(frame_of_message(message));
    who.is_welcome = true;
    if (who.is_window) begin_window(who, have, tick);
    else if (who.kind == "desktop") begin_reader(who, have);
    who.welcomed_with = who.guest->unsent();
    if (!problem_.empty()) who.guest->send(frame_of_message(wire::Say{"storage", JsonValue::of({{"why", problem_}})}));
    show(who);
  });
}

void RoomHost::hear(Guest& guest, std::string_view text) {
  const auto found = visitors_.find(&guest);
  if (found == visitors_.end()) return hear_follower(guest, text);
  Visitor& visitor = found->second;
  const auto frame = wire::read_frame(text);
  if (!frame) return guest.close(CloseCode::bad_frame, frame.error().text());
  const std::string t = (*frame)["t"].get<std::string>();
  if (wire::is_operation(t)) return submit(visitor, wire::read_operation(*frame, visitor.run));
  if (t == "ping") {
    const auto ping = wire::read_message<wire::Ping>(*frame);
    if (!ping) return guest.close(CloseCode::bad_frame, ping.error().text());
    guest.send(frame_of_message(wire::Pong{ping->n, session_->moment()->state->tick}));
  } else if (t == "want") {
    const auto want = wire::read_message<wire::Want>(*frame);
    if (!want) return guest.close(CloseCode::bad_frame, want.error().text());
    visitor.wanted = known_views(want->views);
    const auto most = std::min(want->drafts.size(), wire::Want::kMostDrafts);
    visitor.looks_at = {want->drafts.begin(), want->drafts.begin() + static_cast<std::ptrdiff_t>(most)};
    std::erase_if(visitor.shown, [&](const auto& one) { return !visitor.wanted.contains(one.first); });
    is_changed_ = true;
    show(visitor);
  } else if (!hear_window(visitor, t, *frame, text.size())) {
    guest.close(CloseCode::bad_frame, "the message has a wrong form");
  }
}

void RoomHost::submit(Visitor& visitor, const room::Operation& operation) {
  Guest* key = visitor.guest.get();
  if (!problem_.empty()) {
    const room::Answer no = room::refuse(room::Reason::storage, "", "nothing can be stored at the moment: " + problem_);
    return visitor.guest->send(frame_of(wire::write_answer(operation.id, no)));
  }
  const std::int64_t before = session_->last_seq();
  const room::Answer answer = ask(visitor.seat, operation);
  tellings_.push_back([this, key, id = operation.id, answer] {
    const auto there = visitors_.find(key);
    if (there != visitors_.end()) there->second.guest->send(frame_of(wire::write_answer(id, answer)));
  });
  flush();
  follow_pace();
  take_steps(before);
}

void RoomHost::leave(Guest& guest) {
  const auto found = visitors_.find(&guest);
  if (found == visitors_.end()) return (void)followers_->leave(guest);
  const std::int64_t seat = found->second.seat;
  visitors_.erase(found);
  const bool is_elsewhere =
      std::any_of(visitors_.begin(), visitors_.end(), [&](const auto& one) { return one.second.seat == seat; });
  if (is_elsewhere) return;
  forget_presence(seat);
  if (!problem_.empty()) return;
  say([&](room::Now now) { room_->note_presence(seat, false, now); });
  flush();
}

std::variant<room::Admission, room::Refusal> RoomHost::admit_by_code() {
  if (!problem_.empty()) return room::refuse(room::Reason::storage, "", "nothing can be stored at the moment: " + problem_);
  std::variant<room::Admission, room::Refusal> admitted = room::Refusal{};
  say([&](room::Now now) { admitted = room_->admit({.is_by_code = true}, now); });
  flush();
  return admitted;
}

void RoomHost::say_for(std::int64_t seat, room::OperationKind kind, const JsonValue& content,
                       std::function<void(const room::Answer&)> done) {
  if (!problem_.empty()) return done(room::refuse(room::Reason::storage, "", "nothing can be stored at the moment: " + problem_));
  const std::string run = "plain " + std::to_string(seat);
  const std::int64_t last = std::max<std::int64_t>(0, room_->greet(seat, run, 0));
  const room::Answer answer = ask(seat, {.run = run, .id = last + 1, .kind = kind, .content = content});
  tellings_.push_back([done = std::move(done), answer] { done(answer); });
  flush();
}

void RoomHost::when_stored(std::function<void()> done) {
  tellings_.push_back(std::move(done));
  flush();
}

// --- The disk -------------------------------------------------------------------------------------------------------

void RoomHost::flush() {
  room::Record record = room_->take_record();
  if (record.is_nothing() && tellings_.empty()) return;
  if (record.is_nothing() && commits_under_way_ == 0) {
    const auto tellings = std::exchange(tellings_, {});
    for (const Telling& telling : tellings) telling();
    return;
  }
  ++commits_under_way_;
  const std::int64_t commit = ++commits_begun_;
  std::vector<std::shared_ptr<const std::string>> entries;
  const std::int64_t seq = session_->last_seq();
  if (!record.entries.empty()) entries.push_back(frame_of_entries(record.entries, seq, epoch()));
  auto done = [this, commit, seq, tellings = std::exchange(tellings_, {}), entries = std::move(entries),
               is_alive = std::weak_ptr<bool>(is_alive_)](const Result<void>& result) {
    options_.on_own_thread([this, commit, seq, tellings, entries, result, is_alive] {
      if (!is_alive.expired()) stored(commit, seq, tellings, entries, result);
    });
  };
  writer_->submit(std::move(record), std::move(done));
}

void RoomHost::stored(std::int64_t commit, std::int64_t seq, std::vector<Telling> tellings,
                      std::vector<std::shared_ptr<const std::string>> entries, const Result<void>& result) {
  if (!result) {
    --commits_under_way_;
    if (problem_.empty()) {
      problem_ = result.error().text();
      problem_since_ = options_.clock->now();
      const auto notice = frame_of_message(wire::Say{"storage", JsonValue::of({{"why", problem_}})});
      for (auto& [key, visitor] : visitors_) visitor.guest->send(notice);
    }
    return;  // who waits for an answer asks again
  }
  followers_->when_kept([this, commit, seq, tellings = std::move(tellings), entries = std::move(entries)] {
    commits_told_ = std::max(commits_told_, commit);
    tell(seq, tellings, entries);
  });
}

void RoomHost::tell(std::int64_t seq, const std::vector<Telling>& tellings,
                    const std::vector<std::shared_ptr<const std::string>>& entries) {
  --commits_under_way_;
  stored_seq_ = std::max(stored_seq_, seq);
  for (auto& [key, visitor] : visitors_) {
    if (visitor.is_window ? !visitor.is_following : visitor.kind != "desktop") continue;
    for (const auto& frame : entries) visitor.guest->send(frame);
    visitor.has = std::max(visitor.has, seq);
  }
  tell_ticks();
  for (const Telling& telling : tellings) telling();
  show();
}

// Nothing unstored was shown: the room is made again from what is stored.
void RoomHost::recover() {
  static constexpr double kBetweenTries = 1;  // [s]
  if (options_.clock->now() - problem_since_ < kBetweenTries || commits_under_way_ > 0) return;
  problem_since_ = options_.clock->now();
  writer_->resume();
  const auto loaded = std::make_shared<std::optional<journal::Loaded>>();
  writer_->perform(
      [loaded](journal::Journal& journal) -> Result<void> {
        // Only what can be written as well is of use.
        if (auto writes = journal.change_room(journal.room()); !writes) return writes;
        auto all = journal.load();
        if (!all) return all.error();
        *loaded = std::move(*all);
        return {};
      },
      [this, loaded, is_alive = std::weak_ptr<bool>(is_alive_)](const Result<void>& result) {
        options_.on_own_thread([this, loaded, result, is_alive] {
          if (is_alive.expired() || !result || !*loaded) return;
          trials_.clear();
          session_.reset();
          room_.reset();
          tellings_.clear();
          commits_told_ = commits_begun_;  // those that failed are no more
          next_.reset();
          now_.reset();
          seen_.reset();  // it may hold what was never stored
          past_.clear();
          past_view_ = std::make_shared<const wire::View>();
          if (auto begun = begin(**loaded); !begun) {
            problem_ = begun.error().text();
            return;
          }
          problem_.clear();
          for (auto& [key, visitor] : visitors_) {
            visitor.shown.clear();
            visitor.is_welcome = visitor.is_following = false;
            visitor.guest->send(frame_of_message(wire::Say{"stored", {}}));
            welcome(visitor, "", 0, 0);
          }
          flush();
        });
      });
}

// The entries of the ticks before are final: what is said now belongs to a later one. They go to the disk before the hash does.
void RoomHost::store_hash() {
  const auto moment = session_->moment();
  const State& ticked = *moment->ticked;
  if (ticked.tick == last_hash_tick_) return;
  last_hash_tick_ = ticked.tick;
  const journal::HashRow row{moment->seq, ticked.tick, hex_digits(ticked.hash)};
  writer_->perform([row](journal::Journal& journal) { return journal.add_hashes(std::span(&row, 1)); },
                   [](const Result<void>&) {});
}

void RoomHost::keep_records() {
  static constexpr std::int64_t kEntriesBetween = 500, kTicksBetweenHashes = 60;
  static constexpr double kSecondsBetween = 60;
  if (session_->moment()->ticked->tick / kTicksBetweenHashes > last_hash_tick_ / kTicksBetweenHashes) store_hash();
  store_scenarios();
  const double now = options_.clock->now();
  const auto moment = session_->moment();
  const std::int64_t entries = std::min(stored_seq_, moment->seq) - snapshot_seq_;
  const bool is_due = entries >= kEntriesBetween || (entries > 0 && now - last_snapshot_ >= kSecondsBetween);
  if (!is_due || commits_under_way_ > 0) return;
  last_snapshot_ = now;
  snapshot_seq_ = moment->seq;
  // Packed on the disk's own thread, of what nobody changes any more. What no tick has read is not in it: the next one reads all
  // that was said before it at once.
  writer_->perform(
      [moment, epoch = room_->state().epoch](journal::Journal& journal) {
        const SavedState saved = save(*moment->ticked);
        const journal::Snapshot snapshot{.seq = moment->seq,
                                         .tick = moment->ticked->tick,
                                         .epoch = epoch,
                                         .hash = {},
                                         .scene = journal::pack(write_scene(*moment->scene, full_registry(), &saved))};
        return journal.add_snapshot(snapshot);
      },
      [this, is_alive = std::weak_ptr<bool>(is_alive_)](const Result<void>& result) {
        if (!result) return;
        options_.on_own_thread([this, is_alive] {
          if (!is_alive.expired()) snapshot_stored_ = options_.clock->now();
        });
      });
}

// --- What is shown --------------------------------------------------------------------------------------------------

void RoomHost::follow_pace() {
  const room::RoomState& state = room_->state();
  session_->set_rate(state.rate);
  session_->play(!state.is_paused && !state.is_closed);
}

void RoomHost::turn() {
  followers_->turn();
  tell_health();
  if (!problem_.empty()) return recover();
  serve_devices();
  // Whoever says something wakes the ticks; a room where nothing happens lets them rest.
  if (room_->waits_for_time()) {
    session_->say([&](Ledger&, std::int64_t tick) { room_->pass({tick, options_.wall_time()}); });
    flush();
  }
  for (auto& [key, visitor] : visitors_)
    if (room_->state().seat(visitor.seat) == nullptr)
      visitor.guest->close(CloseCode::removed, "the facilitator has closed this seat");
    else if (visitor.guest->unsent() > kCloseAbove + visitor.welcomed_with)
      visitor.guest->close(CloseCode::draining, "too much waits to be taken");
  send_snapshots();
  tell_presences();
  for (auto& [key, visitor] : visitors_) show(visitor);  // who was too slow for the last views gets them now
  publish_after(kWithoutTick);
}

void RoomHost::show_tick() {
  tell_ticks();
  if (problem_.empty()) publish_after(kBetweenViews);
}

void RoomHost::publish_after(double seconds) {
  const double now = options_.clock->now();
  if (now - last_views_ < seconds) return;
  last_views_ = now;
  keep_records();
  try_drafts();
  publish();
}

}  // namespace bl::serve
