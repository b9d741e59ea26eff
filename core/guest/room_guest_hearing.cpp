// What comes from the server: a scene, entries, marks of ticks, answers; and connections that come and go.
#include <algorithm>

#include <nlohmann/json.hpp>

#include "core/define/codec.h"
#include "core/file/scene_file.h"
#include "core/guest/room_guest.h"
#include "core/journal/packed.h"
#include "core/room/room_state.h"
#include "core/serve/machine.h"
#include "core/serve/room_address.h"
#include "core/wire/base64.h"
#include "core/wire/operations.h"

namespace bl::guest {

namespace {

// Why a server closes a connection for good: nothing would change with another attempt.
constexpr int kBadFrame = 4400, kNoSeat = 4401, kRemoved = 4403, kReplaced = 4409;
constexpr std::int64_t kTooFarBehind = 200;  // ticks: this machine is too slow for the room
constexpr double kTooSlowFor = 5;            // [s]: one slow tick, or a long outage that is made up for, says nothing

}  // namespace

// --- Connections ----------------------------------------------------------------------------------------------------

void RoomGuest::connect() {
  is_open_ = is_welcome_ = false;
  began_at_ = options_.clock->now();
  waits_for_pong_since_ = -1;
  link_ = options_.connect([this] { follower_.nudge(); });
}

void RoomGuest::lose(const std::string&) {
  const double now = options_.clock->now();
  if (is_welcome_) lost_since_ = now;
  link_.reset();
  is_open_ = is_welcome_ = false;
  double pause = kFirstRetry;
  for (int k = 0; k < attempts_; ++k) pause = std::min(kLastRetry, pause * kRetryGrowth);
  const double chance = options_.random ? options_.random() : 0.5;
  retry_at_ = now + pause * (1 + kRetryJitter * (2 * chance - 1));
  attempts_ = std::min(attempts_ + 1, 30);
  follower_.nudge();
}

void RoomGuest::hear(const Heard& heard) {
  if (heard.what == Heard::What::opened) {
    is_open_ = true;
    say_hello();
  } else if (heard.what == Heard::What::frame) {
    hear_frame(heard.text);
  } else {
    if (heard.code == kNoSeat && !options_.token.empty()) {
      // The seat is no more; the invitation may still be good for another one.
      options_.token.clear();
      if (options_.keep_token) options_.keep_token("");
      give_up_run();
    } else if (heard.code == kBadFrame || heard.code == kNoSeat || heard.code == kRemoved || heard.code == kReplaced) {
      finish(heard.code == kReplaced ? "This seat is used by another connection of the same window."
                                     : "The room has ended the connection: " + heard.text + ".");
    }
    lose(heard.text);
  }
}

// A run belongs to its seat. What has waited in it can be said by nobody any more.
void RoomGuest::give_up_run() {
  leave_draft();  // drafts belong to the seat
  for (auto& [id, draft] : parked_) left_.push_back(std::move(draft));
  parked_.clear();
  for (Sent& sent : outbox_.begin_anew(options_.new_run())) {
    (void)fold_.answered(sent.id);
    refusals_.push_back({std::move(sent.what), "gone", "", "The room does not know the seat any more that has said this."});
  }
  fold_.show_again();
  is_stale_ = true;
}

void RoomGuest::say_hello() {
  wire::Hello hello;
  hello.room = options_.code;
  hello.run = outbox_.run();
  if (options_.token.empty()) hello.invite = options_.invite;
  else hello.token = options_.token;
  hello.kind = "desktop";
  hello.lang = "en";
  hello.name = options_.name;
  hello.build = options_.self.build;
  hello.fingerprint = options_.self.fingerprint;
  hello.views = kViews;
  hello.unacked = outbox_.last_answered();
  if (has_scene_) {
    hello.have = fold_.seq();
    hello.tick = wants_resync_ ? 0 : follower_.tick();
    hello.epoch = epoch_;
  }
  send(wire::write_message(hello));
}

// --- Frames ---------------------------------------------------------------------------------------------------------

void RoomGuest::hear_frame(const std::string& text) {
  const auto json = wire::read_frame(text);
  if (!json) return;
  const std::string t = (*json)["t"].get<std::string>();
  const auto with = [&]<class M>(void (RoomGuest::*take)(const M&)) {
    if (const auto message = wire::read_message<M>(*json)) (this->*take)(*message);
  };
  if (t == "welcome") with(&RoomGuest::hear_welcome);
  else if (t == "snapshot") with(&RoomGuest::hear_snapshot);
  else if (t == "ops") with(&RoomGuest::hear_entries);
  else if (t == "tick") with(&RoomGuest::hear_tick);
  else if (t == "nack") with(&RoomGuest::hear_refusal);
  else if (t == "state") with(&RoomGuest::hear_view);
  else if (t == "say") with(&RoomGuest::hear_say);
  else if (t == "pong") waits_for_pong_since_ = -1;
  else if (t == "health") {
    if (auto message = wire::read_message<wire::HealthOut>(*json)) health_ = std::move(*message);
    follower_.nudge();
  } else if (t == "ack") {
    if (const auto message = wire::read_message<wire::Ack>(*json)) {
      acked_seq_ = std::max(acked_seq_, message->s);
      hear_answer(message->id);
    }
  } else if (t == "presence") {
    const auto message = wire::read_message<wire::PresenceOut>(*json);
    const auto seats = message ? message->seats.read() : Result<const Json*>(Error{});
    if (seats) people_.take_presence(**seats);
    follower_.nudge();
  }
}

void RoomGuest::hear_welcome(const wire::Welcome& welcome) {
  const auto you = welcome.you.read();
  if (!you || !(*you)->is_object()) return;
  seat_ = number_in(**you, "seat", 0);
  role_ = text_in(**you, "role");
  history_.set_author({room::RoomState::author_of_seat(seat_), AuthorKind::person});
  if (const auto room = welcome.room.read(); room && people_.title.empty()) people_.title = text_in(**room, "title");
  if (mode_ != welcome.mode && welcome.mode == "values")
    notices_.push_back(
        "This program computes other results than the room's server. It shows the server's values, a second old at most, and "
        "does "
        "not compute them itself.");
  mode_ = welcome.mode;
  // A server that has taken over may lack the last entries of the one before; their numbers mean others then.
  if (epoch_ != welcome.epoch) told_to_ = std::min(told_to_, welcome.seq);
  epoch_ = welcome.epoch;
  people_.rate = welcome.rate;
  find_page(welcome.addresses);
  if (!welcome.token.empty()) {
    options_.token = welcome.token;
    if (options_.keep_token) options_.keep_token(welcome.token);
  }
  is_welcome_ = true;
  can_store_ = true;  // else it says so
  health_.reset();
  views_.clear();  // the first message of each has all of it
  ++views_revision_;
  attempts_ = 0;
  ping_at_ = answer_at_ = began_at_ = keeps_up_at_ = options_.clock->now();
  is_where_sent_ = where_text_.empty();
  outbox_.go_on_behind(welcome.done);
  sent_to_ = 0;
  may_send_ = kMostAtOnce;
  send_waiting();
  if (!may_wish_pace() && !std::exchange(wished_pace_, {}).is_nothing()) notices_.push_back(why_no_clock());
  if (!looked_at_.empty()) say_wishes();
  follower_.nudge();
}

// An address of this computer alone is none for phones. The server says by which others it is found.
void RoomGuest::find_page(const std::vector<std::string>& addresses) {
  const auto is_own = [](const std::string& page) {
    const auto address = serve::room_address(page);
    return !address || serve::is_own_address(address->host);
  };
  if (options_.page.empty() || !is_own(options_.page)) return;
  for (const std::string& address : addresses)
    if (const std::string page = address + "/" + options_.code; !is_own(page)) {
      options_.page = page;
      return;
    }
}

void RoomGuest::hear_snapshot(const wire::SnapshotOut& snapshot) {
  const auto bytes = wire::bytes_of_base64(snapshot.scene);
  if (!bytes) return notices_.push_back("The room has sent a scene that cannot be read: " + bytes.error().text());
  const auto text = journal::unpack({*bytes, snapshot.size, snapshot.digest});
  if (!text) return notices_.push_back("The room has sent a scene that cannot be read: " + text.error().text());
  SceneReading reading = read_scene(*text, *registry_);
  if (!reading.is_usable()) return finish("This program cannot read the room's scene: " + reading.first_error().text());
  if (auto begun = follower_.begin(reading.scene, reading.state ? &*reading.state : nullptr); !begun)
    notices_.push_back("The running state of the room cannot be shown: " + begun.error().text());
  if (has_scene_ && snapshot.s > told_to_)
    notices_.push_back("The list of steps lacks " + std::to_string(snapshot.s - told_to_) +
                       " entries of the room that were missed. They are in the room's record.");
  told_to_ = std::max(told_to_, snapshot.s);
  fold_.begin(std::move(reading.scene), snapshot.s);
  if (!std::exchange(has_scene_, true)) show_kept();
  wants_resync_ = false;
  follow_draft();
  tell_all_changed();
}

// Commands that do not fit the scene any more are not shown; the room's answer says what becomes of them.
void RoomGuest::show_kept() {
  for (const Sent& sent : outbox_.waiting()) {
    const auto json = wire::read_frame(sent.frame);
    if (!json || text_in(*json, "t") != "op" || json->contains("draft")) continue;
    const auto command = command_from_json(*registry_, (*json)["c"], "c");
    if (command) (void)fold_.add(sent.id, *command);
  }
}

void RoomGuest::hear_entries(const wire::Ops& ops) {
  const auto list = ops.e.read();
  if (!list || !(*list)->is_array() || !has_scene_) return;
  if (ops.epoch != 0) epoch_ = ops.epoch;
  bool has_changed = false;
  Fold::Placed placed;
  for (const Json& json : **list) {
    auto entry = entry_of(json, *registry_);
    const auto change = entry ? fold_.take(*entry) : Result<Fold::Change>(entry.error());
    if (!change) {
      miss("entry", entry ? entry->tick : follower_.tick());
      break;
    }
    // A snapshot holds what the last tick has read: behind it entries come again that are in the log already.
    const bool is_new = entry->seq > told_to_;
    told_to_ = std::max(told_to_, entry->seq);
    if (!entry->is_command()) continue;
    has_changed = true;
    placed.insert(change->placed.begin(), change->placed.end());
    if (change->is_logic_changed && mode_ != "values") follower_.set_scene(entry->tick, fold_.confirmed(), change->placed);
    if (!is_new) continue;
    history_.take(*entry, fold_.confirmed());
    entry_ticks_.emplace_back(entry->tick, entry->seq);
    log_.push_back(std::move(*entry));
  }
  if (!has_changed) return;
  fold_.show_again();
  is_stale_ = true;
  if (work_) work_->note_moved(std::move(placed));
  follow_draft();
}

void RoomGuest::hear_tick(const wire::TickOut& mark) {
  if (!has_scene_) return;
  if (mode_ == "values") {
    if (mark.k <= follower_.tick() || wants_resync_) return;
    return miss("values", mark.k);
  }
  // A tick that has read what is not here cannot be taken.
  if (mark.s > fold_.seq()) return miss("entry", mark.k);
  if (!mark.scene.empty() && mark.s == fold_.seq() && mark.scene != hex_digits(hash_of(fold_.confirmed()))) {
    wants_resync_ = true;
    asked_why_ = "scene";
    asked_ = {
        .tick = mark.k, .why = "scene", .expected = mark.scene, .found = hex_digits(hash_of(fold_.confirmed())), .text = {}};
  }
  follower_.mark({mark.k, mark.h, mark.rest});
  const double now = options_.clock->now();
  if (follower_.behind() <= kTooFarBehind || follower_.moment()->tick_seconds * people_.rate <= 0.9) keeps_up_at_ = now;
  if (now - keeps_up_at_ <= kTooSlowFor) return;
  mode_ = "values";
  notices_.push_back("This computer is too slow for the ticks of this room. It shows the server's values from now on.");
}

// --- Answers --------------------------------------------------------------------------------------------------------

void RoomGuest::hear_answer(std::int64_t id, bool is_stored) {
  const std::deque<Sent>& waiting = outbox_.waiting();
  const auto found = std::find_if(waiting.begin(), waiting.end(), [&](const Sent& sent) { return sent.id == id; });
  const std::optional<Sent> sent = found == waiting.end() ? std::nullopt : std::optional(*found);
  if (!outbox_.answered(id)) return;
  answer_at_ = options_.clock->now();
  send_waiting();
  if (sent) hear_answer_of_draft(*sent, is_stored);
  if (!fold_.answered(id)) return;
  fold_.show_again();
  is_stale_ = true;
}

void RoomGuest::hear_refusal(const wire::Nack& nack) {
  // Nothing was decided: the operation keeps its place, and is said again.
  if (nack.why == "storage" || nack.why == "draining") return;
  if (nack.why == "gap") {
    const auto args = nack.args.read();
    const std::int64_t next = args ? number_in(**args, "next", nack.id) : nack.id;
    // All that came behind the missing one are refused as well, and what is sent again for the first of them answers all.
    const double now = options_.clock->now();
    if (next == gap_before_ && now - gap_at_ < kBetweenGaps) return;
    gap_before_ = next;
    gap_at_ = now;
    sent_to_ = std::min(sent_to_, next - 1);
    return send_waiting();
  }
  const std::deque<Sent>& waiting = outbox_.waiting();
  const auto found = std::find_if(waiting.begin(), waiting.end(), [&](const Sent& sent) { return sent.id == nack.id; });
  if (found == waiting.end()) return;
  refusals_.push_back({found->what, nack.why, nack.place, nack.text});
  const auto said = wire::read_frame(found->frame);
  const std::string begun = said && begins_draft(*said) ? text_in(*said, "draft") : "";
  const bool is_shown = own().has_own();
  hear_answer(nack.id, false);
  if (!begun.empty()) give_up_draft(begun);
  // What was shown of it is shown no more: everything may look different.
  else if (is_shown) tell_all_changed();
}

void RoomGuest::hear_view(const wire::StateOut& view) {
  const auto set = view.set.read();
  if (!set || !(*set)->is_object()) return;
  std::map<std::string, JsonValue>& known = views_[view.view];
  if (view.whole) known.clear();
  for (const auto& [key, content] : (*set)->items()) known[key] = JsonValue::of(content);
  for (const std::string& key : view.drop) known.erase(key);
  ++views_revision_;
  follower_.nudge();
  if (view.view == "drafts") {
    hear_drafts(view);
  } else if (work_ && view.view == "draft_steps") {
    follow_draft();
    if (view.whole) show_waiting_steps();
    tell_all_changed();
  }
  if (view.view != "room") return;
  people_.take_view(**set);
  if (const auto own = people_.seats.find(seat_); own != people_.seats.end()) role_ = own->second.role;
  follower_.set_pace(!people_.is_paused && !people_.is_closed, people_.rate);
}

void RoomGuest::hear_say(const wire::Say& say) {
  const auto args = say.args.read();
  const Json& told = args ? **args : Json();
  if (say.id == "storage" || say.id == "stored") can_store_ = say.id == "stored";
  if (say.id == "storage") notices_.push_back("The room cannot store anything at the moment: " + text_in(told, "why"));
  else if (say.id == "stored") notices_.push_back("The room is stored again.");
  else if (say.id == "window_differs")
    notices_.push_back("The window of " + text_in(told, "name") +
                       " computed another result than the server, and has begun anew.");
}

// --- Differences ----------------------------------------------------------------------------------------------------

void RoomGuest::miss(const std::string& why, std::int64_t tick) {
  wants_resync_ = true;
  asked_why_ = why;
  asked_ = {.tick = tick, .why = why, .expected = {}, .found = {}, .text = {}};
}

void RoomGuest::resync(const std::string& why, const Difference& difference) {
  const double now = options_.clock->now();
  if (why == "hash")
    notices_.push_back("At tick " + std::to_string(difference.tick) +
                       " this window had another result than the server. It takes the server's state and goes on from there.");
  else if (why == "failed") notices_.push_back(difference.text + "; the window takes the server's state and goes on from there.");
  wants_resync_ = true;
  asked_why_ = why;
  asked_ = difference;
  if (!is_welcome_ || now - resync_at_ < kBetweenResyncs) return;
  resync_at_ = now;
  if (why == "hash" || why == "scene") ++differed_;
  wire::Resync message;
  message.k = difference.tick;
  message.have = has_scene_ ? fold_.seq() : 0;
  message.expected = difference.expected;
  message.found = difference.found;
  message.why = why;
  send(wire::write_message(message));
}

}  // namespace bl::guest
