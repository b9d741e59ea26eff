// Windows as guests: they get entries and marks of ticks, and take the same ticks as the room; or snapshots, where they cannot.
#include <algorithm>

#include <nlohmann/json.hpp>

#include "core/file/scene_file.h"
#include "core/host/self_test.h"
#include "core/journal/packed.h"
#include "core/serve/room_frames.h"
#include "core/serve/room_host.h"
#include "core/wire/base64.h"

namespace bl::serve {

namespace {

constexpr std::int64_t kMostTail = 2000;        // entries that a window is sent at once
constexpr std::int64_t kMostTicksBehind = 600;  // that a window takes again sooner than it reads a snapshot
constexpr std::int64_t kTicksBetweenHashes = 20;
constexpr double kBetweenSnapshots = 0.5;                    // for one window [s]
constexpr double kBetweenPresences = 0.25, kGoneAfter = 5;   // [s]
constexpr std::size_t kMostPresence = 2048, kMostHeld = 64;  // bytes of a frame; nodes in it

std::shared_ptr<const std::string> frame_of_snapshot(const Scene& scene, const State& state, std::int64_t seq) {
  const SavedState saved = save(state);
  const journal::Packed packed = journal::pack(write_scene(scene, full_registry(), &saved));
  wire::SnapshotOut message;
  message.s = seq;
  message.k = state.tick;
  message.scene = wire::base64_of(packed.bytes);
  message.size = packed.size;
  message.digest = packed.digest;
  return frame_of_message(message);
}

}  // namespace

bool RoomHost::ticks_alike(const wire::Hello& hello) {
  const host::SelfTest& own = host::self_test();
  return hello.build == own.build && hello.fingerprint == own.fingerprint;
}

// --- Entries and ticks ----------------------------------------------------------------------------------------------

void RoomHost::begin_reader(Visitor& visitor, std::int64_t have) {
  const bool is_tail = can_send_behind(have);
  if (!is_tail) visitor.guest->send(frame_of_message(wire::SceneOut{base_, JsonValue(beginning_)}));
  send_entries(visitor, is_tail ? have : base_);
}

bool RoomHost::can_send_behind(std::int64_t seq) const {
  return seq > 0 && seq >= base_ && seq <= stored_seq_ && stored_seq_ - seq <= kMostTail;
}

void RoomHost::send_entries(Visitor& visitor, std::int64_t after) {
  std::vector<room::EntryRecord> tail;
  for (const LogEntry& entry : session_->log())
    if (entry.seq > after && entry.seq <= stored_seq_) tail.push_back({entry, 0});
  if (!tail.empty()) visitor.guest->send(frame_of_entries(tail, stored_seq_, epoch()));
  visitor.has = std::max(visitor.has, stored_seq_);
}

void RoomHost::begin_window(Visitor& visitor, std::int64_t have, std::int64_t tick) {
  const std::int64_t now = session_->moment()->ticked->tick;
  const bool knows_ticks = visitor.is_ticking && tick > 0 && tick <= now && now - tick <= kMostTicksBehind;
  if (can_send_behind(have) && knows_ticks) return follow_from(visitor, have);
  visitor.wants_snapshot = true;
  send_snapshots();
}

void RoomHost::follow_from(Visitor& visitor, std::int64_t seq) {
  visitor.is_following = true;
  send_entries(visitor, seq);
  // What it has missed may be more than what else may wait.
  visitor.welcomed_with = visitor.guest->unsent();
  const TickMark& mark = windows_.mark;
  if (mark.tick >= 0) visitor.guest->send(frame_of_message(wire::TickOut{mark.tick, stored_seq_, {}, {}, mark.is_resting}));
  Json seats = Json::object();
  for (const auto& [number, presence] : windows_.presences)
    if (!presence.state.is_null()) seats[std::to_string(number)] = **presence.state.read();
  if (!seats.empty()) visitor.guest->send(frame_of_message(wire::PresenceOut{JsonValue::of(std::move(seats))}));
}

// Packed on the disk's own thread, behind all that it holds: nobody is shown what is not stored.
void RoomHost::send_snapshots() {
  const double now = options_.clock->now();
  const bool is_wanted = std::any_of(visitors_.begin(), visitors_.end(), [&](const auto& one) {
    return one.second.wants_snapshot && now - one.second.snapshot_at >= kBetweenSnapshots;
  });
  if (!is_wanted || is_packing_ || !problem_.empty()) return;
  if (windows_.packed.frame && now - windows_.packed.at < kBetweenSnapshots) return hand_out_snapshot();
  flush();
  is_packing_ = true;
  const auto moment = session_->moment();
  const auto packed = std::make_shared<PackedScene>(PackedScene{moment->seq, moment->ticked->tick, now, nullptr});
  writer_->perform(
      [moment, packed](journal::Journal&) -> Result<void> {
        packed->frame = frame_of_snapshot(*moment->scene, *moment->ticked, packed->seq);
        return {};
      },
      [this, packed, is_alive = std::weak_ptr<bool>(is_alive_)](const Result<void>& result) {
        options_.on_own_thread([this, packed, result, is_alive] {
          if (is_alive.expired()) return;
          is_packing_ = false;
          if (!result || !problem_.empty() || packed->seq > session_->last_seq()) return;  // the room is made again
          windows_.packed = *packed;
          hand_out_snapshot();
        });
      });
}

// The ticks have gone back: who follows them gets the state to which they did.
void RoomHost::begin_windows_anew() {
  windows_.mark = {};
  windows_.untold.clear();
  windows_.packed = {};
  for (auto& [key, visitor] : visitors_) {
    if (!visitor.is_window) continue;
    visitor.is_following = false;
    visitor.wants_snapshot = true;
    visitor.snapshot_at = -1;
  }
}

void RoomHost::hand_out_snapshot() {
  const double now = options_.clock->now();
  for (auto& [key, visitor] : visitors_) {
    if (!visitor.wants_snapshot || now - visitor.snapshot_at < kBetweenSnapshots) continue;
    visitor.wants_snapshot = false;
    visitor.snapshot_at = now;
    // A snapshot has no steps: who has been here before gets the entries that it has missed as well.
    if (can_send_behind(visitor.has)) send_entries(visitor, visitor.has);
    visitor.guest->send(windows_.packed.frame);
    follow_from(visitor, windows_.packed.seq);
  }
}

// A tick is told once every entry that it has read is stored, and so sent. While people say something all the time, and the disk
// is slower than the ticks, the newest tick has always read something that is not stored: so each waits for its own entries.
void RoomHost::tell_ticks() {
  if (!problem_.empty() || std::none_of(visitors_.begin(), visitors_.end(), [](const auto& v) { return v.second.is_window; }))
    return windows_.untold.clear();
  note_tick();
  TickMark& mark = windows_.mark;
  while (!windows_.untold.empty() && windows_.untold.front().s <= stored_seq_) {
    const wire::TickOut message = std::move(windows_.untold.front());
    windows_.untold.pop_front();
    mark.tick = message.k;
    mark.is_resting = message.rest;
    const auto frame = frame_of_message(message);
    for (auto& [key, visitor] : visitors_)
      if (visitor.is_window && visitor.is_following) visitor.guest->send(frame);
  }
}

void RoomHost::note_tick() {
  const auto moment = session_->moment();
  const State& ticked = *moment->ticked;
  TickMark& mark = windows_.mark;
  std::deque<wire::TickOut>& untold = windows_.untold;
  const std::int64_t last = untold.empty() ? mark.tick : untold.back().k;
  const bool is_resting = untold.empty() ? mark.is_resting : untold.back().rest;
  if (ticked.tick < last || (ticked.tick == last && moment->is_resting == is_resting)) return;
  const std::int64_t seq = moment->seq;
  wire::TickOut message{ticked.tick, seq, {}, {}, moment->is_resting};
  if (ticked.tick / kTicksBetweenHashes != mark.hashed / kTicksBetweenHashes || mark.hashed < 0) {
    message.h = hex_digits(ticked.hash);
    if (seq == session_->last_seq()) message.scene = hex_digits(hash_of(session_->said()));
    mark.hashed = ticked.tick;
  }
  // A later tick that has read no more says as much as this one.
  if (!untold.empty() && untold.back().s == seq && untold.back().h.empty()) untold.pop_back();
  untold.push_back(std::move(message));
}

void RoomHost::take_steps(std::int64_t since) {
  const auto& log = session_->log();
  for (auto entry = log.rbegin(); entry != log.rend() && entry->seq > since; ++entry) {
    const auto event = entry->event ? entry->event->read() : Result<const Json*>(Error{});
    if (event && (**event).value("event", "") == "step_clock")
      session_->step(static_cast<int>((**event)["arguments"].value("ticks", std::int64_t{1})));
  }
}

// Each moment of the ticking thread is told on the room's own.
void RoomHost::watch_ticks() {
  windows_.mark = {};
  windows_.untold.clear();
  windows_.packed = {};
  is_packing_ = false;
  session_->subscribe_moments([this, last = std::int64_t{-1}, rested = false, is_alive = std::weak_ptr<bool>(is_alive_)](
                                  const std::shared_ptr<const host::Moment>& moment) mutable {
    if (moment->ticked->tick == last && moment->is_resting == rested) return;
    last = moment->ticked->tick;
    rested = moment->is_resting;
    options_.on_own_thread([this, is_alive] {
      if (!is_alive.expired()) show_tick();
    });
  });
}

// --- What windows say -----------------------------------------------------------------------------------------------

bool RoomHost::hear_window(Visitor& visitor, const std::string& t, const Json& frame, std::size_t size) {
  if (t == "resync") {
    const auto message = wire::read_message<wire::Resync>(frame);
    if (!message) return false;
    if (!message->found.empty()) {
      const room::Seat* seat = room_->state().seat(visitor.seat);
      const auto notice = frame_of_message(
          wire::Say{"window_differs",
                    JsonValue::of({{"seat", visitor.seat}, {"name", seat == nullptr ? "" : seat->name}, {"tick", message->k}})});
      for (auto& [key, other] : visitors_)
        if (const room::Seat* who = room_->state().seat(other.seat); who != nullptr && who->role == Role::facilitator)
          other.guest->send(notice);
    }
    visitor.wants_snapshot = true;
    visitor.has = message->have;
    send_snapshots();
  } else if (t == "presence") {
    const auto message = wire::read_message<wire::PresenceIn>(frame);
    if (!message) return false;
    if (size > kMostPresence || message->holds.size() > kMostHeld) return true;  // it is news of a moment, and may be left out
    Json state = Json::object();
    if (!message->cursor.is_null()) state["cursor"] = **message->cursor.read();
    if (!message->camera.is_null()) state["camera"] = **message->camera.read();
    if (!message->holds.empty()) state["holds"] = message->holds;
    if (message->hidden) state["hidden"] = true;
    Presence& presence = windows_.presences[visitor.seat];
    const JsonValue now = JsonValue::of(std::move(state));
    presence.is_told = presence.is_told && presence.state == now;
    presence.state = now;
    presence.gone_at = std::numeric_limits<double>::infinity();
  }
  return true;
}

void RoomHost::forget_presence(std::int64_t seat) {
  if (const auto found = windows_.presences.find(seat); found != windows_.presences.end())
    found->second.gone_at = options_.clock->now() + kGoneAfter;
}

void RoomHost::tell_presences() {
  const double now = options_.clock->now();
  Json seats = Json::object();
  if (now - windows_.presence_at < kBetweenPresences) return;
  for (auto presence = windows_.presences.begin(); presence != windows_.presences.end();) {
    const bool is_gone = now >= presence->second.gone_at;
    if (is_gone) seats[std::to_string(presence->first)] = nullptr;
    else if (!presence->second.is_told) seats[std::to_string(presence->first)] = **presence->second.state.read();
    presence->second.is_told = true;
    presence = is_gone ? windows_.presences.erase(presence) : std::next(presence);
  }
  if (seats.empty()) return;
  windows_.presence_at = now;
  const auto frame = frame_of_message(wire::PresenceOut{JsonValue::of(std::move(seats))});
  for (auto& [key, visitor] : visitors_)
    if (visitor.is_window && visitor.is_following) visitor.guest->send(frame);
}

}  // namespace bl::serve
