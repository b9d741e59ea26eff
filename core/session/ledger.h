// A scene and the log of what people did to it: the one verb is submit(); undo and redo are new entries.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "core/session/commands.h"
#include "core/session/gestures.h"
#include "core/session/log.h"
#include "core/session/writers.h"

namespace bl {

/// What an undo or redo has done: the gesture, and where it left things alone because somebody else has written there since.
struct TakenBack {
  std::int64_t gesture = 0;
  std::optional<Error> misfit;  ///< why a later gesture was passed over that does not fit the scene any more
  std::vector<Mark> left;       ///< also of later gestures that were passed over, because nothing of them could be taken back
};
/// The sentence of what was left: "ben has changed nodes/tower/name since".
std::string text_of(const Mark& left);

/// What people say, apart from what the scene makes of it: needs no running state, so that a window can hold a ledger on one
/// thread while another one ticks. `tick` is always the tick that the entry takes effect in.
class Ledger {
 public:
  Ledger(const Registry& registry, const Scene& scene) : registry_(&registry), scene_(scene) {}

  /// Applies a command now and logs it; on an error nothing changes. Commands of one gesture of an author (such as a drag) are
  /// undone together; gesture 0 makes a new one.
  Result<void> submit(const Command& command, const Author& author, std::int64_t tick, std::int64_t gesture = 0);
  std::int64_t new_gesture() { return ++last_gesture_; }
  /// Takes back the author's last gesture, or the one that is named, by new entries. What others wrote since stays as it is, and
  /// is told; a gesture of which nothing can be taken back is passed over.
  Result<TakenBack> undo(const Author& author, std::int64_t tick, std::int64_t gesture = 0);
  Result<TakenBack> redo(const Author& author, std::int64_t tick, std::int64_t gesture = 0);
  /// An entry of a log, with its number, gesture and undo marks as they were; one without a number (0) gets the next.
  Result<void> replay(const LogEntry& entry);

  const Scene& scene() const { return scene_; }
  const std::vector<LogEntry>& log() const { return log_; }
  /// The number of the last entry; 0 where there is none.
  std::int64_t last_seq() const { return log_.empty() ? 0 : log_.back().seq; }
  /// Called with each new entry, to write it down at once.
  void on_entry(std::function<void(const LogEntry&)> listener) { listener_ = std::move(listener); }

  /// What a simulation of this scene has to hear of since the last call.
  struct Changes {
    bool is_logic_changed = false;                         ///< more than the view
    std::set<std::pair<std::string, std::string>> placed;  ///< (node, path) of ports that people have put somewhere
  };
  Changes take_changes();
  /// The same, without taking them.
  Changes changes() const { return {is_changed_, placed_}; }

 private:
  /// What a gesture has done, and how it is undone.
  struct Step {
    std::vector<Command> inverse;  ///< the last one is applied first
    Written written;
  };
  Result<void> apply_entry(LogEntry entry);
  void note(const LogEntry& entry, const std::vector<Touch>& touches, std::vector<Command> inverse);
  Result<TakenBack> take_back(const Author& author, std::int64_t tick, std::int64_t gesture, bool is_undo);
  /// The commands that undo the gesture and change nothing that others have written since; what they leave is added to `left`.
  Result<std::vector<Command>> harmless(const Step& step, std::vector<Mark>& left);
  /// A command that was applied, and the commands that undo it.
  struct Trial {
    Command command;
    std::vector<Command> inverse;
  };
  Result<std::optional<Trial>> attempt(SceneEdit& edit, const Command& command, const Written& written,
                                       std::vector<Mark>& left) const;
  /// The first place that the gesture wrote and somebody else has written since.
  std::optional<Mark> first_since(const Written& written) const;

  const Registry* registry_;
  Scene scene_;
  std::optional<Namers> namers_;  ///< of the scene, while steps that keep it true follow each other
  std::set<std::pair<std::string, std::string>> placed_;
  bool is_changed_ = false;
  std::vector<LogEntry> log_;
  std::map<std::int64_t, Step> steps_;  ///< by gesture
  Writers writers_;
  Gestures gestures_;
  std::int64_t last_gesture_ = 0;
  std::function<void(const LogEntry&)> listener_;
};

}  // namespace bl
