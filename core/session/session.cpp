// Commands in, log out, ticks between; undo and redo as new entries.
#include "core/session/session.h"

#include <algorithm>

#include "core/base/text.h"

namespace bl {

Inverse apply(SceneEdit& edit, const Command& command) {
  const CommandDefinition* definition = edit.registry().command(command.id);
  if (definition == nullptr)
    return Error{ErrorCode::unknown_type, "",
                 "unknown command `" + command.id + "`" + did_you_mean(command.id, keys_of(edit.registry().commands()))};
  std::vector<Value> values;
  for (const PortDefinition& port : definition->ports) {
    const auto it = command.arguments.find(port.id);
    if (it == command.arguments.end() && port.is_required)
      return Error{ErrorCode::missing, command.id, "the argument `" + port.id + "` is missing"};
    values.push_back(it == command.arguments.end() ? port.default_value : it->second);
  }
  return definition->apply(edit, values);
}

Session::Session(const Registry& registry, const Scene& scene, int threads, double (*now)())
    : registry_(&registry), scene_(scene), simulation_(registry, threads, now) {
  simulation_.set_scene(scene_);
}

Result<std::unique_ptr<Session>> Session::start(const Registry& registry, const Scene& scene, const SavedState* state,
                                                int threads, double (*now)()) {
  std::unique_ptr<Session> session(new Session(registry, scene, threads, now));
  if (state != nullptr)
    if (auto restored = session->simulation_.restore_state(*state); !restored) return restored.error();
  return session;
}

Result<void> Session::apply_entry(LogEntry entry) {
  // A gesture is one author's, and goes on only while it is that author's last; others may act in between.
  if (const auto owner = gesture_authors_.find(entry.gesture); owner != gesture_authors_.end()) {
    const auto& stack = entry.undoes != 0 ? redo_[entry.author] : undo_[entry.author];
    if (owner->second != entry.author || stack.empty() || stack.back() != entry.gesture)
      return Error{ErrorCode::conflict, "gesture",
                   "the gesture " + std::to_string(entry.gesture) + " is closed or somebody else's"};
  }
  SceneEdit edit(scene_, *registry_);
  auto inverse = bl::apply(edit, entry.command);
  if (!inverse) return inverse.error();
  placed_.insert(edit.placed().begin(), edit.placed().end());
  is_changed_ = true;
  gesture_authors_[entry.gesture] = entry.author;
  auto& commands = inverses_[entry.gesture];
  commands.insert(commands.begin(), inverse->begin(), inverse->end());
  last_gesture_ = std::max(last_gesture_, entry.gesture);
  entry.seq = log_.empty() ? 1 : log_.back().seq + 1;
  entry.tick = state()->tick;
  stack_up(entry);
  log_.push_back(std::move(entry));
  if (listener_) listener_(log_.back());
  return {};
}

// Keeps the stacks of gestures: an undo moves one from the author's undo stack to the redo stack, and the other way round.
void Session::stack_up(const LogEntry& entry) {
  auto& undo = undo_[entry.author];
  auto& redo = redo_[entry.author];
  if (entry.undoes != 0) {
    std::erase(undo, entry.undoes);
    if (redo.empty() || redo.back() != entry.gesture) redo.push_back(entry.gesture);
    return;
  }
  if (entry.redoes != 0) std::erase(redo, entry.redoes);
  else redo.clear();
  if (undo.empty() || undo.back() != entry.gesture) undo.push_back(entry.gesture);
}

Result<void> Session::submit(const Command& command, const std::string& author, std::int64_t gesture) {
  return apply_entry({0, 0, gesture == 0 ? last_gesture_ + 1 : gesture, author, command, 0, 0});
}

Result<void> Session::take_back(const std::string& author, std::map<std::string, std::vector<std::int64_t>>& stack,
                                bool is_undo) {
  if (stack[author].empty())
    return Error{ErrorCode::not_found, "",
                 is_undo ? "there is nothing to undo for " + author : "there is nothing to redo for " + author};
  const std::int64_t gesture = stack[author].back();
  const std::vector<Command> commands = inverses_[gesture];
  // Tried on a copy first: what somebody else removed meanwhile must not leave half of an undo behind.
  Scene trial = scene_;
  SceneEdit edit(trial, *registry_);
  for (const Command& command : commands)
    if (auto done = bl::apply(edit, command); !done) {
      const std::string what = is_undo ? "cannot be undone" : "cannot be redone";
      return Error{done.error().code, done.error().place, what + " because the scene has changed since: " + done.error().message};
    }
  const std::int64_t fresh = new_gesture();
  for (const Command& command : commands)
    if (auto done = apply_entry({0, 0, fresh, author, command, is_undo ? gesture : 0, is_undo ? 0 : gesture}); !done) return done;
  return {};
}

Result<void> Session::undo(const std::string& author) { return take_back(author, undo_, true); }
Result<void> Session::redo(const std::string& author) { return take_back(author, redo_, false); }

Result<void> Session::replay(const LogEntry& entry) { return apply_entry(entry); }

void Session::tick() {
  if (is_changed_) simulation_.set_scene(scene_, placed_);
  placed_.clear();
  is_changed_ = false;
  simulation_.step();
}

namespace {

// Compares all checks that stand at the tick now reached.
void compare(const LogFile& log, const State& state, ReplayReport& report) {
  for (const LogCheck& check : log.checks) {
    if (check.tick != state.tick) continue;
    ++report.checks;
    if (check.hash != hex_digits(state.hash) && !report.first_mismatch) report.first_mismatch = check;
  }
}

}  // namespace

Result<ReplayReport> replay(const LogFile& log, const Registry& registry, int threads) {
  SceneReading reading = read_scene(log.scene, registry);
  if (!reading.is_usable()) return reading.first_error().within("scene");
  auto session = Session::start(registry, reading.scene, reading.state ? &*reading.state : nullptr, threads);
  if (!session) return session.error();
  ReplayReport report;
  compare(log, *(*session)->state(), report);
  std::int64_t last = (*session)->state()->tick;
  for (const LogEntry& entry : log.entries) last = std::max(last, entry.tick);
  for (const LogCheck& check : log.checks) last = std::max(last, check.tick);
  for (const LogEntry& entry : log.entries) {
    while ((*session)->state()->tick < entry.tick) {
      (*session)->tick();
      compare(log, *(*session)->state(), report);
    }
    if (auto done = (*session)->replay(entry); !done) return done.error().within("entry " + std::to_string(entry.seq));
    ++report.entries;
  }
  while ((*session)->state()->tick < last) {
    (*session)->tick();
    compare(log, *(*session)->state(), report);
  }
  report.ticks = (*session)->state()->tick;
  report.hash = hex_digits((*session)->state()->hash);
  return report;
}

}  // namespace bl
