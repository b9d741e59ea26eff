// The scene of a room as a guest sees it: what the room has stored, and on top of it what the guest has said since.
#pragma once

#include <cstdint>
#include <deque>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "core/define/json_text.h"
#include "core/graph/scene_edit.h"
#include "core/session/commands.h"
#include "core/session/log.h"

namespace bl::guest {

/// An entry of the log as a server tells it: {s, k, a, g, c or v, …}.
Result<LogEntry> entry_of(const Json& json, const Registry& registry);

class Fold {
 public:
  using Placed = std::set<std::pair<std::string, std::string>>;
  /// Time between two values of one gesture that are said [s].
  static constexpr double kBetweenValues = 0.1;

  explicit Fold(const Registry& registry);

  // What the room has stored.
  /// Begins with a scene that holds all entries up to `seq`. What is pending stays pending on top of it.
  void begin(Scene scene, std::int64_t seq);
  struct Change {
    bool is_logic_changed = false;  ///< more than the view
    Placed placed = {};
  };
  /// The next entry. One that is known already changes nothing. An error where entries are missing, or where it does not fit:
  /// then this fold is not that of the room any more.
  Result<Change> take(const LogEntry& entry);
  std::int64_t seq() const { return seq_; }
  const Scene& confirmed() const { return confirmed_; }

  // What the guest has said and nobody has answered yet.
  /// An error where it does not fit what is shown; then nothing has changed.
  Result<void> add(std::int64_t operation, Command command);
  /// The operation is answered: the room has it, or has refused it. Its command, where it had one.
  std::optional<Command> answered(std::int64_t operation);
  std::size_t pending() const { return pending_.size(); }

  // Gestures under way.
  /// One frame: it is shown at once, and waits.
  Result<void> show(std::int64_t gesture, Command command);
  /// The commands of a gesture that wait, once they are due. They do not wait any longer.
  std::vector<Command> take_due(std::int64_t gesture, double now, bool is_end);
  /// The open gestures that have something waiting.
  std::vector<std::int64_t> waiting() const;
  bool is_open(std::int64_t gesture) const { return open_.contains(gesture); }
  void end(std::int64_t gesture) { open_.erase(gesture); }
  /// Ends the gesture. What would bring back everything that was said of it; nothing where nothing was.
  std::vector<Command> drop(std::int64_t gesture);
  std::vector<std::int64_t> open() const;

  // What is shown.
  /// Stays readable until forget_past().
  const Scene& shown() const { return *shown_; }
  Placed placed() const;
  /// Is there anything beyond what the room has stored?
  bool has_own() const { return !pending_.empty() || !waiting().empty(); }
  /// Shows again what is pending and waiting, on top of what is stored. Call it once after a number of entries and answers.
  void show_again();
  void forget_past() { past_.clear(); }

 private:
  struct Pending {
    std::int64_t operation = 0;
    Command command;
    Placed placed = {};
  };
  struct Frame {
    Command command;
    std::vector<Touch> touches;
    Placed placed;
  };
  struct Gesture {
    double said_at = -std::numeric_limits<double>::infinity();
    std::vector<Frame> frames = {};  // that wait
    std::vector<Command> back = {};  // in the order to apply: what was there before
    std::set<Touch> known = {};      // places that `back` brings back
    bool is_said = false;
  };
  Scene& fresh_shown();

  const Registry* registry_;
  Scene confirmed_;
  std::optional<Namers> namers_;
  std::int64_t seq_ = 0;
  std::deque<Pending> pending_;
  std::map<std::int64_t, Gesture> open_;
  std::unique_ptr<Scene> shown_;
  std::vector<std::unique_ptr<Scene>> past_;
};

}  // namespace bl::guest
