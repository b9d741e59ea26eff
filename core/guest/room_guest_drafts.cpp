// Work in a draft: what the holder sees and changes is the draft, until they leave it.
#include <algorithm>

#include <nlohmann/json.hpp>

#include "core/define/codec.h"
#include "core/guest/room_guest.h"
#include "core/wire/operations.h"
#include "core/wire/plan_view.h"

namespace bl::guest {

std::shared_ptr<const host::Moment> RoomGuest::moment() const {
  return work_ && work_->has_ticks() ? work_->ticks()->moment() : follower_.moment();
}

std::shared_ptr<const State> RoomGuest::coming_state() {
  if (work_ && work_->has_ticks()) return work_->ticks()->state_with(scene(), own().placed());
  return follower_.state_with(scene(), work_ ? work_->placed() : fold_.placed());
}

std::map<std::string, JsonValue> RoomGuest::plan() const {
  std::map<std::string, JsonValue> view;
  for (auto& [key, content] : wire::plan_view(*follower_.moment()->ticked)) view.emplace(key, JsonValue(content));
  return view;
}

void RoomGuest::tell_all_changed() {
  is_stale_ = true;
  LogEntry all{.seq = fold_.seq(), .tick = follower_.tick()};
  all.command = command<Batch>({});
  log_.push_back(std::move(all));
}

void RoomGuest::follow_draft() {
  const auto steps = views_.find("draft_steps");
  if (work_) work_->follow(fold_.confirmed(), fold_.seq(), steps == views_.end() ? nullptr : &steps->second);
}

// A window before this one may have said them; or a server that has lost the end of its record has told them once.
void RoomGuest::show_waiting_steps() {
  for (const Sent& sent : outbox_.waiting()) {
    const auto json = work_->has(sent.id) ? Result<Json>(Error{}) : wire::read_frame(sent.frame);
    if (!json || text_in(*json, "t") != "op" || text_in(*json, "draft") != work_->id()) continue;
    const auto command = command_from_json(*registry_, (*json)["c"], "c");
    if (command) (void)work_->say(sent.id, *command);
  }
}

// A draft that was left here is as it was. In another one, what a window before this one has said and has no answer is in the
// outbox; it is shown again. A window that shows the server's values has no ticks of its own: there the draft stands in these.
void RoomGuest::work_in(std::string id, std::string title) {
  if (const auto known = parked_.find(id); known != parked_.end()) {
    work_ = std::move(known->second);
    parked_.erase(known);
  } else {
    work_ = std::make_unique<DraftWork>(*registry_, outbox_.run(), std::move(id), std::move(title));
    work_->follow(fold_.confirmed(), fold_.seq(), nullptr);
    show_waiting_steps();
  }
  follow_draft();
  if (mode_ != "values")
    work_->begin_ticks(*follower_.state_with(own().shown(), work_->placed()), options_.threads, *options_.clock,
                       [this] { follower_.nudge(); });
  look_at(looked_at_);
  tell_all_changed();
  refresh();
}

Result<void> RoomGuest::begin_draft(const std::string& title) {
  leave_draft();
  if (auto ended = end_gestures(0); !ended) return ended;
  if (!end_.empty()) return Error{ErrorCode::conflict, "", end_};
  if (!has_scene_) return Error{ErrorCode::conflict, "", "the room has not sent its scene yet"};
  // Nobody else has a draft of this name: runs are random.
  const std::string id = "draft_" + outbox_.run().substr(0, 8) + "_" + std::to_string(outbox_.next_id());
  if (auto said = say_of_draft(wire::DraftOp::What::begin, id, "Begin a draft", title); !said) return said;
  work_in(id, title);
  return {};
}

Result<void> RoomGuest::enter_draft(const std::string& id) {
  leave_draft();
  if (auto ended = end_gestures(0); !ended) return ended;
  if (const auto parked = parked_.find(id); parked != parked_.end()) {
    work_in(id, parked->second->title());
    return {};
  }
  const auto& known = view("drafts");
  const auto draft = known.find(id);
  const auto content = draft == known.end() ? Result<const Json*>(Error{}) : draft->second.read();
  if (!content || text_in(**content, "state") != "open" || !has_scene_)
    return Error{ErrorCode::not_found, "", "There is no open draft of yours with this name."};
  work_in(id, text_in(**content, "title"));
  return {};
}

void RoomGuest::leave_draft() {
  if (!work_) return;
  if (auto ended = end_gestures(0); !ended) notices_.push_back(ended.error().text());
  std::erase(looked_at_, work_->id());
  work_->end_ticks();
  parked_[work_->id()] = std::move(work_);
  if (is_welcome_) say_wishes();
  fold_.show_again();
  follower_.show_nothing_more();
  tell_all_changed();
  refresh();
}

void RoomGuest::hear_answer_of_draft(const Sent& sent, bool is_stored) {
  if (!work_ && parked_.empty()) return;
  const auto said = wire::read_frame(sent.frame);
  const std::string id = said ? text_in(*said, "draft") : "";
  const auto parked = parked_.find(id);
  DraftWork* work = work_ && work_->id() == id ? work_.get() : parked == parked_.end() ? nullptr : parked->second.get();
  if (work == nullptr) return;
  const bool is_undo = text_in(*said, "do") == "undo";
  if (is_undo && is_stored) work->took_back(sent.id);
  if ((work->answered(sent.id, is_stored) || is_undo) && work == work_.get()) tell_all_changed();
}

// What a message leaves out is as it is by itself; of a draft that is its beginning.
bool RoomGuest::begins_draft(const Json& frame) {
  const std::string what = text_in(frame, "do");
  return text_in(frame, "t") == "draft" && (what.empty() || what == "begin");
}

bool RoomGuest::waits_to_begin(const std::string& draft) const {
  return std::any_of(outbox_.waiting().begin(), outbox_.waiting().end(), [&](const Sent& sent) {
    const auto said = wire::read_frame(sent.frame);
    return said && begins_draft(*said) && text_in(*said, "draft") == draft;
  });
}

// A draft that somebody proposes, discards or decides on another device can be changed here no longer. Discarded ones are not in
// the view. A view from before the last answer may lack one that has just begun.
void RoomGuest::hear_drafts(const wire::StateOut& view) {
  const auto& known = this->view("drafts");
  std::vector<std::string> closed = view.drop;
  for (const auto& [id, content] : known)
    if (const auto draft = content.read(); draft && text_in(**draft, "state") != "open") closed.push_back(id);
  std::vector<std::string> held;
  if (work_) held.push_back(work_->id());
  for (const auto& [id, draft] : parked_) held.push_back(id);
  if (view.whole && view.s >= acked_seq_)
    for (const std::string& id : held)
      if (!known.contains(id) && !waits_to_begin(id)) closed.push_back(id);
  for (const std::string& id : closed) give_up_draft(id);
}

void RoomGuest::give_up_draft(const std::string& id) {
  if (work_ && work_->id() == id) leave_draft();
  const auto parked = parked_.find(id);
  if (parked == parked_.end()) return;
  left_.push_back(std::move(parked->second));
  parked_.erase(parked);
}

void RoomGuest::propose_draft(const std::string& id, const std::string& title, const std::string& why) {
  give_up_draft(id);
  say_event("propose", JsonValue::of({{"draft", id}, {"title", title}, {"why", why}}));
}

void RoomGuest::drop_draft(const std::string& id) {
  give_up_draft(id);
  if (!end_.empty()) return;
  if (auto said = say_of_draft(wire::DraftOp::What::drop, id, "Discard a draft"); !said) notices_.push_back(said.error().text());
}

}  // namespace bl::guest
