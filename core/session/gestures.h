// The gestures of each author that can be undone or redone, and the rule that the entries of a log must follow.
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
  /// Can the entry follow the ones before it? A gesture belongs to one author, and continues only while it is that author's last
  /// one. An undo applies to a gesture of its author that is not undone yet.
  Result<void> check(const LogEntry& entry) const;
  /// Records the entry, which must fit. Entries of devices are no steps and are not recorded, so that they take no memory. A
  /// rewind or an event changes no scene and is no step, either.
  void take(const LogEntry& entry);
  /// The entry changed so that it fits: an undo of a gesture that is not recorded here becomes an ordinary step. This occurs in a
  /// log that begins in the middle of a session.
  LogEntry fitted(const LogEntry& entry) const;

  /// The author's gestures that can be undone or redone; the last one comes first.
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
