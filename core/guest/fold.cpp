// What is shown is a copy of what is stored, with everything of one's own applied again.
#include "core/guest/fold.h"

#include <algorithm>

#include <nlohmann/json.hpp>

#include "core/define/codec.h"
#include "core/session/ledger.h"

namespace bl::guest {

Result<LogEntry> entry_of(const Json& json, const Registry& registry) {
  const auto number = [&](const char* key) {
    return json.contains(key) && json[key].is_number_integer() ? json[key].get<std::int64_t>() : std::int64_t{0};
  };
  const auto text = [&](const char* key) {
    return json.contains(key) && json[key].is_string() ? json[key].get<std::string>() : std::string();
  };
  if (!json.is_object() || number("s") <= 0) return Error{ErrorCode::wrong_kind, "s", "an entry has a number"};
  LogEntry entry{.seq = number("s"), .tick = number("k"), .gesture = number("g")};
  const std::string kind = text("kind");
  entry.author = {text("a"), kind == "device"    ? AuthorKind::device
                             : kind == "program" ? AuthorKind::program
                                                 : AuthorKind::person};
  entry.undoes = number("u");
  entry.redoes = number("r");
  entry.label = text("l");
  if (json.contains("v")) {
    entry.event = JsonValue::of(json["v"]);
  } else if (json.contains("c")) {
    auto command = command_from_json(registry, json["c"], "c");
    if (!command) return command.error();
    entry.command = std::move(*command);
  } else {
    return Error{ErrorCode::missing, "c", "an entry has a command or an event"};
  }
  return entry;
}

Fold::Fold(const Registry& registry) : registry_(&registry), shown_(std::make_unique<Scene>()) {}

void Fold::begin(Scene scene, std::int64_t seq) {
  confirmed_ = std::move(scene);
  namers_.reset();
  seq_ = seq;
  show_again();
}

Result<Fold::Change> Fold::take(const LogEntry& entry) {
  if (entry.seq <= seq_) return Change{};
  if (entry.seq != seq_ + 1)
    return Error{ErrorCode::missing, "s", "the entries from " + std::to_string(seq_ + 1) + " on are missing"};
  Change change;
  if (entry.is_command()) {
    SceneEdit edit(confirmed_, *registry_, &namers_);
    if (auto done = apply(edit, entry.command); !done) return done.error();
    change = {edit.is_logic_touched(), edit.placed()};
  }
  seq_ = entry.seq;
  return change;
}

Scene& Fold::fresh_shown() {
  auto copy = std::make_unique<Scene>(*shown_);
  past_.push_back(std::exchange(shown_, std::move(copy)));
  return *shown_;
}

Result<void> Fold::add(std::int64_t operation, Command command) {
  Scene trial = *shown_;
  SceneEdit edit(trial, *registry_);
  if (auto done = apply(edit, command); !done) return done.error();
  fresh_shown() = std::move(trial);
  pending_.push_back({operation, std::move(command), edit.placed()});
  return {};
}

std::optional<Command> Fold::answered(std::int64_t operation) {
  const auto found = std::find_if(pending_.begin(), pending_.end(), [&](const Pending& p) { return p.operation == operation; });
  if (found == pending_.end()) return std::nullopt;
  Command command = std::move(found->command);
  pending_.erase(found);
  return command;
}

Result<void> Fold::show(std::int64_t gesture, Command command) {
  Scene trial = *shown_;
  SceneEdit edit(trial, *registry_);
  auto inverse = apply(edit, command);
  if (!inverse) return inverse.error();
  Gesture& own = open_[gesture];
  const std::vector<Touch> touches = edit.take_touches();
  // The first inverse of a place brings back what was there before the gesture.
  const bool is_known =
      std::all_of(touches.begin(), touches.end(), [&](const Touch& place) { return own.known.contains(place); });
  if (!is_known) own.back.insert(own.back.begin(), inverse->begin(), inverse->end());
  own.known.insert(touches.begin(), touches.end());
  // A value that this one replaces needs never be said.
  std::erase_if(own.frames, [&](const Frame& frame) {
    return std::all_of(frame.touches.begin(), frame.touches.end(),
                       [&](const Touch& place) { return std::find(touches.begin(), touches.end(), place) != touches.end(); });
  });
  own.frames.push_back({std::move(command), touches, edit.placed()});
  fresh_shown() = std::move(trial);
  return {};
}

std::vector<Command> Fold::take_due(std::int64_t gesture, double now, bool is_end) {
  std::vector<Command> due;
  const auto found = open_.find(gesture);
  if (found == open_.end() || found->second.frames.empty()) return due;
  if (!is_end && now - found->second.said_at < kBetweenValues) return due;
  for (Frame& frame : found->second.frames) due.push_back(std::move(frame.command));
  found->second.frames.clear();
  found->second.said_at = now;
  found->second.is_said = true;
  return due;
}

std::vector<std::int64_t> Fold::waiting() const {
  std::vector<std::int64_t> gestures;
  for (const auto& [gesture, own] : open_)
    if (!own.frames.empty()) gestures.push_back(gesture);
  return gestures;
}

std::vector<std::int64_t> Fold::open() const {
  std::vector<std::int64_t> gestures;
  for (const auto& [gesture, own] : open_) gestures.push_back(gesture);
  return gestures;
}

std::vector<Command> Fold::drop(std::int64_t gesture) {
  const auto found = open_.find(gesture);
  if (found == open_.end()) return {};
  std::vector<Command> back;
  if (found->second.is_said) back = std::move(found->second.back);
  open_.erase(found);
  show_again();
  return back;
}

Fold::Placed Fold::placed() const {
  Placed all;
  for (const Pending& pending : pending_) all.insert(pending.placed.begin(), pending.placed.end());
  for (const auto& [gesture, own] : open_)
    for (const Frame& frame : own.frames) all.insert(frame.placed.begin(), frame.placed.end());
  return all;
}

// An operation that does not fit any more is not shown; the room's answer says what becomes of it.
void Fold::show_again() {
  Scene& scene = fresh_shown();
  scene = confirmed_;
  const auto attempt = [&](const Command& command, Placed& placed) {
    SceneEdit edit(scene, *registry_);
    placed.clear();
    if (apply(edit, command)) placed = edit.placed();
  };
  for (Pending& pending : pending_) attempt(pending.command, pending.placed);
  for (auto& [gesture, own] : open_)
    for (Frame& frame : own.frames) attempt(frame.command, frame.placed);
}

}  // namespace bl::guest
