// Takes the same ticks as a room, on a thread of its own: each as soon as the room has said what it reads.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <thread>
#include <utility>

#include "core/graph/simulation.h"
#include "core/host/live_session.h"

namespace bl::guest {

/// What the room says of a tick: every entry that it has read is here.
struct Mark {
  std::int64_t tick = 0;
  std::string hash = {};    ///< empty: not told
  bool is_resting = false;  ///< the ticks only count on from here
};

/// Why the ticks here are not those of the room any more.
struct Difference {
  std::int64_t tick = 0;
  std::string why;              ///< `hash`, `late` where an entry belongs to a tick that is over, or `failed`
  std::string expected, found;  ///< hashes, where they differ
  std::string text;             ///< of a tick that failed
};

class Follower {
 public:
  using Placed = std::set<std::pair<std::string, std::string>>;
  using Listener = std::function<void(const std::shared_ptr<const host::Moment>&)>;

  /// So many ticks wait, so that an uneven network does not show.
  static constexpr std::int64_t kBuffer = 2;
  /// Behind by more than these, not every tick is shown.
  static constexpr std::int64_t kFarBehind = 20;

  Follower(const Registry& registry, int threads, host::Clock& clock);
  ~Follower();
  Follower(const Follower&) = delete;
  Follower& operator=(const Follower&) = delete;

  /// Begins anew with a scene and its state; what waited is dropped.
  Result<void> begin(const Scene& scene, const SavedState* state);
  /// The scene that is read by the tick after `tick`. Ascending; a later one for the same tick replaces it, and `placed` add up.
  void set_scene(std::int64_t tick, Scene scene, Placed placed);
  /// The same for the next tick that has not begun, where the ticks are nobody else's.
  void set_next(Scene scene, Placed placed);
  void mark(Mark mark);
  /// What is shown beside what the ticks know: `scene` with everything that has been said, also where nobody has answered yet.
  void show(Scene scene, Placed placed);
  /// Nothing but what has been set is shown.
  void show_nothing_more();
  void set_pace(bool is_playing, double rate);

  std::shared_ptr<const host::Moment> moment() const;
  std::size_t subscribe(Listener listener);
  void unsubscribe(std::size_t number);
  void watch_times(bool is_watched);
  /// Tells all listeners once more, as where there is other news.
  void nudge();
  /// The state with which the next tick would begin under this scene.
  std::shared_ptr<const State> state_with(const Scene& scene, const Placed& placed);
  /// Once for each time that the ticks went another way than the room's; until begin() no further tick is taken.
  std::optional<Difference> take_difference();
  bool has_difference() const;
  std::int64_t tick() const { return moment()->ticked->tick; }
  /// How many hashes of the room were the same here.
  std::int64_t agreed() const;
  /// How many ticks are to be taken.
  std::int64_t behind() const;
  /// Waits until all ticks that may be taken are taken, and everything is shown; for tests.
  void settle();

 private:
  struct Setting {
    Scene scene;
    Placed placed;
  };
  void run();
  bool can_tick() const { return !difference_ && !marks_.empty(); }
  double due() const;
  void tick(std::unique_lock<std::mutex>& lock);
  void refresh(std::unique_lock<std::mutex>& lock);
  void wait_between_ticks(std::unique_lock<std::mutex>& lock);
  void publish();
  void changed();

  host::Clock& clock_;
  mutable std::mutex mutex_;
  std::condition_variable wake_, done_;
  // Behind the mutex; the simulation belongs to whoever has set `is_busy_`.
  Simulation simulation_;
  std::map<std::int64_t, Setting> settings_;  // by the tick that is over when they are set
  std::deque<Mark> marks_;
  std::optional<Setting> wished_;  // what is to be shown beside the settings
  std::optional<Difference> difference_;
  bool is_difference_told_ = false;
  std::int64_t reached_ = 0;            // the tick that entries may still belong to; while one is taken, the one after it
  std::shared_ptr<const State> shown_;  // with what no tick has read; none where there is nothing of it
  std::shared_ptr<const host::Moment> published_;
  bool is_busy_ = false, is_ending_ = false, is_stale_ = true, is_playing_ = false, is_resting_ = false;
  int holds_ = 0;
  std::int64_t agreed_ = 0;
  double rate_ = 10, reached_rate_ = 0, tick_seconds_ = 0, last_tick_ = 0;
  bool are_times_watched_ = false;
  std::unique_ptr<TickTimes> times_;
  std::map<std::size_t, Listener> listeners_;
  std::size_t last_listener_ = 0;
  std::thread thread_;  // last: it uses all of the above
};

}  // namespace bl::guest
