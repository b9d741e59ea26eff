// Frames are applied to a copy of the scene for display; the ledger gets the values that are due.
#include "core/session/open_gestures.h"

#include <algorithm>

namespace bl {

namespace {

// Scenes that were shown, where nobody says that they can go.
constexpr std::size_t kMostPast = 8, kMostHeld = 1024;

bool covers(const std::vector<Touch>& places, const std::vector<Touch>& others) {
  return std::all_of(others.begin(), others.end(),
                     [&](const Touch& place) { return std::find(places.begin(), places.end(), place) != places.end(); });
}

}  // namespace

OpenGestures::OpenGestures(Ledger& ledger)
    : ledger_(&ledger), listener_(ledger.subscribe([this](const LogEntry&) {
        // What was said by others, or by an undo, lies under what waits.
        if (!is_saying_) show_again();
        hold_records();
      })) {
  hold_records();
}

void OpenGestures::forget_past() {
  past_.clear();
  held_.clear();
  hold_records();
}

// A record that changes is replaced by another one: whoever has a reference to it may go on to read the old one.
void OpenGestures::hold_records() {
  if (held_.size() >= kMostHeld) held_.erase(held_.begin(), held_.begin() + kMostHeld / 2);
  held_.push_back({ledger_->scene().nodes, ledger_->scene().links});
  if (shown_) held_.push_back({shown_->nodes, shown_->links});
}

// Anew from what was said. What does not fit any more is not seen; whoever says it hears why.
void OpenGestures::show_again() {
  if (!shown_) return;
  stop_showing();
  shown_ = std::make_unique<Scene>(ledger_->scene());
  ++revision_;
  SceneEdit edit(*shown_, ledger_->registry());
  for (const auto& [number, gesture] : open_)
    for (const Frame& frame : gesture.frames) (void)bl::apply(edit, frame.said.command);
}

void OpenGestures::stop_showing() {
  if (past_.size() == kMostPast) past_.erase(past_.begin());
  if (shown_) past_.push_back(std::move(shown_));
}

Result<void> OpenGestures::show(Submission frame, std::int64_t tick, double now) {
  const auto known = open_.find(frame.gesture);
  if (known != open_.end() && known->second.author != frame.author)
    return Error{ErrorCode::conflict, "gesture", "the gesture " + std::to_string(frame.gesture) + " is somebody else's"};
  if (!shown_) shown_ = std::make_unique<Scene>(ledger_->scene());
  SceneEdit edit(*shown_, ledger_->registry());
  auto done = bl::apply(edit, frame.command);
  hold_records();
  if (!done) {
    if (open_.empty()) stop_showing();
    return done.error();
  }
  Gesture& gesture = known != open_.end() ? known->second : open_[frame.gesture];
  gesture.author = frame.author;
  // A hand that rests says nothing.
  if (edit.touches().empty()) return say_due(tick, now);
  std::erase_if(gesture.frames, [&](const Frame& earlier) { return covers(edit.touches(), earlier.touches); });
  auto touches = edit.take_touches();
  gesture.frames.push_back({std::move(frame), std::move(touches), edit.placed()});
  ++revision_;
  return say_due(tick, now);
}

Result<void> OpenGestures::say(Gesture& gesture, std::int64_t tick) {
  if (gesture.frames.empty()) return {};
  Submission said = gesture.frames.back().said;
  if (gesture.frames.size() > 1) {
    std::vector<Command> commands;
    for (const Frame& frame : gesture.frames) commands.push_back(frame.said.command);
    said.command = command<Batch>({std::move(commands)});
  }
  gesture.frames.clear();
  ++revision_;
  is_saying_ = true;
  const auto done = ledger_->submit(std::move(said), tick);
  is_saying_ = false;
  if (!done) show_again();
  return done;
}

Result<void> OpenGestures::say_due(std::int64_t tick, double now) {
  Result<void> all;
  for (auto& [number, gesture] : open_) {
    if (gesture.frames.empty() || now - gesture.said_at < kBetweenEntries) continue;
    gesture.said_at = now;
    if (auto done = say(gesture, tick); !done) all = done;
  }
  return all;
}

Result<void> OpenGestures::end(std::int64_t number, std::int64_t tick) {
  const auto gesture = open_.find(number);
  if (gesture == open_.end()) return {};
  const auto done = say(gesture->second, tick);
  open_.erase(gesture);
  if (open_.empty()) stop_showing();
  return done;
}

Result<void> OpenGestures::end_all(const Author& author, std::int64_t tick) {
  Result<void> all;
  std::vector<std::int64_t> numbers;
  for (const auto& [number, gesture] : open_)
    if (gesture.author == author) numbers.push_back(number);
  for (const std::int64_t number : numbers)
    if (auto done = end(number, tick); !done) all = done;
  return all;
}

void OpenGestures::drop(std::int64_t number) {
  if (open_.erase(number) == 0) return;
  ++revision_;
  if (open_.empty()) stop_showing();
  else show_again();
}

bool OpenGestures::is_waiting() const {
  return std::any_of(open_.begin(), open_.end(), [](const auto& entry) { return !entry.second.frames.empty(); });
}

std::set<std::pair<std::string, std::string>> OpenGestures::placed() const {
  std::set<std::pair<std::string, std::string>> placed;
  for (const auto& [number, gesture] : open_)
    for (const Frame& frame : gesture.frames) placed.insert(frame.placed.begin(), frame.placed.end());
  return placed;
}

}  // namespace bl
