// Commands in, log entries out; undo and redo as new entries.
#include "core/session/ledger.h"

#include <algorithm>
#include <iterator>
#include <optional>

#include "core/base/text.h"

namespace bl {

Inverse apply(SceneEdit& edit, const Command& command) {
  // Of the program: the registry of the scene may be replaced by what the command does.
  const CommandDefinition* definition = edit.program().command(command.id);
  if (definition == nullptr)
    return Error{ErrorCode::unknown_type, "",
                 "unknown command `" + command.id + "`" + did_you_mean(command.id, keys_of(edit.program().commands()))};
  std::vector<Value> values;
  for (const PortDefinition& port : definition->ports) {
    const auto it = command.arguments.find(port.id);
    if (it == command.arguments.end() && port.is_required)
      return Error{ErrorCode::missing, command.id, "the argument `" + port.id + "` is missing"};
    values.push_back(it == command.arguments.end() ? port.default_value : it->second);
    if (!take_in(values.back())) return Error{ErrorCode::not_finite, command.id + "/" + port.id, "must be a finite number"};
  }
  if (!definition->keeps_logic) edit.touch_logic();
  if (!definition->keeps_namers) edit.forget_namers();
  return definition->apply(edit, values);
}

Result<void> Ledger::apply_entry(LogEntry entry) {
  if (auto fits = gestures_.check(entry); !fits) return fits;
  SceneEdit edit(scene_, *registry_, &namers_);
  auto inverse = bl::apply(edit, entry.command);
  if (!inverse) return inverse.error();
  placed_.insert(edit.placed().begin(), edit.placed().end());
  is_changed_ = is_changed_ || edit.is_logic_touched();
  // Grown at its end, so that a gesture of many steps costs no more for each of them.
  auto& commands = inverses_[entry.gesture];
  commands.insert(commands.end(), std::make_move_iterator(inverse->rbegin()), std::make_move_iterator(inverse->rend()));
  last_gesture_ = std::max(last_gesture_, entry.gesture);
  entry.seq = log_.empty() ? 1 : log_.back().seq + 1;
  gestures_.take(entry);
  log_.push_back(std::move(entry));
  if (listener_) listener_(log_.back());
  return {};
}

Result<void> Ledger::submit(const Command& command, const std::string& author, std::int64_t tick, std::int64_t gesture) {
  return apply_entry({0, tick, gesture == 0 ? last_gesture_ + 1 : gesture, author, command, 0, 0});
}

Result<void> Ledger::take_back(const std::string& author, std::int64_t tick, bool is_undo) {
  const auto last = gestures_.last(author, is_undo);
  if (!last)
    return Error{ErrorCode::not_found, "",
                 is_undo ? "there is nothing to undo for " + author : "there is nothing to redo for " + author};
  const std::int64_t gesture = *last;
  const std::vector<Command> commands(inverses_[gesture].rbegin(), inverses_[gesture].rend());
  // Tried first and taken back: what somebody else removed meanwhile must not leave half of an undo behind.
  SceneEdit edit(scene_, *registry_, &namers_);
  std::vector<Command> back;  // the last one is applied first
  std::optional<Error> failure;
  for (const Command& command : commands) {
    auto done = bl::apply(edit, command);
    if (!done) {
      failure = done.error();
      break;
    }
    back.insert(back.end(), std::make_move_iterator(done->rbegin()), std::make_move_iterator(done->rend()));
  }
  // Each was made for exactly this scene, so it fits.
  std::for_each(back.rbegin(), back.rend(), [&edit](const Command& command) { (void)bl::apply(edit, command); });
  if (failure) {
    const std::string what = is_undo ? "cannot be undone" : "cannot be redone";
    return Error{failure->code, failure->place, what + " because the scene has changed since: " + failure->message};
  }
  const std::int64_t fresh = new_gesture();
  for (const Command& command : commands)
    if (auto done = apply_entry({0, tick, fresh, author, command, is_undo ? gesture : 0, is_undo ? 0 : gesture}); !done)
      return done;
  return {};
}

Result<void> Ledger::undo(const std::string& author, std::int64_t tick) { return take_back(author, tick, true); }
Result<void> Ledger::redo(const std::string& author, std::int64_t tick) { return take_back(author, tick, false); }

Result<void> Ledger::replay(const LogEntry& entry) { return apply_entry(entry); }

Ledger::Changes Ledger::take_changes() {
  Changes taken{is_changed_, std::move(placed_)};
  is_changed_ = false;
  placed_.clear();
  return taken;
}

}  // namespace bl
