// An undo moves a gesture from its author's undo stack to the redo stack, and the other way round.
#include "core/session/gestures.h"

#include <algorithm>

namespace bl {

namespace {

const std::vector<std::int64_t>& stack_of(const std::map<Author, std::vector<std::int64_t>>& stacks, const Author& author) {
  static const std::vector<std::int64_t> kNone;
  const auto stack = stacks.find(author);
  return stack == stacks.end() ? kNone : stack->second;
}

// Mostly it is the last one.
bool holds_gesture(const std::vector<std::int64_t>& stack, std::int64_t gesture) {
  return std::find(stack.rbegin(), stack.rend(), gesture) != stack.rend();
}

Error not_there(const LogEntry& entry, const char* key, std::int64_t gesture, const char* what) {
  return {ErrorCode::not_found, key,
          "there is no gesture " + std::to_string(gesture) + " of " + entry.author.id + " that could be " + what};
}

}  // namespace

Result<void> Gestures::check(const LogEntry& entry) const {
  if (!entry.is_command()) return {};
  if (const auto before = gestures_.find(entry.gesture); before != gestures_.end()) {
    const auto& stack = stack_of(entry.undoes != 0 ? redo_ : undo_, entry.author);
    const Gesture& known = before->second;
    const bool is_same = known.author == entry.author && known.undoes == entry.undoes && known.redoes == entry.redoes &&
                         known.is_abandoned == entry.is_abandoned;
    const bool goes_on = is_same && (entry.is_abandoned || (!stack.empty() && stack.back() == entry.gesture));
    if (goes_on) return {};
    return Error{ErrorCode::conflict, "gesture",
                 "the gesture " + std::to_string(entry.gesture) + " is closed or somebody else's"};
  }
  if (entry.undoes != 0 && entry.redoes != 0)
    return Error{ErrorCode::conflict, "undoes", "an entry is either an undo or a redo, not both: remove one of the marks"};
  if (entry.undoes != 0 && !holds_gesture(stack_of(undo_, entry.author), entry.undoes))
    return not_there(entry, "undoes", entry.undoes, "undone");
  if (entry.redoes != 0 && !holds_gesture(stack_of(redo_, entry.author), entry.redoes))
    return not_there(entry, "redoes", entry.redoes, "redone");
  return {};
}

void Gestures::take(const LogEntry& entry) {
  if (entry.author.kind == AuthorKind::device || !entry.is_command()) return;
  gestures_[entry.gesture] = {entry.author, entry.undoes, entry.redoes, entry.is_abandoned};
  auto& undo = undo_[entry.author];
  auto& redo = redo_[entry.author];
  auto& stack = entry.undoes != 0 ? redo : undo;
  if (entry.undoes != 0) std::erase(undo, entry.undoes);
  else if (entry.redoes != 0) std::erase(redo, entry.redoes);
  else redo.clear();
  if (entry.is_abandoned) return;
  if (stack.empty() || stack.back() != entry.gesture) stack.push_back(entry.gesture);
}

LogEntry Gestures::fitted(const LogEntry& entry) const {
  LogEntry fitting = entry;
  if (!check(entry)) {
    fitting.undoes = fitting.redoes = 0;
    fitting.is_abandoned = false;
  }
  return fitting;
}

const std::vector<std::int64_t>& Gestures::open(const Author& author, bool is_undo) const {
  return stack_of(is_undo ? undo_ : redo_, author);
}

}  // namespace bl
