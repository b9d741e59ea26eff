// A scene that ticks on a thread of its own while people edit it: commands take effect at once, ticks never wait for people.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/graph/simulation.h"
#include "core/host/clock.h"
#include "core/host/past.h"
#include "core/session/open_gestures.h"

namespace bl::host {

/// The last publication of the ticking thread. Its content stays unchanged as long as a pointer to it exists.
struct Moment {
  std::shared_ptr<const State> state;   ///< with people's changes since the last tick, where they are shown already
  std::shared_ptr<const State> ticked;  ///< as the last tick left it
  /// The scene that the last tick has read, and the last entry in it; none where the ticks are those of a room elsewhere. Who
  /// goes on from `ticked` needs both: the next tick reads all that was said since then at once.
  std::shared_ptr<const Scene> scene = nullptr;
  std::int64_t seq = 0;
  bool is_playing = false;
  bool is_resting = false;        ///< the clock counts on and nothing else happens; the ticks since then are not in `state`
  double wanted_rate = 0;         ///< wanted ticks per second
  double tick_seconds = 0;        ///< duration of a tick, smoothed [s]
  double rate = 0;                ///< reached ticks per second, smoothed
  std::int64_t oldest = 0;        ///< the first tick that rewinding can reach
  bool has_forgotten = false;     ///< ticks before `oldest` were given up: the history has reached its limit
  std::size_t history_bytes = 0;  ///< about what the history takes
  std::shared_ptr<const TimeTable> times;  ///< where the time of the ticks goes, where somebody watches; a moment old at most
  std::string failure;  ///< why the ticks stopped: out of memory, or an error of the program; the state is the last good one

  bool is_behind() const { return is_playing && !is_resting && tick_seconds * wanted_rate > 1.05; }
};

/// The holder of a session, and its clock and threads.
struct LiveSessionOptions {
  Author author = {};                                 ///< the author of the holder's commands
  std::string origin = {};                            ///< the origin of the holder's commands, such as `window`
  int threads = 1;                                    ///< of the ticks
  Clock* clock = &real_clock();                       ///< must outlive the session
  std::size_t most_history_bytes = Past::kMostBytes;  ///< beyond that the oldest ticks can no longer be returned to
};

class LiveSession {
 public:
  /// The scene must be usable.
  static Result<std::unique_ptr<LiveSession>> start(const Registry& registry, const Scene& scene, const SavedState* state,
                                                    LiveSessionOptions options);
  /// Goes on with a session: `beginning` is the scene with which its log began, behind the entry `base`; `history` applies all
  /// entries since, without ticks; `state` is the running state that belongs to the scene after them.
  static Result<std::unique_ptr<LiveSession>> go_on(const Registry& registry, const Scene& beginning, std::int64_t base,
                                                    const std::function<Result<void>(Ledger&)>& history, const SavedState* state,
                                                    LiveSessionOptions options);
  ~LiveSession();
  LiveSession(const LiveSession&) = delete;
  LiveSession& operator=(const LiveSession&) = delete;

  // Of the holder's thread: the scene as people have left it, and the ways to change it. Commands are checked and applied at
  // once; the ticks see them from the next one on.
  /// The scene with the values of gestures in progress. A returned scene can be read until keep_up() is called.
  const Scene& scene() const { return gestures_.shown(); }
  /// The scene without them, as the log has it.
  const Scene& said() const { return ledger_.scene(); }
  /// It only grows: a rewind that failed stays in it, called off.
  const std::vector<LogEntry>& log() const;
  std::int64_t last_seq() const { return ledger_.last_seq(); }
  const Author& author() const { return options_.author; }
  /// Submits a command of the holder. Waiting values of a gesture of the holder are logged first, unless the command belongs to
  /// that gesture.
  Result<void> submit(const Command& command, std::int64_t gesture = 0, const std::string& label = "");
  /// Submits a command of any author: a device, a script, a person at another screen.
  Result<void> submit(Submission submission);
  /// Runs words that change the ledger between two ticks, told the tick that will read them: for whoever checks what people say
  /// before it is applied. Of the holder's thread, as all of this.
  void say(const std::function<void(Ledger& ledger, std::int64_t tick)>& words);
  /// The same while no tick runs: told the state with which the coming tick will begin. Where the words give a state, such as one
  /// that was told before, the session goes back to it under the scene that they have left; they have logged that as a restart.
  void say_between_ticks(
      const std::function<std::shared_ptr<const State>(Ledger& ledger, const std::shared_ptr<const State>& coming)>& words);
  std::int64_t new_gesture() { return ledger_.new_gesture(); }
  /// One frame of a gesture of the holder: it is shown at once, and logged at most ten times a second (`OpenGestures`).
  Result<void> show(const Command& command, std::int64_t gesture);
  /// Logs the values that are due. Call it often, such as at the beginning of each frame of a window.
  Result<void> keep_up();
  /// Will keep_up() have values to log?
  bool has_waiting_values() const { return gestures_.is_waiting(); }
  Result<void> end_gesture(std::int64_t gesture);
  /// Undoes the holder's gesture in progress for good: it cannot be redone.
  void abandon(std::int64_t gesture);
  /// Undoes or redoes the holder's last gesture, or the named one.
  Result<TakenBack> undo(std::int64_t gesture = 0);
  Result<TakenBack> redo();
  bool can_redo() const { return ledger_.can_redo(options_.author); }
  /// Applies an entry of a journal in the next tick, with its number and author.
  Result<void> recover(LogEntry entry);
  /// Registers a listener that is called with each new entry, on the thread that submits it. Returns the number for
  /// unsubscribe().
  std::size_t subscribe(std::function<void(const LogEntry&)> listener) { return ledger_.subscribe(std::move(listener)); }
  void unsubscribe(std::size_t number) { ledger_.unsubscribe(number); }

  // Of the clock.
  std::shared_ptr<const Moment> moment() const;
  /// Registers a listener that is called with each new moment, on the ticking thread or on the holder's. It must return soon, and
  /// must not call the session.
  std::size_t subscribe_moments(std::function<void(const std::shared_ptr<const Moment>&)> listener);
  void unsubscribe_moments(std::size_t number);
  void play(bool is_playing);
  void set_rate(double ticks_per_second);
  /// Runs this number of ticks, whether the clock plays or not.
  void step(int ticks);
  /// Makes ticks wait to be served: each begins only after serve() was called for the tick before it. Recordings need this, since
  /// they assign a reading to each tick.
  void make_ticks_wait(bool is_waiting);
  bool do_ticks_wait() const;
  /// Lets the ticking thread sleep while the scene is at rest and the clock plays. The clock counts on: the ticks that have
  /// passed are in the state as soon as somebody says something, or asks for the coming state. Who needs each tick does not let
  /// it.
  void let_rest(bool may_rest);
  /// Measures where the time of the ticks goes, from the next one on, and says so in the moments. Off, it costs nothing.
  void watch_times(bool is_watched);
  /// The tick before the waiting one, if that one is due; else nothing.
  std::optional<std::int64_t> unserved_tick() const;
  void serve(std::int64_t tick);
  /// Goes back to a tick that can still be reached, or to the oldest one; the scene stays the same. The rewind is an entry of the
  /// log, and what is said from now on belongs to that tick. The states of the last ticks are there at once; others the ticking
  /// thread computes again. Where that fails, as without memory, nothing was rewound: the entry is called off, and what was said
  /// meanwhile belongs to the tick that stays.
  void rewind(std::int64_t ticks);
  /// Waits until no rewind is being computed.
  void finish_rewind();
  /// The state with which the next tick will begin; it belongs to the same moment as the logged scene. Logs the values of
  /// gestures first, and waits for the end of a running tick, also where the clock is late.
  std::shared_ptr<const State> coming_state();
  /// Waits until all steps are done, all commands are shown, and no tick is running; for tests.
  void settle();

 private:
  struct Shared;
  LiveSession(const Registry& registry, const Scene& scene, std::int64_t base, LiveSessionOptions options);
  Result<void> end_own_gestures(std::int64_t but = 0);

  LiveSessionOptions options_;
  Ledger ledger_;
  OpenGestures gestures_;
  std::unique_ptr<Shared> shared_;
};

}  // namespace bl::host
