// Gestures under way: each frame of a drag is seen at once, and said in the log ten times a second at most.
#pragma once

#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "core/session/ledger.h"

namespace bl {

/// The frames of a gesture set values, each frame anew, such as where a hand has drawn a node to. What the next frame sets again
/// before it was said is seen and never said; the last value of each place always is. Ticks know only what was said.
class OpenGestures {
 public:
  /// Time between two entries of one gesture [s].
  static constexpr double kBetweenEntries = 0.1;

  /// The ledger has to outlive it.
  explicit OpenGestures(Ledger& ledger);
  ~OpenGestures() { ledger_->unsubscribe(listener_); }
  OpenGestures(const OpenGestures&) = delete;
  OpenGestures& operator=(const OpenGestures&) = delete;

  /// One frame of the gesture that it names. `now`: seconds of a clock that never goes back, whichever it is; nothing but the
  /// number of entries depends on it. On an error nothing changes.
  Result<void> show(Submission frame, std::int64_t tick, double now);
  /// Says what has waited long enough. An error where it does not fit any more: it is not shown any longer, either.
  Result<void> say_due(std::int64_t tick, double now);
  /// Says what waits, and ends the gesture.
  Result<void> end(std::int64_t gesture, std::int64_t tick);
  /// The same for all gestures of an author.
  Result<void> end_all(const Author& author, std::int64_t tick);
  /// Ends the gesture; what waits is never said.
  void drop(std::int64_t gesture);
  bool is_open(std::int64_t gesture) const { return open_.contains(gesture); }

  /// The scene as people see it: with what waits to be said.
  const Scene& shown() const { return shown_ ? *shown_ : ledger_->scene(); }
  bool is_waiting() const;
  /// The ports that what waits has put somewhere, by node and path.
  std::set<std::pair<std::string, std::string>> placed() const;
  /// Another number for each change of what waits.
  std::uint64_t revision() const { return revision_; }

 private:
  struct Frame {
    Submission said;
    std::vector<Touch> touches;
    std::set<std::pair<std::string, std::string>> placed;
  };
  struct Gesture {
    Author author;
    double said_at = -std::numeric_limits<double>::infinity();
    std::vector<Frame> frames;  // that wait; no place of one is set by all later ones
  };
  Result<void> say(Gesture& gesture, std::int64_t tick);
  void show_again();

  Ledger* ledger_;
  std::size_t listener_;
  std::optional<Scene> shown_;  // while a gesture is open
  std::map<std::int64_t, Gesture> open_;
  std::uint64_t revision_ = 0;
  bool is_saying_ = false;
};

}  // namespace bl
