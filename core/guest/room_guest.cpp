// What the holder says: shown at once, sent with a number, and kept until the room has answered.
#include "core/guest/room_guest.h"

#include <algorithm>

#include <nlohmann/json.hpp>

#include "core/define/codec.h"
#include "core/define/registry.h"
#include "core/host/step_labels.h"
#include "core/reading/figures.h"
#include "core/room/room_state.h"

namespace bl::guest {

namespace {

constexpr double kSlowestRoom = 1, kFastestRoom = 20;  // ticks a second, as rooms have it
constexpr std::size_t kKeptEntryTicks = 20000;         // as many entries as a room can take back

Command as_one(const std::vector<Command>& commands) {
  return commands.size() == 1 ? commands.front() : command<Batch>({commands});
}

}  // namespace

RoomGuest::RoomGuest(const Registry& registry, RoomGuestOptions options)
    : registry_(&registry),
      options_(std::move(options)),
      fold_(registry),
      follower_(registry, options_.threads, *options_.clock),
      history_(registry, Author{}, host::HistoryOf::everybody),
      outbox_(options_.new_run()) {
  lost_since_ = options_.clock->now();
  open_outbox();
  connect();
}

void RoomGuest::open_outbox() {
  if (options_.outbox.empty()) return;
  auto opened = Outbox::open(options_.outbox, outbox_.run());
  if (!opened)
    return notices_.push_back("Changes that wait for an answer of the room do not outlive a crash of this window: " +
                              opened.error().text());
  outbox_ = std::move(*opened);
  if (options_.token.empty()) return give_up_run();
  last_gesture_ = outbox_.last_gesture();
  if (const std::size_t kept = outbox_.waiting().size(); kept > 0)
    notices_.push_back("An earlier window has left " + reading::counted(kept, "change") +
                       " without an answer. They are sent to the room now.");
}

RoomGuest::~RoomGuest() { link_.reset(); }

void RoomGuest::send(std::string frame) {
  if (link_ && is_open_) link_->send(std::move(frame));
}

// Before the welcome nothing is sent: everything without an answer goes out after it, in order.
template <class Message>
Result<void> RoomGuest::send_operation(Message message, const std::string& what, std::int64_t gesture) {
  message.id = outbox_.next_id();
  if (auto kept = outbox_.keep({message.id, wire::write_message(message), what}, gesture); !kept) return kept;
  send_waiting();
  return {};
}

// The server leaves in the network what comes faster than sixty a second, with the pings behind it, and sends away whoever goes
// on like that for half a minute (core/serve). So what has waited through an outage goes out in small parts, a little slower.
void RoomGuest::send_waiting() {
  if (!is_welcome_) return;
  const double now = options_.clock->now();
  may_send_ = std::min<double>(kMostAtOnce, may_send_ + (now - sent_at_) * kSentInASecond);
  sent_at_ = now;
  std::size_t unanswered = 0;
  for (const Sent& sent : outbox_.waiting()) {
    if (sent.id > sent_to_) {
      if (unanswered >= kMostUnanswered || may_send_ < 1) break;
      if (unanswered == 0) answer_at_ = now;
      may_send_ -= 1;
      sent_to_ = sent.id;
      send(sent.frame);
    }
    ++unanswered;
  }
}

bool RoomGuest::has_sent_all() const {
  return is_welcome_ && (outbox_.waiting().empty() || outbox_.waiting().back().id <= sent_to_);
}

template <class Message>
void RoomGuest::say(Message message, const std::string& what) {
  if (auto said = send_operation(std::move(message), what); !said) notices_.push_back(said.error().text());
}

// --- Commands -------------------------------------------------------------------------------------------------------

Result<void> RoomGuest::say_values(std::int64_t gesture, std::vector<Command> commands) {
  if (commands.empty()) return {};
  if (!end_.empty()) return Error{ErrorCode::conflict, "", end_};
  if (!has_scene_) return Error{ErrorCode::conflict, "", "the room has not sent its scene yet"};
  Command one = as_one(commands);
  const std::string what = host::label_of_step(*registry_, one, scene());
  wire::Op op;
  op.base = fold_.seq();
  op.gesture = gesture;
  op.c = JsonValue::of(command_to_json(*registry_, one));
  const std::int64_t id = outbox_.next_id();
  if (work_) op.draft = work_->id();
  if (auto done = work_ ? work_->say(id, one) : fold_.add(id, one); !done) return done;
  if (auto kept = send_operation(std::move(op), what, gesture); !kept) {
    if (work_) work_->unsay(id);
    else (void)fold_.answered(id);
    fold_.show_again();
    return kept;
  }
  LogEntry shown{.tick = follower_.tick(), .gesture = gesture};
  shown.author = history_.author();
  shown.command = std::move(one);
  log_.push_back(std::move(shown));
  is_stale_ = true;
  return {};
}

Result<void> RoomGuest::end_gestures(std::int64_t but) {
  Result<void> first;
  for (const std::int64_t gesture : own().open()) {
    if (gesture == but) continue;
    auto ended = end_gesture(gesture);
    if (first && !ended) first = std::move(ended);
  }
  return first;
}

Result<void> RoomGuest::submit(const std::vector<Command>& commands, std::int64_t gesture, const std::string&) {
  if (auto ended = end_gestures(gesture); !ended) return ended;
  auto said = say_values(gesture, commands);
  refresh();
  return said;
}

Result<void> RoomGuest::show(const std::vector<Command>& commands, std::int64_t gesture) {
  if (commands.empty()) return {};
  if (!end_.empty() || !has_scene_) return say_values(gesture, commands);
  if (auto ended = end_gestures(gesture); !ended) return ended;
  if (auto shown = own().show(gesture, as_one(commands)); !shown) return shown;
  is_stale_ = true;
  // In a draft each value that is said is a step, so only the last ones are said. While others wait to be sent nobody would see
  // it sooner, and the next value replaces it.
  const bool is_due = !work_ && has_sent_all();
  auto said = is_due ? say_values(gesture, fold_.take_due(gesture, options_.clock->now(), false)) : Result<void>();
  refresh();
  return said;
}

Result<void> RoomGuest::end_gesture(std::int64_t gesture) {
  auto said = say_values(gesture, own().take_due(gesture, options_.clock->now(), true));
  own().end(gesture);
  if (!said) own().show_again();
  is_stale_ = true;
  refresh();
  return said;
}

void RoomGuest::abandon(std::int64_t gesture) {
  const std::vector<Command> back = own().drop(gesture);
  is_stale_ = true;
  if (!back.empty())
    if (auto said = say_values(gesture, back); !said) notices_.push_back(said.error().text());
  refresh();
}

Result<void> RoomGuest::say_of_draft(wire::DraftOp::What what, const std::string& id, const std::string& words,
                                     const std::string& title) {
  wire::DraftOp op;
  op.what = what;
  op.draft = id;
  op.title = title;
  return send_operation(std::move(op), words);
}

// The room knows what can be undone; what it does comes back as entries.
Result<TakenBack> RoomGuest::undo() {
  if (auto ended = end_gestures(0); !ended) return ended.error();
  if (!end_.empty()) return Error{ErrorCode::conflict, "", end_};
  if (work_ && work_->step_count() == 0) return Error{ErrorCode::not_found, "", "The draft has no step to take back."};
  auto said =
      work_ ? say_of_draft(wire::DraftOp::What::undo, work_->id(), "Undo in the draft") : send_operation(wire::UndoOp{}, "Undo");
  if (!said) return said.error();
  return TakenBack{};
}

Result<TakenBack> RoomGuest::redo() {
  if (auto ended = end_gestures(0); !ended) return ended.error();
  if (!end_.empty()) return Error{ErrorCode::conflict, "", end_};
  auto said =
      work_ ? say_of_draft(wire::DraftOp::What::redo, work_->id(), "Redo in the draft") : send_operation(wire::RedoOp{}, "Redo");
  if (!said) return said.error();
  return TakenBack{};
}

void RoomGuest::undo_of(std::int64_t seat, std::int64_t gesture) {
  if (!end_.empty()) return;
  wire::UndoOp op;
  op.gesture = gesture;
  op.of = seat;
  say(op, "Undo");
}

// --- The clock ------------------------------------------------------------------------------------------------------

std::string RoomGuest::why_no_clock() const {
  if (!end_.empty()) return end_;
  if (!is_welcome_) return "There is no connection to the room.";
  return role_ == "facilitator" ? std::string() : "Only the facilitator sets the clock of a room.";
}

// Without a connection the wish is kept. Before the first welcome nobody knows whose it is.
bool RoomGuest::may_wish_pace() const { return end_.empty() && (role_.empty() || role_ == "facilitator"); }

void RoomGuest::play(bool is_playing) {
  if (may_wish_pace()) wished_pace_.is_paused = !is_playing;
}

void RoomGuest::set_rate(double ticks_per_second) {
  if (may_wish_pace()) wished_pace_.rate = std::clamp(ticks_per_second, kSlowestRoom, kFastestRoom);
}

// Of a part that nobody wishes to change the room's own value is said. The welcome tells the rate, and the view whether it
// stands.
void RoomGuest::say_pace(double now) {
  const PaceWish wish = wished_pace_;
  if (wish.is_nothing() || now - pace_at_ < kBetweenPaces) return;
  if (!wish.is_paused && !views_.contains("room")) return;
  say_event("set_pace", JsonValue::of({{"rate", wish.rate.value_or(people_.rate)},
                                       {"is_paused", wish.is_paused.value_or(people_.is_paused)}}));
  wished_pace_ = {};
  pace_at_ = now;
}

void RoomGuest::step(int ticks) {
  if (why_no_clock().empty()) say_event("step_clock", JsonValue::of({{"ticks", ticks}}));
}

void RoomGuest::rewind(std::int64_t ticks) {
  if (!why_no_clock().empty()) return;
  const std::int64_t from = follower_.tick() - ticks;
  std::int64_t to = entry_ticks_.empty() ? fold_.seq() : entry_ticks_.front().second - 1;
  for (const auto& [tick, seq] : entry_ticks_)
    if (tick < from) to = seq;
  if (to >= fold_.seq()) {
    notices_.push_back("Nothing has been changed since then.");
    return;
  }
  wire::RewindOp op;
  op.to = to;
  say(op, "Rewind");
}

void RoomGuest::say_event(const std::string& event, const JsonValue& arguments) {
  if (!end_.empty()) return;
  wire::RoomOp op;
  const auto content = arguments.read();
  op.e = JsonValue::of({{"event", event}, {"arguments", content ? **content : Json::object()}});
  say(std::move(op), event);
}

void RoomGuest::look_at(std::vector<std::string> drafts) {
  // The own one comes first, where it is one of too many.
  if (work_) {
    std::erase(drafts, work_->id());
    drafts.insert(drafts.begin(), work_->id());
  }
  if (drafts.size() > wire::Want::kMostDrafts) drafts.resize(wire::Want::kMostDrafts);
  if (drafts == looked_at_) return;
  looked_at_ = std::move(drafts);
  if (is_welcome_) say_wishes();
}

void RoomGuest::say_wishes() {
  wire::Want message;
  message.views = kViews;
  message.drafts = looked_at_;
  if (!looked_at_.empty()) message.views.emplace_back("draft_plans");
  send(wire::write_message(message));
}

void RoomGuest::set_whereabouts(Whereabouts where) {
  wire::PresenceIn message;
  if (where.cursor) message.cursor = JsonValue::of({where.cursor->x, where.cursor->y, where.cursor->z});
  message.camera = where.camera;
  message.holds = where.holds;
  message.hidden = where.is_hidden;
  std::string text = wire::write_message(message);
  if (text == where_text_) return;
  where_text_ = std::move(text);
  where_ = std::move(where);
  is_where_sent_ = false;
}

// --- Turns ----------------------------------------------------------------------------------------------------------

void RoomGuest::say_due(double now) {
  if (has_waiting_values() && has_sent_all())
    for (const std::int64_t gesture : fold_.waiting())
      if (auto said = say_values(gesture, fold_.take_due(gesture, now, false)); !said) notices_.push_back(said.error().text());
  if (!is_welcome_) return;
  say_pace(now);
  if (!is_where_sent_ && now - where_at_ >= kBetweenPresences) {
    wire::PresenceIn message;
    message.n = ++where_number_;
    if (where_.cursor) message.cursor = JsonValue::of({where_.cursor->x, where_.cursor->y, where_.cursor->z});
    message.camera = where_.camera;
    message.holds = where_.holds;
    message.hidden = where_.is_hidden;
    send(wire::write_message(message));
    is_where_sent_ = true;
    where_at_ = now;
  }
}

Result<void> RoomGuest::keep_up() {
  const double now = options_.clock->now();
  fold_.forget_past();
  left_.clear();
  if (work_) work_->fold().forget_past();
  if (link_)
    for (const Heard& heard : link_->take()) hear(heard);
  if (!link_ && end_.empty() && now >= retry_at_) connect();
  if (is_open_ && waits_for_pong_since_ >= 0 && now - waits_for_pong_since_ > kPongWithin) lose("the server does not answer");
  if (is_welcome_ && waits_for_pong_since_ < 0 && now - ping_at_ >= kBetweenPings) {
    ping_at_ = waits_for_pong_since_ = now;
    send(wire::write_message(wire::Ping{}));
  }
  if (link_ && !is_welcome_ && now - began_at_ > kWelcomeWithin) lose("the server does not answer");
  // Whatever became of it, saying it again does no harm.
  if (is_welcome_ && !outbox_.waiting().empty() && now - answer_at_ > kAnswerWithin) {
    answer_at_ = now;
    sent_to_ = 0;
  }
  send_waiting();
  if (is_welcome_ && !has_scene_ && !wants_resync_ && now - began_at_ > kWelcomeWithin)
    resync("entry", {.tick = 0, .why = "entry", .expected = {}, .found = {}, .text = {}});
  if (const auto difference = follower_.take_difference()) resync(difference->why, *difference);
  if (wants_resync_ && is_welcome_ && now - resync_at_ >= kBetweenResyncs) resync(asked_why_, asked_);
  say_due(now);
  refresh();
  if (work_) draft_turn_ = work_->keep_ticking(now, people_.rate, !people_.is_paused && !people_.is_closed);
  return {};
}

double RoomGuest::next_turn() const {
  const double now = options_.clock->now();
  double next = now + kBetweenPings;
  if (!link_ && end_.empty()) next = std::min(next, retry_at_);
  if (has_waiting_values() && has_sent_all()) next = std::min(next, now + Fold::kBetweenValues);
  if (is_welcome_ && !wished_pace_.is_nothing()) next = std::min(next, pace_at_ + kBetweenPaces);
  if (is_welcome_ && !has_sent_all()) next = std::min(next, now + 1 / kSentInASecond);
  if (!is_where_sent_ && is_welcome_) next = std::min(next, where_at_ + kBetweenPresences);
  if (wants_resync_) next = std::min(next, resync_at_ + kBetweenResyncs);
  if (work_) next = std::min(next, draft_turn_);
  return std::max(next, now);
}

// Once after everything that was heard: what is shown, and what the ticks' thread shows beside its state.
void RoomGuest::refresh() {
  if (!std::exchange(is_stale_, false)) return;
  if (work_ && work_->has_ticks()) work_->show();
  if (work_ && !work_->has_ticks()) follower_.show(own().shown(), work_->placed());
  else if (fold_.has_own()) follower_.show(fold_.shown(), fold_.placed());
  else follower_.show_nothing_more();
  while (entry_ticks_.size() > kKeptEntryTicks) entry_ticks_.pop_front();
}

const std::map<std::string, JsonValue>& RoomGuest::view(const std::string& name) const {
  static const std::map<std::string, JsonValue> kNothing;
  const auto found = views_.find(name);
  return found == views_.end() ? kNothing : found->second;
}

std::string RoomGuest::author() const { return room::RoomState::author_of_seat(seat_); }

Standing RoomGuest::standing() const {
  return {.is_connected = is_welcome_,
          .has_scene = has_scene_,
          .lost_since = lost_since_,
          .waiting = outbox_.waiting().size() + own().waiting().size(),
          .end = end_,
          .can_store = can_store_,
          .takes_ticks = mode_ != "values"};
}

}  // namespace bl::guest
