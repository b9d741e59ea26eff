// Gestures in progress: each frame of a drag is shown at once, and logged at most ten times a second.
#pragma once

#include <cstdint>
#include <limits>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "core/session/ledger.h"

namespace bl {

/// Each frame of a gesture sets values anew, such as the position of a dragged node. A value that the next frame replaces before
/// it was logged is shown and never logged; the last value of each place is always logged. Ticks use logged values only.
class OpenGestures {
 public:
  /// Time between two entries of one gesture [s].
  static constexpr double kBetweenEntries = 0.1;

  /// The ledger has to outlive it.
  explicit OpenGestures(Ledger& ledger);
  ~OpenGestures() { ledger_->unsubscribe(listener_); }
  OpenGestures(const OpenGestures&) = delete;
  OpenGestures& operator=(const OpenGestures&) = delete;

  /// Applies one frame of the named gesture. `now`: seconds of any clock that never goes back; only the number of entries depends
  /// on it. On an error nothing changes.
  Result<void> show(Submission frame, std::int64_t tick, double now);
  /// Logs the values that are due. A value that does not fit the scene any more is an error, and is no longer shown.
  Result<void> say_due(std::int64_t tick, double now);
  /// Logs the waiting values, and ends the gesture.
  Result<void> end(std::int64_t gesture, std::int64_t tick);
  /// Does the same for all gestures of an author.
  Result<void> end_all(const Author& author, std::int64_t tick);
  /// Ends the gesture; waiting values are never logged.
  void drop(std::int64_t gesture);
  bool is_open(std::int64_t gesture) const { return open_.contains(gesture); }

  /// The scene for display, with the values that wait to be logged. A returned scene can be read until forget_past() is called,
  /// even if the gesture has ended meanwhile: a window may use it while it draws.
  const Scene& shown() const { return shown_ ? *shown_ : ledger_->scene(); }
  void forget_past();
  bool is_waiting() const;
  /// The ports that waiting values have set to a place, by node and path.
  std::set<std::pair<std::string, std::string>> placed() const;
  /// A number that changes with each change of the waiting values.
  std::uint64_t revision() const { return revision_; }

 private:
  struct Frame {
    Submission said;
    std::vector<Touch> touches;
    std::set<std::pair<std::string, std::string>> placed;
  };
  struct Held {
    SharedMap<NodeRecord> nodes;
    SharedMap<LinkRecord> links;
  };
  struct Gesture {
    Author author;
    double said_at = -std::numeric_limits<double>::infinity();
    std::vector<Frame> frames;  // that wait; no place of one is set by all later ones
  };
  Result<void> say(Gesture& gesture, std::int64_t tick);
  void show_again();
  void stop_showing();
  void hold_records();

  Ledger* ledger_;
  std::size_t listener_;
  std::unique_ptr<Scene> shown_;              // while a gesture is open
  std::vector<std::unique_ptr<Scene>> past_;  // that were shown, while somebody may still read them
  std::vector<Held> held_;                    // likewise the records of all scenes since
  std::map<std::int64_t, Gesture> open_;
  std::uint64_t revision_ = 0;
  bool is_saying_ = false;
};

}  // namespace bl
