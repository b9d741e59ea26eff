// Commands in, log entries out.
#include "core/session/ledger.h"

#include <algorithm>
#include <iterator>

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
    if (!make_storable(values.back())) return Error{ErrorCode::not_finite, command.id + "/" + port.id, "must be a finite number"};
  }
  return definition->apply(edit, values);
}

// An undo or redo may be several entries of one operation; all else is taken once.
Result<void> Ledger::check(const LogEntry& entry) const {
  const auto& [origin, operation] = entry.source;
  const auto last = operations_.find(origin);
  const bool goes_on = last != operations_.end() && last->second == std::pair(operation, entry.gesture) &&
                       (entry.undoes != 0 || entry.redoes != 0);
  if (operation != 0 && last != operations_.end() && operation <= last->second.first && !goes_on)
    return Error{ErrorCode::duplicate, "operation",
                 "the operation " + std::to_string(operation) + " of `" + origin + "` was applied already, or comes too late"};
  if (auto fits = gestures_.check(entry); !fits) return fits;
  if (entry.seq != 0 && entry.seq <= last_seq())
    return Error{ErrorCode::conflict, "seq", "the entry " + std::to_string(entry.seq) + " is in the log already"};
  return {};
}

Result<Ledger::Done> Ledger::apply_now(const Command& command) {
  SceneEdit edit(scene_, *registry_, &namers_);
  auto inverse = bl::apply(edit, command);
  if (!inverse) return inverse.error();
  return Done{command, std::move(*inverse), edit.take_touches(), edit.placed(), edit.is_logic_touched()};
}

Result<void> Ledger::apply_entry(LogEntry entry, const Guard& guard) {
  if (auto sound = check(entry); !sound) return sound;
  if (!entry.is_command()) {
    enter(std::move(entry), {});
    return {};
  }
  auto done = apply_now(entry.command);
  if (!done) return done.error();
  if (guard)
    if (auto granted = ask(guard, {*done}); !granted) return granted;
  enter(std::move(entry), std::move(*done));
  return {};
}

void Ledger::enter(LogEntry entry, Done done) {
  placed_.merge(done.placed);
  is_changed_ = is_changed_ || done.is_logic_touched;
  if (entry.is_command()) note(entry, done.touches, std::move(done.inverse));
  last_gesture_ = std::max(last_gesture_, entry.gesture);
  if (entry.seq == 0) entry.seq = last_seq() + 1;
  if (entry.source.operation != 0) operations_[entry.source.origin] = {entry.source.operation, entry.gesture};
  gestures_.take(entry);
  log_.push_back(std::move(entry));
  for (const auto& [number, listener] : listeners_) listener(log_.back());
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
                                    [&](const Touch& place) { return is_set_value(place) && written.before.contains(place); });
  const std::int64_t other = entry.undoes != 0 ? entry.undoes : entry.redoes;
  if (const auto known = steps_.find(other); other != 0 && known != steps_.end())
    writers_.write_back(touches, known->second.written, written);
  else writers_.write(touches, written);
  // Grown at its end, so that a gesture of many steps costs no more for each of them.
  if (!is_known || step.inverse.empty())
    step.inverse.insert(step.inverse.end(), std::make_move_iterator(inverse.rbegin()), std::make_move_iterator(inverse.rend()));
}

Result<void> Ledger::submit(Submission said, std::int64_t tick, const Guard& guard) {
  LogEntry entry{.tick = tick, .gesture = said.gesture == 0 ? last_gesture_ + 1 : said.gesture};
  entry.author = std::move(said.author);
  entry.command = std::move(said.command);
  entry.source = std::move(said.source);
  entry.label = std::move(said.label);
  return apply_entry(std::move(entry), guard);
}

Result<void> Ledger::note_event(JsonValue event, const Author& author, std::int64_t tick, const Source& source) {
  LogEntry entry{.tick = tick};
  entry.author = author;
  entry.source = source;
  entry.event = std::move(event);
  return apply_entry(std::move(entry));
}

Result<void> Ledger::rewind(const Author& author, std::int64_t tick, std::int64_t to) {
  if (to >= tick) return Error{ErrorCode::out_of_range, "rewind", "tick " + std::to_string(to) + " is not over yet"};
  LogEntry entry{.tick = tick, .gesture = last_gesture_ + 1};
  entry.author = author;
  entry.rewinds_to = to;
  return apply_entry(std::move(entry));
}

Result<void> Ledger::restart(const Author& author, std::int64_t tick, std::int64_t from, const std::string& state_hash) {
  if (from > last_seq()) return Error{ErrorCode::out_of_range, "restart", "there is no entry " + std::to_string(from) + " yet"};
  LogEntry entry{.tick = tick, .gesture = last_gesture_ + 1};
  entry.author = author;
  entry.restarts_from = from;
  entry.state_hash = state_hash;
  return apply_entry(std::move(entry));
}

void Ledger::call_off_rewinds(std::int64_t since) {
  const auto first =
      std::lower_bound(log_.begin(), log_.end(), since, [](const LogEntry& entry, std::int64_t seq) { return entry.seq < seq; });
  for (auto entry = first; entry != log_.end(); ++entry) {
    entry->tick = first->tick;
    entry->is_called_off = entry->rewinds_to.has_value();
  }
}

std::size_t Ledger::subscribe(std::function<void(const LogEntry&)> listener) {
  listeners_.emplace(++last_listener_, std::move(listener));
  return last_listener_;
}

Result<void> Ledger::replay(const LogEntry& entry, const Guard& guard) { return apply_entry(entry, guard); }

Ledger::Changes Ledger::take_changes() {
  Changes taken{is_changed_, std::move(placed_)};
  is_changed_ = false;
  placed_.clear();
  return taken;
}

}  // namespace bl
