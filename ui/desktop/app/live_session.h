// A scene that ticks on a thread of its own while a window edits it: commands take effect at once, ticks never wait for people.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/graph/simulation.h"
#include "core/session/ledger.h"

namespace bl::desktop {

/// What the ticking thread has published last. Everything in it stays as it is for as long as somebody holds it.
struct Moment {
  std::shared_ptr<const State> state;   ///< with what people have changed since the last tick, where the clock stands
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

class LiveSession {
 public:
  /// The scene has to be usable. `threads`: of the ticks.
  static Result<std::unique_ptr<LiveSession>> start(const Registry& registry, const Scene& scene, const SavedState* state,
                                                    int threads);
  ~LiveSession();
  LiveSession(const LiveSession&) = delete;
  LiveSession& operator=(const LiveSession&) = delete;

  // Of the people's thread: the scene as they have left it, and the ways to change it. Commands are checked and applied at
  // once; the ticks see them from the next one on.
  const Scene& scene() const { return ledger_.scene(); }
  const std::vector<LogEntry>& log() const { return ledger_.log(); }
  Result<void> submit(const Command& command, std::int64_t gesture = 0);
  std::int64_t new_gesture() { return ledger_.new_gesture(); }
  /// The last gesture of this author, or the one that is named.
  Result<TakenBack> undo(std::int64_t gesture = 0);
  Result<TakenBack> redo();
  Result<void> replay(LogEntry entry);
  void on_entry(std::function<void(const LogEntry&)> listener) { (void)ledger_.subscribe(std::move(listener)); }

  // Of the clock.
  std::shared_ptr<const Moment> moment() const;
  void play(bool is_playing);
  void set_rate(double ticks_per_second);
  /// So many ticks, whether it plays or not.
  void step(int ticks);
  /// Where ticks wait to be served: each begins only when serve() has been called for the tick before it, as recordings need it
  /// that say for each tick what is read in it. Scenes with recordings begin like this
  /// as long as there are `servers`.
  void make_ticks_wait(bool is_waiting);
  bool do_ticks_wait() const;
  /// The tick after which one is due that waits; nothing where none is, or none waits.
  std::optional<std::int64_t> unserved_tick() const;
  void serve(std::int64_t tick);
  static inline std::atomic<int> servers = 0;
  /// Goes back to a tick that is still kept, or to the oldest that is; the scene stays as it is. `on_rewind` hears of it.
  void rewind(std::int64_t ticks);
  void on_rewind(std::function<void()> listener) { rewound_ = std::move(listener); }
  /// Gives the simulation what people have said, as the next tick would, and returns its state: with scene(), the two are one
  /// and the same moment. Waits for the end of a tick that is under way, also where the clock is late.
  std::shared_ptr<const State> take_on_changes();
  /// Waits until all steps are done, what people have said is shown, and no tick is under way; for tests.
  void settle();

  /// Who signs the commands.
  static constexpr const char* kAuthor = "desk";

 private:
  struct Shared;
  LiveSession(const Registry& registry, const Scene& scene, int threads);

  Ledger ledger_;
  std::unique_ptr<Shared> shared_;
  std::function<void()> rewound_;
};

}  // namespace bl::desktop
