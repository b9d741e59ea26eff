// Commands in, log entries out; undo and redo as new entries.
#include "core/session/ledger.h"

#include <algorithm>
#include <iterator>
#include <optional>
#include <set>

#include "core/base/text.h"

namespace bl {

namespace {

// Something that is set, in contrast to a node, role, row, lock, link or script that comes and goes.
bool is_value(const Touch& place) {
  if (place.part == ScenePart::setting) return true;
  if (place.part == ScenePart::script || place.path.empty()) return false;
  if (!place.path.starts_with("types/")) return !place.path.starts_with("locked/");
  const auto steps = std::count(place.path.begin(), place.path.end(), '/');
  return steps == 2 || steps == 4;  // types/programme/rows, types/programme/rows/housing/count
}

}  // namespace

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
  return definition->apply(edit, values);
}

Result<void> Ledger::apply_entry(LogEntry entry) {
  if (auto fits = gestures_.check(entry); !fits) return fits;
  if (entry.seq != 0 && entry.seq <= last_seq())
    return Error{ErrorCode::conflict, "seq", "the entry " + std::to_string(entry.seq) + " is in the log already"};
  SceneEdit edit(scene_, *registry_, &namers_);
  auto inverse = bl::apply(edit, entry.command);
  if (!inverse) return inverse.error();
  placed_.insert(edit.placed().begin(), edit.placed().end());
  is_changed_ = is_changed_ || edit.is_logic_touched();
  note(entry, edit.touches(), std::move(*inverse));
  last_gesture_ = std::max(last_gesture_, entry.gesture);
  if (entry.seq == 0) entry.seq = last_seq() + 1;
  gestures_.take(entry);
  log_.push_back(std::move(entry));
  if (listener_) listener_(log_.back());
  return {};
}

void Ledger::note(const LogEntry& entry, const std::vector<Touch>& touches, std::vector<Command> inverse) {
  if (entry.author.kind == AuthorKind::device) {
    Written nobodys_step{{entry.gesture, entry.author}, {}, {}};
    writers_.write(touches, nobodys_step);
    return;
  }
  Step& step = steps_[entry.gesture];
  Written& written = step.written;
  written.writer = {entry.gesture, entry.author};
  // The first inverse of a place brings back what was there before the gesture: a drag is undone in one step for each place,
  // however many there were.
  const bool is_known = std::all_of(touches.begin(), touches.end(),
                                    [&](const Touch& place) { return is_value(place) && written.before.contains(place); });
  const std::int64_t other = entry.undoes != 0 ? entry.undoes : entry.redoes;
  if (const auto known = steps_.find(other); other != 0 && known != steps_.end())
    writers_.write_back(touches, known->second.written, written);
  else writers_.write(touches, written);
  // Grown at its end, so that a gesture of many steps costs no more for each of them.
  if (!is_known || step.inverse.empty())
    step.inverse.insert(step.inverse.end(), std::make_move_iterator(inverse.rbegin()), std::make_move_iterator(inverse.rend()));
}

Result<void> Ledger::submit(const Command& command, const Author& author, std::int64_t tick, std::int64_t gesture) {
  return apply_entry({0, tick, gesture == 0 ? last_gesture_ + 1 : gesture, author, command, 0, 0});
}

// Applies a command, or what of it harms nobody; the commands that undo that, or nothing where all of it would.
Result<std::optional<Ledger::Trial>> Ledger::attempt(SceneEdit& edit, const Command& command, const Written& written,
                                                     std::vector<Mark>& left) const {
  (void)edit.take_touches();
  auto done = bl::apply(edit, command);
  if (!done) return done.error();
  std::set<Touch> own;
  bool is_own = true;
  for (const Touch& place : edit.take_touches()) {
    auto other = writers_.since(place, written);
    is_own = is_own && !other;
    if (other) left.push_back(std::move(*other));
    else own.insert(place);
  }
  if (is_own) return std::optional(Trial{command, std::move(*done)});
  const CommandDefinition& kind = *registry_->command(command.id);
  const bool can_narrow = kind.narrow && !own.empty();
  const Command narrowed = can_narrow ? kind.narrow(edit.scene(), own) : Command();
  for (const Command& inverse : *done) (void)bl::apply(edit, inverse);
  if (!can_narrow) return std::optional<Trial>();
  auto rest = bl::apply(edit, narrowed);
  if (!rest) return std::optional<Trial>();
  return std::optional(Trial{narrowed, std::move(*rest)});
}

std::optional<Mark> Ledger::first_since(const Written& written) const {
  for (const auto& [place, mark] : written.before)
    if (auto other = writers_.since(place, written)) return other;
  return std::nullopt;
}

Result<std::vector<Command>> Ledger::harmless(const Step& step, std::vector<Mark>& left) {
  // Tried first and taken back: what somebody else removed meanwhile must not leave half of an undo behind.
  SceneEdit edit(scene_, *registry_, &namers_);
  std::vector<Trial> trials;
  std::optional<Error> failure;
  std::optional<std::optional<Mark>> first_other;  // looked for once
  for (auto command = step.inverse.rbegin(); command != step.inverse.rend() && !failure; ++command) {
    auto trial = attempt(edit, *command, step.written, left);
    if (trial && *trial) trials.push_back(std::move(**trial));
    if (trial) continue;
    // It does not fit any more: somebody has written over what the gesture did, or else nothing of it is taken back.
    if (!first_other) first_other = first_since(step.written);
    if (*first_other) left.push_back(**first_other);
    else failure = trial.error();
  }
  // Each was made for exactly this scene, so it fits.
  std::vector<Command> commands;
  for (auto trial = trials.rbegin(); trial != trials.rend(); ++trial)
    for (const Command& back : trial->inverse) (void)bl::apply(edit, back);
  if (failure) return *failure;
  for (Trial& trial : trials) commands.push_back(std::move(trial.command));
  return commands;
}

Result<TakenBack> Ledger::take_back(const Author& author, std::int64_t tick, std::int64_t gesture, bool is_undo) {
  const std::string what = is_undo ? "undo" : "redo", cannot = is_undo ? "cannot be undone" : "cannot be redone";
  const std::vector<std::int64_t> open = gestures_.open(author, is_undo);
  TakenBack taken;
  for (auto next = open.rbegin(); next != open.rend(); ++next) {
    if (gesture != 0 && *next != gesture) continue;
    const auto commands = harmless(steps_[*next], taken.left);
    if (!commands && !taken.misfit)
      taken.misfit = Error{commands.error().code, commands.error().place,
                           cannot + " because the scene has changed since: " + commands.error().message};
    if (!commands || commands->empty()) continue;
    taken.gesture = *next;
    std::set<Touch> told;
    std::erase_if(taken.left, [&told](const Mark& mark) { return !told.insert(mark.place).second; });
    const std::int64_t fresh = new_gesture();
    for (const Command& command : *commands)
      if (auto done = apply_entry({0, tick, fresh, author, command, is_undo ? *next : 0, is_undo ? 0 : *next}); !done)
        return done.error();
    return taken;
  }
  if (!taken.left.empty()) return Error{ErrorCode::conflict, "", cannot + ": " + text_of(taken.left.front())};
  if (taken.misfit) return *taken.misfit;
  return Error{ErrorCode::not_found, "", "there is nothing to " + what + " for " + author.id};
}

Result<TakenBack> Ledger::undo(const Author& author, std::int64_t tick, std::int64_t gesture) {
  return take_back(author, tick, gesture, true);
}
Result<TakenBack> Ledger::redo(const Author& author, std::int64_t tick, std::int64_t gesture) {
  return take_back(author, tick, gesture, false);
}

std::string text_of(const Mark& left) {
  const std::string who = left.writer.author.id.empty() ? "somebody" : left.writer.author.id;
  return who + " has changed " + text_of(left.place) + " since";
}

Result<void> Ledger::replay(const LogEntry& entry) { return apply_entry(entry); }

Ledger::Changes Ledger::take_changes() {
  Changes taken{is_changed_, std::move(placed_)};
  is_changed_ = false;
  placed_.clear();
  return taken;
}

}  // namespace bl
