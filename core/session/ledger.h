// A scene and the log of its commands. submit() applies commands; undo and redo are new entries.
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

/// A command of an author before it has its place in the log.
struct Submission {
  Command command = {};
  Author author = {};
  std::int64_t gesture = 0;  ///< 0: a new one
  Source source = {};
  std::string label = {};
};

/// The result of an undo or redo: the gesture, and the places that it left unchanged because another author has changed them
/// since.
struct TakenBack {
  std::int64_t gesture = 0;
  std::optional<Error> misfit;  ///< why a later gesture was skipped that does not fit the scene any more
  std::vector<Mark> left;       ///< also of later gestures that were skipped, because nothing of them could be undone
};
/// The sentence about a place that was left unchanged: "ben has changed nodes/tower/name since".
std::string text_of(const Mark& left);

/// What has been done to the scene, before it has its place in the log.
struct Change {
  std::vector<Touch> touches;
  std::vector<Command> inverse;  ///< in the order to apply
};
/// May refuse a change; then it is as if nothing had been said. Without one nothing is refused.
using Guard = std::function<Result<void>(const Change& change)>;

/// Needs no running state, so that a window can hold a ledger on one thread while another one ticks. `tick` is always the tick in
/// which the entry takes effect.
class Ledger {
 public:
  /// `base`: the number of the last entry that the scene contains already.
  Ledger(const Registry& registry, const Scene& scene, std::int64_t base = 0)
      : registry_(&registry), scene_(scene), base_(base) {}

  /// Applies a command and logs it; on an error nothing changes. Commands of one gesture of an author (such as a drag) are undone
  /// together. An operation that its origin has already sent is refused as `duplicate`.
  Result<void> submit(Submission submission, std::int64_t tick, const Guard& guard = {});
  Result<void> submit(const Command& command, const Author& author, std::int64_t tick, std::int64_t gesture = 0) {
    return submit({.command = command, .author = author, .gesture = gesture}, tick);
  }
  /// Logs something that changes no scene (`LogEntry::event`).
  Result<void> note_event(JsonValue event, const Author& author, std::int64_t tick, const Source& source = {});
  /// Logs that the running state goes back from `tick` to an earlier one. The scene and the steps that can be undone stay the
  /// same. The rewind itself cannot be undone, since later states are discarded.
  Result<void> rewind(const Author& author, std::int64_t tick, std::int64_t to);
  /// Logs that the running state goes back to the one with which an entry was made, whose hash is told.
  Result<void> restart(const Author& author, std::int64_t tick, std::int64_t from, const std::string& state_hash);
  /// The rewinds from the entry with this number on could not take place. They are called off, and what was said since belongs to
  /// the tick at which the first of them was said.
  void call_off_rewinds(std::int64_t since);
  std::int64_t new_gesture() { return ++last_gesture_; }
  /// Undoes the author's last gesture, or the named one, by new entries. Later changes of other authors stay and are reported. A
  /// gesture of which nothing can be undone is skipped.
  Result<TakenBack> undo(const Author& author, std::int64_t tick, std::int64_t gesture = 0, const Source& source = {},
                         const Guard& guard = {});
  Result<TakenBack> redo(const Author& author, std::int64_t tick, std::int64_t gesture = 0, const Source& source = {},
                         const Guard& guard = {});
  /// Undoes the gesture for good: it cannot be redone. It is for gestures that their author cancels.
  Result<TakenBack> abandon(const Author& author, std::int64_t tick, std::int64_t gesture);
  bool can_redo(const Author& author) const { return !gestures_.open(author, false).empty(); }
  /// Applies an entry of a log with its number, gesture and undo marks; an entry without a number (0) gets the next one.
  Result<void> replay(const LogEntry& entry, const Guard& guard = {});

  const Scene& scene() const { return scene_; }
  const Registry& registry() const { return *registry_; }
  const std::vector<LogEntry>& log() const { return log_; }
  /// The number of the last entry; `base` where there is none.
  std::int64_t last_seq() const { return log_.empty() ? base_ : log_.back().seq; }
  /// Registers a listener that is called with each new entry, in the order of registration. Returns the number for unsubscribe().
  std::size_t subscribe(std::function<void(const LogEntry&)> listener);
  void unsubscribe(std::size_t number) { listeners_.erase(number); }

  /// The changes since the last call, for a simulation of this scene.
  struct Changes {
    bool is_logic_changed = false;                         ///< more than the view
    std::set<std::pair<std::string, std::string>> placed;  ///< (node, path) of ports that people have set to a place
  };
  Changes take_changes();
  /// The same, without taking them.
  Changes changes() const { return {is_changed_, placed_}; }

 private:
  /// The changes of a gesture, and the commands that undo them.
  struct Step {
    std::vector<Command> inverse;  ///< the last one is applied first
    Written written;
  };
  /// A command that was applied to the scene, the places that it touched, and the commands that undo it.
  struct Done {
    Command command;
    std::vector<Command> inverse;
    std::vector<Touch> touches;
    std::set<std::pair<std::string, std::string>> placed;
    bool is_logic_touched = false;
  };
  Result<void> check(const LogEntry& entry) const;
  Result<Done> apply_now(const Command& command);
  Result<void> apply_entry(LogEntry entry, const Guard& guard = {});
  /// Gives an entry that was applied its place in the log.
  void enter(LogEntry entry, Done done);
  void note(const LogEntry& entry, const std::vector<Touch>& touches, std::vector<Command> inverse);
  struct Wish {
    const Author& author;
    std::int64_t tick, gesture;
    const Source& source;
    bool is_undo;
    bool is_abandoned = false;
    const Guard& guard;
  };
  Result<TakenBack> take_back(const Wish& wish);
  /// Applies the inverse commands of the gesture except at places that others have changed since; these places are added to
  /// `left`.
  Result<std::vector<Done>> apply_harmless(const Step& step, std::vector<Mark>& left);
  Result<std::optional<Done>> attempt(const Command& command, const Written& written, std::vector<Mark>& left);
  /// The guard's word; refused, the scene is as it was before.
  Result<void> ask(const Guard& guard, const std::vector<Done>& trials);
  /// The scene as it was before these.
  void roll_back(const std::vector<Done>& trials);
  std::vector<Done> without_overwritten(std::vector<Done> trials);
  /// The first place of the gesture that another author has changed since.
  std::optional<Mark> first_since(const Written& written) const;

  const Registry* registry_;
  Scene scene_;
  std::optional<Namers> namers_;  ///< of the scene, kept up to date through consecutive steps
  std::set<std::pair<std::string, std::string>> placed_;
  bool is_changed_ = false;
  std::vector<LogEntry> log_;
  std::map<std::int64_t, Step> steps_;  ///< by gesture
  Writers writers_;
  Gestures gestures_;
  std::int64_t base_ = 0, last_gesture_ = 0;
  std::map<std::string, std::pair<std::int64_t, std::int64_t>> operations_;  ///< by origin: the last one, and its gesture
  std::map<std::size_t, std::function<void(const LogEntry&)>> listeners_;
  std::size_t last_listener_ = 0;
};

}  // namespace bl
