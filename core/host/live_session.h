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
#include "core/session/open_gestures.h"

namespace bl::host {

/// What the ticking thread has published last. Everything in it stays as it is for as long as somebody holds it.
struct Moment {
  std::shared_ptr<const State> state;   ///< with what people have changed since the last tick, where it is shown already
  std::shared_ptr<const State> ticked;  ///< as the last tick has left it
  bool is_playing = false;
  double wanted_rate = 0;   ///< ticks per second that were asked for
  double tick_seconds = 0;  ///< what a tick takes, smoothed [s]
  double rate = 0;          ///< ticks per second that are reached, smoothed
  std::int64_t oldest = 0;  ///< the first tick that rewinding can reach
  PhaseTimes times;         ///< of all ticks so far [s]
  std::string failure;      ///< why the ticking stopped: out of memory, an error of the program; the state is the last good one

  bool is_behind() const { return is_playing && tick_seconds * wanted_rate > 1.05; }
};

/// Who holds a session, and what it runs on.
struct LiveSessionOptions {
  Author author = {};            ///< who signs what its holder says
  std::string origin = {};       ///< where the holder speaks from, such as `window`
  int threads = 1;               ///< of the ticks
  Clock* clock = &real_clock();  ///< has to outlive the session
};

class LiveSession {
 public:
  /// The scene has to be usable.
  static Result<std::unique_ptr<LiveSession>> start(const Registry& registry, const Scene& scene, const SavedState* state,
                                                    LiveSessionOptions options);
  ~LiveSession();
  LiveSession(const LiveSession&) = delete;
  LiveSession& operator=(const LiveSession&) = delete;

  // Of the holder's thread: the scene as people have left it, and the ways to change it. Commands are checked and applied at
  // once; the ticks see them from the next one on.
  /// With what a gesture shows that is under way. What this has returned can be read until keep_up() is called.
  const Scene& scene() const { return gestures_.shown(); }
  /// Without: as the log has it.
  const Scene& said() const { return ledger_.scene(); }
  const std::vector<LogEntry>& log() const { return ledger_.log(); }
  std::int64_t last_seq() const { return ledger_.last_seq(); }
  const Author& author() const { return options_.author; }
  /// Of the holder. What a gesture of the holder still shows is said before it, unless it belongs to that.
  Result<void> submit(const Command& command, std::int64_t gesture = 0, const std::string& label = "");
  /// Of anybody: a device, a script, somebody at another screen.
  Result<void> submit(Submission submission);
  std::int64_t new_gesture() { return ledger_.new_gesture(); }
  /// One frame of a gesture of the holder: is seen at once, and said ten times a second at most (`OpenGestures`).
  Result<void> show(const Command& command, std::int64_t gesture);
  /// To be called often, as at the beginning of each frame of a window: says what has waited long enough.
  Result<void> keep_up();
  Result<void> end_gesture(std::int64_t gesture);
  /// Takes back the gesture that the holder is in the middle of, as if it had never begun: nothing brings it back.
  void abandon(std::int64_t gesture);
  /// The holder's last gesture, or the one that is named.
  Result<TakenBack> undo(std::int64_t gesture = 0);
  Result<TakenBack> redo();
  bool can_redo() const { return ledger_.can_redo(options_.author); }
  /// An entry of a journal, for the coming tick; with its number and whose it was.
  Result<void> recover(LogEntry entry);
  /// Called with each new entry, on the thread that says it. The number that unsubscribe() wants.
  std::size_t subscribe(std::function<void(const LogEntry&)> listener) { return ledger_.subscribe(std::move(listener)); }
  void unsubscribe(std::size_t number) { ledger_.unsubscribe(number); }

  // Of the clock.
  std::shared_ptr<const Moment> moment() const;
  /// Called with each new moment, on the thread that publishes it, which has to get it back soon: it ticks. Nothing of the
  /// session may be called from it.
  std::size_t subscribe_moments(std::function<void(const std::shared_ptr<const Moment>&)> listener);
  void unsubscribe_moments(std::size_t number);
  void play(bool is_playing);
  void set_rate(double ticks_per_second);
  /// So many ticks, whether it plays or not.
  void step(int ticks);
  /// Where ticks wait to be served: each begins only when serve() has been called for the tick before it, as recordings need it
  /// that say for each tick what is read in it.
  void make_ticks_wait(bool is_waiting);
  bool do_ticks_wait() const;
  /// The tick after which one is due that waits; nothing where none is, or none waits.
  std::optional<std::int64_t> unserved_tick() const;
  void serve(std::int64_t tick);
  /// Goes back to a tick that is still kept, or to the oldest that is; the scene stays as it is. It is an entry of the log.
  void rewind(std::int64_t ticks);
  /// The state as the next tick will begin with it: with the scene that was said, the two are one and the same moment. Waits for
  /// the end of a tick that is under way, also where the clock is late. What gestures show is said before.
  std::shared_ptr<const State> coming_state();
  /// Waits until all steps are done, what people have said is shown, and no tick is under way; for tests.
  void settle();

 private:
  struct Shared;
  LiveSession(const Registry& registry, const Scene& scene, LiveSessionOptions options);
  Result<void> end_own_gestures(std::int64_t but = 0);

  LiveSessionOptions options_;
  Ledger ledger_;
  OpenGestures gestures_;
  std::unique_ptr<Shared> shared_;
};

}  // namespace bl::host
