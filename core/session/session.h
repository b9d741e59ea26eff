// A running scene that people change by commands with submit().
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "core/file/scene_file.h"
#include "core/graph/simulation.h"
#include "core/session/ledger.h"

namespace bl {

class Session {
 public:
  /// Starts from a scene, and from its saved state if there is one.
  static Result<std::unique_ptr<Session>> start(const Registry& registry, const Scene& scene, const SavedState* state,
                                                int threads, double (*now)() = nullptr);

  /// The same as in Ledger, for the next tick.
  Result<void> submit(const Command& command, const Author& author, std::int64_t gesture = 0) {
    return ledger_.submit(command, author, state()->tick, gesture);
  }
  Result<void> submit(Submission submission) { return ledger_.submit(std::move(submission), state()->tick); }
  std::int64_t new_gesture() { return ledger_.new_gesture(); }
  Result<TakenBack> undo(const Author& author) { return ledger_.undo(author, state()->tick); }
  Result<TakenBack> redo(const Author& author) { return ledger_.redo(author, state()->tick); }
  /// An entry of a log, as in Ledger; a rewind sets the running state back.
  Result<void> replay(const LogEntry& entry);
  /// Sets the running state back to a tick whose state is kept; the scene stays the same.
  Result<void> rewind(std::int64_t tick, const Author& author);
  /// Keeps the states with which these ticks begin, so that a rewind can return to them.
  void keep_states(std::set<std::int64_t> ticks) { kept_ticks_ = std::move(ticks); }

  /// Keeps the coming state under the number of an entry, or the one that is given, so that a restart can return to it.
  void keep_moment(std::int64_t seq) { keep_moment(seq, coming_state()); }
  void keep_moment(std::int64_t seq, std::shared_ptr<const State> state) { moments_[seq] = std::move(state); }
  bool has_moment(std::int64_t seq) const { return moments_.contains(seq); }

  /// One tick with the commands since the last one. False where the work was stopped (core/base/stop): the state is then the one
  /// before, and the commands wait for the next tick.
  bool tick();
  /// As Simulation's: would the next ticks only count on, and so many of them at once. Only while no states are to be kept.
  bool is_idle() const { return simulation_.is_idle() && !ledger_.changes().is_logic_changed; }
  void pass(std::int64_t ticks) { simulation_.pass(ticks); }

  /// For gestures in progress (`open_gestures.h`).
  Ledger& ledger() { return ledger_; }
  const Scene& scene() const { return ledger_.scene(); }
  std::shared_ptr<const State> state() const { return simulation_.state(); }
  /// The state as people read it, with what no file holds: results that nodes compute from their own settings, such as the
  /// bodies of surroundings, and what links say of it. The next tick reads it, and is made for that; the session goes on from there.
  /// A state without ticks stays as nobody has looked at it.
  std::shared_ptr<const State> look();
  /// The state with which the next tick will begin, under the present scene; it is saved beside that scene.
  std::shared_ptr<const State> coming_state() const;
  const std::vector<LogEntry>& log() const { return ledger_.log(); }
  const PhaseTimes& times() const { return simulation_.times(); }
  const TickCounts& counts() const { return simulation_.counts(); }
  /// As Simulation's.
  void evaluate_everything(bool is_on) { simulation_.evaluate_everything(is_on); }
  void measure(TickTimes* times) { simulation_.measure(times); }
  /// As Ledger's.
  std::size_t subscribe(std::function<void(const LogEntry&)> listener) { return ledger_.subscribe(std::move(listener)); }
  void unsubscribe(std::size_t number) { ledger_.unsubscribe(number); }

 private:
  Session(const Registry& registry, const Scene& scene, int threads, double (*now)());

  Ledger ledger_;
  Simulation simulation_;
  std::set<std::int64_t> kept_ticks_;
  std::map<std::int64_t, std::shared_ptr<const State>> kept_;     // by tick
  std::map<std::int64_t, std::shared_ptr<const State>> moments_;  // by entry
  Result<void> restart(const LogEntry& entry);
};

/// The end of a replay, and the first tick whose hash differs from the log.
struct ReplayReport {
  std::int64_t ticks = 0, entries = 0;
  std::string hash;
  std::optional<LogCheck> first_mismatch;
  std::size_t checks = 0;
  std::size_t incomparable = 0;  ///< of the checks: hashes of another scheme than this program's, which say nothing about it
};
/// Runs a log again from its scene to its last tick.
Result<ReplayReport> replay(const LogFile& log, const Registry& registry, int threads);

}  // namespace bl
