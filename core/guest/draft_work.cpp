// The room is right about the steps; what it has not told yet stands on top of them.
#include "core/guest/draft_work.h"

#include <algorithm>
#include <charconv>

#include <nlohmann/json.hpp>

#include "core/define/codec.h"
#include "core/session/ledger.h"

namespace bl::guest {

namespace {

std::optional<std::int64_t> step_number(std::string_view text) {
  std::int64_t number = 0;
  const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), number);
  return fault == std::errc() && end == text.data() + text.size() ? std::optional(number) : std::nullopt;
}

}  // namespace

DraftWork::DraftWork(const Registry& registry, std::string id, std::string title)
    : registry_(&registry), id_(std::move(id)), title_(std::move(title)), fold_(registry) {}

Fold::Placed DraftWork::placed() const {
  Fold::Placed all = fold_.placed();
  for (const auto* steps : {&steps_, &own_})
    for (const auto& [number, step] : *steps) all.insert(step.placed.begin(), step.placed.end());
  return all;
}

std::size_t DraftWork::step_count() const {
  const auto count = std::count_if(own_.begin(), own_.end(), [](const auto& one) { return !one.second.is_taken_back; });
  return steps_.size() + static_cast<std::size_t>(count);
}

void DraftWork::follow(const Scene& head, std::int64_t seq, const std::map<std::string, JsonValue>* view, bool is_whole) {
  head_ = head;
  seq_ = seq;
  if (view != nullptr) follow_steps(*view, is_whole);
  make_base();
}

// A step that is new, or is gone, puts what it moved to its place once more. Another device of the seat may have taken a step
// back that this window has never been told of; one that is newer than a whole view comes back with the next.
void DraftWork::follow_steps(const std::map<std::string, JsonValue>& view, bool is_whole) {
  std::map<std::int64_t, Step> told;
  const std::string begin = id_ + "/";
  for (auto one = view.lower_bound(begin); one != view.end() && one->first.starts_with(begin); ++one) {
    const auto number = step_number(std::string_view(one->first).substr(begin.size()));
    const auto json = one->second.read();
    if (!number || !json) continue;
    std::string text = write_json_line(**json);
    const auto is_same = [&](const auto& step) { return step.second.text == text; };
    if (const auto known = steps_.find(*number); known != steps_.end() && is_same(*known)) {
      told.insert(steps_.extract(known));
    } else if (const auto own = std::find_if(own_.begin(), own_.end(), is_same); own != own_.end()) {
      (void)fold_.answered(own->first);
      told[*number] = std::move(own->second);
      own_.erase(own);
    } else if (auto command = command_from_json(*registry_, **json, "c")) {
      told[*number] = {std::move(text), std::move(*command)};
    }
  }
  for (const auto& [number, gone] : steps_) moved_.insert(gone.placed.begin(), gone.placed.end());
  steps_ = std::move(told);
  if (!is_whole) return;
  for (const auto& [operation, step] : own_)
    if (step.is_stored) moved_.insert(step.placed.begin(), step.placed.end());
  std::erase_if(own_, [](const auto& one) { return one.second.is_stored; });
}

void DraftWork::make_base() {
  Scene scene = head_;
  const auto add = [&](Step& step) {
    SceneEdit edit(scene, *registry_);
    const Fold::Placed before = std::exchange(step.placed, {});
    if (!apply(edit, step.command)) return;
    step.placed = edit.placed();
    if (step.placed != before) moved_.insert(step.placed.begin(), step.placed.end());
  };
  for (auto& [number, step] : steps_) add(step);
  for (auto& [operation, step] : own_)
    if (step.is_stored) add(step);
  fold_.begin(std::move(scene), seq_);
}

// --- What is said here ----------------------------------------------------------------------------------------------

Result<void> DraftWork::say(std::int64_t operation, Command command) {
  std::string text = write_json_line(command_to_json(*registry_, command));
  if (auto done = fold_.add(operation, command); !done) return done;
  own_[operation] = {std::move(text), std::move(command)};
  return {};
}

void DraftWork::unsay(std::int64_t operation) {
  (void)fold_.answered(operation);
  fold_.show_again();
  own_.erase(operation);
}

bool DraftWork::answered(std::int64_t operation, bool is_stored) {
  const auto own = own_.find(operation);
  if (own == own_.end()) return false;
  (void)fold_.answered(operation);
  const bool is_taken_back = own->second.is_taken_back;
  if (is_stored && !is_taken_back) own->second.is_stored = true;
  else own_.erase(own);
  if (!is_stored && is_taken_back) took_back(operation);  // it was the one before, then
  else make_base();
  return true;
}

// A step that the room has told already, it will also tell to be gone. One without an answer is known to have been stored: else
// the room could not have taken it back.
void DraftWork::took_back(std::int64_t operation) {
  auto last = own_.lower_bound(operation);
  while (last != own_.begin()) {
    --last;
    if (last->second.is_taken_back) continue;
    moved_.insert(last->second.placed.begin(), last->second.placed.end());
    if (last->second.is_stored) {
      own_.erase(last);
    } else {
      last->second.is_taken_back = true;
      (void)fold_.answered(last->first);
    }
    break;
  }
  make_base();
}

// --- Ticks ----------------------------------------------------------------------------------------------------------

void DraftWork::begin_ticks(const State& state, int threads, host::Clock& clock, std::function<void()> wake) {
  const SavedState saved = save(state);
  auto ticks = std::make_unique<Follower>(*registry_, threads, clock);
  if (!ticks->begin(fold_.shown(), &saved)) return;
  ticks->subscribe([wake = std::move(wake)](const auto&) { wake(); });
  marked_ = ticks->tick();
  ticks_ = std::move(ticks);
}

double DraftWork::keep_ticking(double now, double rate, bool is_playing) {
  if (!ticks_) return now + 1;
  ticks_->set_pace(is_playing, rate);
  if (!is_playing) return now + 1;
  // Ticks that take too long are not made up for.
  if (now >= due_ && ticks_->behind() <= 1) {
    ticks_->mark({.tick = ++marked_});
    due_ = std::max(due_ + 1 / rate, now);
  }
  // A tick that takes longer wakes whoever waits for it.
  return ticks_->behind() > 1 ? now + 1 / rate : std::max(due_, now);
}

void DraftWork::show() {
  if (!ticks_) return;
  Fold::Placed placed = fold_.placed();
  placed.merge(std::exchange(moved_, {}));
  ticks_->set_next(fold_.shown(), std::move(placed));
}

}  // namespace bl::guest
