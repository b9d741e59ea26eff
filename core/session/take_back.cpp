// Undo and redo: new entries reverse a gesture, except at places that others have changed since.
#include <algorithm>
#include <iterator>
#include <set>

#include "core/session/ledger.h"

namespace bl {

void Ledger::roll_back(const std::vector<Done>& trials) {
  SceneEdit edit(scene_, *registry_, &namers_);
  // Each inverse was made for exactly this scene, so it fits.
  for (auto trial = trials.rbegin(); trial != trials.rend(); ++trial)
    for (const Command& back : trial->inverse) (void)bl::apply(edit, back);
}

Result<void> Ledger::ask(const Guard& guard, const std::vector<Done>& trials) {
  Change change;
  for (const Done& trial : trials) change.touches.insert(change.touches.end(), trial.touches.begin(), trial.touches.end());
  for (auto trial = trials.rbegin(); trial != trials.rend(); ++trial)
    change.inverse.insert(change.inverse.end(), trial->inverse.begin(), trial->inverse.end());
  auto granted = guard(change);
  if (!granted) roll_back(trials);
  return granted;
}

// Applies a command, or what of it harms nobody; nothing where all of it would.
Result<std::optional<Ledger::Done>> Ledger::attempt(const Command& command, const Written& written, std::vector<Mark>& left) {
  auto done = apply_now(command);
  if (!done) return done.error();
  std::set<Touch> own;
  bool is_own = true;
  for (const Touch& place : done->touches) {
    auto other = writers_.since(place, written);
    is_own = is_own && !other;
    if (other) left.push_back(std::move(*other));
    else own.insert(place);
  }
  if (is_own) return std::optional(std::move(*done));
  const CommandDefinition& kind = *registry_->command(command.id);
  const bool can_narrow = kind.narrow && !own.empty();
  const Command narrowed = can_narrow ? kind.narrow(scene_, own) : Command();
  roll_back({std::move(*done)});
  if (!can_narrow) return std::optional<Done>();
  auto rest = apply_now(narrowed);
  return rest ? std::optional(std::move(*rest)) : std::optional<Done>();
}

std::optional<Mark> Ledger::first_since(const Written& written) const {
  for (const auto& [place, mark] : written.before)
    if (auto other = writers_.since(place, written)) return other;
  return std::nullopt;
}

// Where all only set values, what later ones set again is left out: an undo has no more entries than places.
std::vector<Ledger::Done> Ledger::without_overwritten(std::vector<Done> trials) {
  const auto only_sets = [](const Done& trial) { return std::all_of(trial.touches.begin(), trial.touches.end(), is_set_value); };
  if (!std::all_of(trials.begin(), trials.end(), only_sets)) return trials;
  std::set<Touch> later;
  std::vector<Command> needed;
  for (auto trial = trials.rbegin(); trial != trials.rend(); ++trial) {
    const bool is_overwritten =
        std::all_of(trial->touches.begin(), trial->touches.end(), [&](const Touch& place) { return later.contains(place); });
    later.insert(trial->touches.begin(), trial->touches.end());
    if (!is_overwritten || (needed.empty() && std::next(trial) == trials.rend())) needed.push_back(trial->command);
  }
  if (needed.size() == trials.size()) return trials;
  roll_back(trials);
  trials.clear();
  for (auto command = needed.rbegin(); command != needed.rend(); ++command)
    if (auto done = apply_now(*command)) trials.push_back(std::move(*done));
  return trials;
}

Result<std::vector<Ledger::Done>> Ledger::apply_harmless(const Step& step, std::vector<Mark>& left) {
  std::vector<Done> trials;
  std::optional<std::optional<Mark>> first_other;  // looked for once
  for (auto command = step.inverse.rbegin(); command != step.inverse.rend(); ++command) {
    auto trial = attempt(*command, step.written, left);
    if (trial && *trial) trials.push_back(std::move(**trial));
    if (trial) continue;
    // It does not fit any more: somebody has written over what the gesture did, or else nothing of it is taken back.
    if (!first_other) first_other = first_since(step.written);
    if (!*first_other) {
      roll_back(trials);
      return trial.error();
    }
    left.push_back(**first_other);
  }
  return without_overwritten(std::move(trials));
}

Result<TakenBack> Ledger::take_back(const Wish& wish) {
  const std::string what = wish.is_undo ? "undo" : "redo", cannot = wish.is_undo ? "cannot be undone" : "cannot be redone";
  LogEntry entry{.tick = wish.tick, .gesture = last_gesture_ + 1};
  entry.author = wish.author;
  entry.source = wish.source;
  if (auto sound = check(entry); !sound) return sound.error();
  const std::vector<std::int64_t> open = gestures_.open(wish.author, wish.is_undo);
  TakenBack taken;
  for (auto next = open.rbegin(); next != open.rend(); ++next) {
    if (wish.gesture != 0 && *next != wish.gesture) continue;
    auto trials = apply_harmless(steps_[*next], taken.left);
    if (!trials && !taken.misfit)
      taken.misfit = Error{trials.error().code, trials.error().place,
                           cannot + " because the scene has changed since: " + trials.error().message};
    if (!trials || trials->empty()) continue;
    if (wish.guard)
      if (auto granted = ask(wish.guard, *trials); !granted) return granted.error();
    taken.gesture = *next;
    std::set<Touch> told;
    std::erase_if(taken.left, [&told](const Mark& mark) { return !told.insert(mark.place).second; });
    (wish.is_undo ? entry.undoes : entry.redoes) = *next;
    entry.is_abandoned = wish.is_abandoned;
    for (Done& trial : *trials) {
      entry.command = trial.command;
      enter(entry, std::move(trial));
    }
    return taken;
  }
  if (!taken.left.empty()) return Error{ErrorCode::conflict, "", cannot + ": " + text_of(taken.left.front())};
  if (taken.misfit) return *taken.misfit;
  const auto named = std::find_if(log_.rbegin(), log_.rend(), [&](const LogEntry& e) { return e.gesture == wish.gesture; });
  if (wish.gesture != 0 && named != log_.rend() && named->is_return())
    return Error{ErrorCode::conflict, "", "a return cannot be undone: the later states were discarded"};
  return Error{ErrorCode::not_found, "", "there is nothing to " + what + " for " + wish.author.id};
}

Result<TakenBack> Ledger::undo(const Author& author, std::int64_t tick, std::int64_t gesture, const Source& source,
                               const Guard& guard) {
  return take_back({author, tick, gesture, source, true, false, guard});
}
Result<TakenBack> Ledger::abandon(const Author& author, std::int64_t tick, std::int64_t gesture) {
  return take_back({author, tick, gesture, {}, true, true, {}});
}
Result<TakenBack> Ledger::redo(const Author& author, std::int64_t tick, std::int64_t gesture, const Source& source,
                               const Guard& guard) {
  return take_back({author, tick, gesture, source, false, false, guard});
}

std::string text_of(const Mark& left) {
  const std::string who = left.writer.author.id.empty() ? "somebody" : left.writer.author.id;
  return who + " has changed " + text_of(left.place) + " since";
}

}  // namespace bl
