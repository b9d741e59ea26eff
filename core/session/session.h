// A running scene that people change by commands: the one verb is submit().
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "core/file/scene_file.h"
#include "core/graph/simulation.h"
#include "core/session/commands.h"
#include "core/session/log.h"

namespace bl {

class Session {
 public:
  /// Starts from a scene, and from its saved state where there is one.
  static Result<std::unique_ptr<Session>> start(const Registry& registry, const Scene& scene, const SavedState* state,
                                                int threads, double (*now)() = nullptr);

  /// Applies a command now and logs it for the coming tick; on an error nothing changes. Commands of one gesture of an author
  /// (such as a drag) are undone together; gesture 0 makes a new one.
  Result<void> submit(const Command& command, const std::string& author, std::int64_t gesture = 0);
  std::int64_t new_gesture() { return ++last_gesture_; }
  /// Takes back the author's last gesture by new entries; what others did since stays.
  Result<void> undo(const std::string& author);
  Result<void> redo(const std::string& author);
  /// An entry of a log, with its gesture and undo marks as they were.
  Result<void> replay(const LogEntry& entry);

  /// One tick; the commands since the last one take part.
  void tick();

  const Scene& scene() const { return scene_; }
  std::shared_ptr<const State> state() const { return simulation_.state(); }
  const std::vector<LogEntry>& log() const { return log_; }
  const PhaseTimes& times() const { return simulation_.times(); }
  /// Called with each new entry, to write it down at once.
  void on_entry(std::function<void(const LogEntry&)> listener) { listener_ = std::move(listener); }

 private:
  Session(const Registry& registry, const Scene& scene, int threads, double (*now)());
  Result<void> apply_entry(LogEntry entry);
  Result<void> take_back(const std::string& author, std::map<std::string, std::vector<std::int64_t>>& stack, bool is_undo);
  void stack_up(const LogEntry& entry);

  const Registry* registry_;
  Scene scene_;
  Simulation simulation_;
  std::set<std::pair<std::string, std::string>> placed_;
  bool is_changed_ = false;
  std::vector<LogEntry> log_;
  std::map<std::int64_t, std::vector<Command>> inverses_;  ///< by gesture, in the order to apply
  std::map<std::int64_t, std::string> gesture_authors_;
  std::map<std::string, std::vector<std::int64_t>> undo_, redo_;  ///< gestures by author
  std::int64_t last_gesture_ = 0;
  std::function<void(const LogEntry&)> listener_;
};

/// The end of a replay, and where it first left the path of the log.
struct ReplayReport {
  std::int64_t ticks = 0, entries = 0;
  std::string hash;
  std::optional<LogCheck> first_mismatch;
  std::size_t checks = 0;
};
/// Runs a log again from its scene to its last tick.
Result<ReplayReport> replay(const LogFile& log, const Registry& registry, int threads);

}  // namespace bl
