// Views are made of a moment, wait until it is stored, and go to each visitor as the difference from what they were shown last.
#include <algorithm>
#include <utility>

#include "core/serve/room_frames.h"
#include "core/serve/room_host.h"

namespace bl::serve {

namespace {

// A phone in motion gets 20 kB a second, of which the shapes may have this much [bytes/s]: more of them come less often.
constexpr double kShapeRate = 12000;
const std::string kShapes = "shapes", kPast = "past";
constexpr std::size_t kMostPast = 256 << 10;   // of all plans of before: a guest on a slow way is sent away above 1 MB [bytes]
constexpr std::size_t kSkipAbove = 256 << 10;  // what a guest has not taken yet [bytes]

}  // namespace

// Views of a moment that has read unstored entries wait until these are stored.
void RoomHost::publish() {
  const auto moment = session_->moment();
  const bool are_shapes_due = are_shapes_held_ && options_.clock->now() >= shapes_after_;
  if (next_ || (moment == seen_ && !is_changed_ && !are_shapes_due)) return;
  const bool is_same_state = seen_ && now_ && seen_->state == moment->state;
  keep_past(seen_ ? seen_->state.get() : nullptr);
  seen_ = moment;
  is_changed_ = false;
  Published made{.seq = session_->last_seq(), .tick = moment->state->tick, .commit = commits_begun_, .shared = {}, .by_seat = {}};
  const bool were_shapes_held = std::exchange(are_shapes_held_, false);
  hold_shapes(made);
  const wire::ViewSources from = sources(*moment->state);
  const bool has_events = !now_ || has_events_since(now_->seq);
  std::map<std::string, std::shared_ptr<const wire::View>> for_all;
  for (const auto& [key, visitor] : visitors_)
    for (const std::string& name : visitor.wanted) {
      auto& place = wire::is_of_seat(name) ? made.by_seat[visitor.seat][name] : made.shared[name];
      if (!place && !has_events && wire::is_of_events(name)) place = shown_to(visitor.seat, name);
      if (!place && wire::is_of_seat(name) && wire::is_as_for_all(name, from, visitor.seat)) {
        auto& common = for_all[name];
        if (!common) common = std::make_shared<const wire::View>(wire::make_view(name, from, visitor.seat));
        place = common;
      }
      if (!place && is_same_state && wire::is_of_state(name) && !(were_shapes_held && name == kShapes))
        if (const auto shown = now_->shared.find(name); shown != now_->shared.end()) place = shown->second;
      if (!place && name == kPast) place = past_view_;
      if (!place) place = std::make_shared<const wire::View>(wire::make_view(name, from, visitor.seat));
    }
  next_ = std::move(made);
  show();
}

void RoomHost::keep_past(const State* shown) {
  std::shared_ptr<const wire::View> plan;
  wire::PastPlans kept;
  for (const room::Decision& decision : room_->decisions()) {
    if (const auto known = past_.find(decision.seq); known != past_.end()) kept.insert(*known);
    if (shown == nullptr || decision.seq <= past_seq_) continue;
    if (!plan) plan = std::make_shared<const wire::View>(wire::make_view("plan", sources(*shown), 0));
    kept[decision.seq] = plan;
  }
  past_seq_ = session_->last_seq();
  const auto size_of = [](const wire::View& view) {
    std::size_t bytes = 0;
    for (const auto& [key, content] : view) bytes += key.size() + content.size();
    return bytes;
  };
  std::size_t bytes = 0;
  for (const auto& [seq, one] : kept) bytes += size_of(*one);
  for (; bytes > kMostPast; kept.erase(kept.begin())) bytes -= size_of(*kept.begin()->second);
  if (kept == past_) return;
  past_ = std::move(kept);
  past_view_ = std::make_shared<const wire::View>(wire::make_view(kPast, sources(*session_->moment()->state), 0));
}

// Until more shapes may be sent, those that are shown go on. Who is new gets these, and all go on from the same ones.
void RoomHost::hold_shapes(Published& made) {
  if (!now_ || options_.clock->now() >= shapes_after_) return;
  const auto shown = now_->shared.find(kShapes);
  if (shown == now_->shared.end()) return;
  made.shared[kShapes] = shown->second;
  are_shapes_held_ = true;
}

void RoomHost::show() {
  if (!next_ || next_->seq > stored_seq_ || next_->commit > commits_told_) return;
  hold_shapes(*next_);  // somebody may have got shapes while these views waited
  now_ = std::move(next_);
  next_.reset();
  steps_.clear();
  for (auto& [key, visitor] : visitors_) show(visitor);
}

bool RoomHost::has_events_since(std::int64_t seq) const {
  const auto& log = session_->log();
  for (auto entry = log.rbegin(); entry != log.rend() && entry->seq > seq; ++entry)
    if (!entry->is_command()) return true;
  return false;
}

std::shared_ptr<const wire::View> RoomHost::shown_to(std::int64_t seat, const std::string& name) const {
  const auto own = now_->by_seat.find(seat);
  if (wire::is_of_seat(name) && own == now_->by_seat.end()) return nullptr;
  const auto& views = wire::is_of_seat(name) ? own->second : now_->shared;
  const auto found = views.find(name);
  return found == views.end() ? nullptr : found->second;
}

void RoomHost::show(Visitor& visitor) {
  if (!now_ || !visitor.is_welcome || visitor.guest->unsent() > kSkipAbove) return;
  for (const std::string& name : visitor.wanted) {
    const std::shared_ptr<const wire::View> view = shown_to(visitor.seat, name);
    if (!view) {
      is_changed_ = true;  // it was not wanted by anybody when these views were made
      continue;
    }
    std::shared_ptr<const wire::View>& shown = visitor.shown[name];
    if (shown == view) continue;
    if (const auto frame = step(name, shown, view)) {
      if (name == kShapes)
        shapes_after_ = std::max(shapes_after_, options_.clock->now() + static_cast<double>(frame->size()) / kShapeRate);
      visitor.guest->send(frame);
    }
    shown = view;
  }
}

std::shared_ptr<const std::string> RoomHost::step(const std::string& name, const std::shared_ptr<const wire::View>& before,
                                                  const std::shared_ptr<const wire::View>& now) {
  const auto make = [&]() -> std::shared_ptr<const std::string> {
    auto changes = wire::changes_of(name, before.get(), *now, now_->tick, now_->seq);
    return changes ? frame_of(std::move(*changes)) : nullptr;
  };
  // Few share most views of seats: what is kept would only hold memory until the next views.
  if (wire::is_of_seat(name) && !wire::is_of_events(name)) return make();
  const auto [place, is_new] = steps_.try_emplace({before.get(), now.get()}, Step{before, now, nullptr});
  if (is_new) place->second.frame = make();
  return place->second.frame;
}

wire::View RoomHost::view(std::string_view name, std::int64_t seat) {
  return wire::make_view(name, sources(*session_->moment()->state), seat);
}

}  // namespace bl::serve
