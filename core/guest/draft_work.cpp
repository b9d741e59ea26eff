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

DraftWork::DraftWork(const Registry& registry, std::string run, std::string id, std::string title)
    : registry_(&registry), run_(std::move(run)), id_(std::move(id)), title_(std::move(title)), fold_(registry) {}

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

void DraftWork::follow(const Scene& head, std::int64_t seq, const std::map<std::string, JsonValue>* view) {
  head_ = head;
  seq_ = seq;
  if (view != nullptr) follow_steps(*view);
  make_base();
}

// The view tells the steps as they are after the last operation of this run that the room has taken. What was said here up to
// that one is told, refused or taken back, whatever answers are under way or lost. A step that is new, or is gone, puts what it
// moved to its place once more.
void DraftWork::follow_steps(const std::map<std::string, JsonValue>& view) {
  const auto counted = view.find("/" + run_);
  taken_ = counted == view.end() ? 0 : step_number(counted->second.text()).value_or(0);
  std::map<std::int64_t, Step> known;
  // A server that does not count this run is of an earlier program, or has lost the end of its record: it has told what it has.
  if (counted == view.end() && !view.empty())
    for (auto own = own_.begin(); own != own_.end();) {
      const auto one = own++;
      if (one->second.is_stored) known.insert(own_.extract(one));
    }
  while (!own_.empty() && own_.begin()->first <= taken_) {
    auto own = own_.extract(own_.begin());
    (void)fold_.answered(own.key());
    known.insert(std::move(own));
  }
  std::map<std::int64_t, Step> told;
  const std::string begin = id_ + "/";
  for (auto one = view.lower_bound(begin); one != view.end() && one->first.starts_with(begin); ++one) {
    const auto number = step_number(std::string_view(one->first).substr(begin.size()));
    if (!number) continue;
    const JsonValue& content = one->second;
    const auto before = steps_.find(*number);
    // Of two own ones that say the same, either is as good: only what they have moved is taken from it.
    const auto own = std::find_if(known.begin(), known.end(), [&](const auto& step) { return step.second.content == content; });
    if (before != steps_.end() && before->second.content == content) {
      told.insert(steps_.extract(before));
    } else if (own != known.end()) {
      told[*number] = std::move(own->second);
      known.erase(own);
    } else if (const auto json = content.read()) {
      if (auto command = command_from_json(*registry_, **json, "c")) told[*number] = {content, std::move(*command)};
    }
  }
  for (const auto* gone : {&steps_, &known})
    for (const auto& [number, step] : *gone) moved_.insert(step.placed.begin(), step.placed.end());
  steps_ = std::move(told);
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
  JsonValue content = JsonValue::of(command_to_json(*registry_, command));
  if (auto done = fold_.add(operation, command); !done) return done;
  own_[operation] = {std::move(content), std::move(command)};
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
