// Which gesture of whom can be taken back or brought back: the stacks behind undo, and the rule that a log is held to.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "core/session/log.h"

namespace bl {

class Gestures {
 public:
  /// Can the entry follow on those that were taken? A gesture is one author's, and goes on only while it is that author's last;
  /// an undo takes back what its author has made and not taken back yet.
  Result<void> check(const LogEntry& entry) const;
  /// Keeps it; it has to fit. What devices say is nobody's step: nothing of it is kept, however much they say. A rewind changes
  /// no scene and is no step, either.
  void take(const LogEntry& entry);
  /// The entry as one that fits: where it takes back what stands in no entry here, it is a step like any other. So it is in a log
  /// that begins in the middle of a session.
  LogEntry fitted(const LogEntry& entry) const;

  /// The author's gestures that can be taken back, or brought back; the last one first to go.
  const std::vector<std::int64_t>& open(const Author& author, bool is_undo) const;

 private:
  struct Gesture {
    Author author;
    std::int64_t undoes = 0, redoes = 0;
    bool is_abandoned = false;
  };
  using Stacks = std::map<Author, std::vector<std::int64_t>>;  // by author

  std::map<std::int64_t, Gesture> gestures_;
  Stacks undo_, redo_;
};

}  // namespace bl
