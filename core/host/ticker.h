// What the holder of a session and its ticking thread share, behind one mutex; for live_session.cpp alone.
#pragma once

#include <condition_variable>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <thread>
#include <utility>

#include "core/host/live_session.h"
#include "core/host/past.h"

namespace bl::host {

struct LiveSession::Shared {
  Shared(const Registry& registry, Ledger& the_ledger, OpenGestures& the_gestures, const LiveSessionOptions& options)
      : clock(*options.clock),
        ledger(the_ledger),
        gestures(the_gestures),
        simulation(registry, options.threads),
        past(options.most_history_bytes),
        last_tick(clock.now()) {}

  Clock& clock;
  std::mutex mutex;
  std::condition_variable wake, done;
  // Behind the mutex. Ledger and gestures are changed by the holder's thread alone, which therefore reads them without a lock and
  // locks to change them; the ticking thread locks to read them, and to take the list of what has changed.
  Ledger& ledger;
  OpenGestures& gestures;
  std::shared_ptr<const Moment> published;
  std::int64_t next_tick = 0;  // the tick whose links read what people say now
  int steps_due = 0;
  int holds = 0;  // the holder waits for the pause between two ticks; no tick begins meanwhile
  bool is_playing = false, is_ending = false, is_ticking = false;
  std::optional<std::int64_t> rewinds_to;  // a tick whose state the ticking thread is to compute again, before anything else
  std::int64_t first_rewind = 0;           // the entry of the first of the rewinds that lead there
  std::int64_t tick_before_rewind = 0;     // the next tick where they fail
  std::int64_t failed_rewind = 0;          // the first of those that failed, until the holder's thread calls them off; 0: none
  bool do_ticks_wait = false;              // for somebody who serves them
  std::int64_t served = -1;                // the last tick that was
  bool are_times_watched = false;
  double wanted_rate = 20;
  bool may_rest = false;              // ticks that only count on need not be taken one by one
  std::optional<double> rests_since;  // the time of the last tick, where the thread sleeps and the clock counts on without it
  // What of the log and of the gestures is in what is published; none where not even the state has been looked at.
  struct Seen {
    std::int64_t seq = 0;
    std::uint64_t gestures = 0;
    bool operator==(const Seen&) const = default;
  };
  std::optional<Seen> shown;
  std::shared_ptr<const State> preview;  // the last tick's state with what people have changed since, and with what nodes make of
                                         // settings that no tick has seen; none where there is nothing of it
  std::string failure;                   // of the last tick; a tick that goes well ends it
  // Of whoever has set `is_ticking`; else behind the mutex too.
  Simulation simulation;
  std::shared_ptr<const Scene> read;  // by the last tick
  std::int64_t read_seq = 0;          // the last entry in it
  std::optional<Scene> pending;       // what people have said that the simulation has not taken yet
  std::set<std::pair<std::string, std::string>> pending_placed;
  // Of the ticking thread alone.
  Past past;
  double tick_seconds = 0, rate = 0, last_tick;
  std::unique_ptr<TickTimes> times;  // where they are watched
  std::thread thread;
  std::map<std::size_t, std::function<void(const std::shared_ptr<const Moment>&)>> listeners;
  std::size_t last_listener = 0;

  void run();
  bool tick(std::unique_lock<std::mutex>& lock);
  // With the mutex held, before anything is said or asked that belongs to a tick: the ticks that rest has passed over are
  // counted.
  void stir() {
    end_rest();
    wake.notify_all();
  }
  // The same before anything is said, on the holder's thread.
  void begin_to_hear() {
    stir();
    call_off_failed_rewind();
  }
  // The log is the holder's: the ticking thread cannot do it.
  void call_off_failed_rewind() {
    if (failed_rewind != 0) ledger.call_off_rewinds(std::exchange(failed_rewind, 0));
  }
  void end_rest();
  // The tick that a rewind by so many leads to; nothing where there is none.
  std::optional<std::int64_t> tick_before(std::int64_t ticks) const;
  void go_on_from(std::shared_ptr<const State> earlier);
  void rewind(std::unique_lock<std::mutex>& lock);
  bool is_held_up() const { return do_ticks_wait && served != simulation.state()->tick; }
  Seen said() const { return {ledger.last_seq(), gestures.revision()}; }
  // A clock that stands shows all that people do; one that runs shows what its ticks do not know yet.
  bool is_news() const {
    const bool stands = !is_playing && steps_due == 0;
    return stands ? shown != said() : !shown || shown->gestures != gestures.revision();
  }
  // Is there nothing that the next tick could do but count?
  bool can_rest() const {
    const bool has_heard_all = shown == said() && !pending && !gestures.is_waiting();
    return may_rest && is_playing && steps_due == 0 && !do_ticks_wait && has_heard_all && !preview && simulation.is_idle();
  }
  void show_changes(std::unique_lock<std::mutex>& lock);
  void show(std::shared_ptr<const State> seen) { preview = seen == simulation.state() ? nullptr : std::move(seen); }
  void gather_changes();
  // The scene as it is now, for the tick that reads it.
  std::shared_ptr<const Scene> scene_to_read() const {
    return read && read_seq == ledger.last_seq() ? read : std::make_shared<const Scene>(ledger.scene());
  }
  void note_read() { read = scene_to_read(), read_seq = ledger.last_seq(); }
  void wait_between_ticks(std::unique_lock<std::mutex>& lock);
  /// The state with which the next tick begins, with everything that is said until now; waits for the end of a running tick.
  std::shared_ptr<const State> coming(std::unique_lock<std::mutex>& lock);
  void publish();
  void follow_times();
  std::shared_ptr<const TimeTable> table_of_now();
  // What was published last of the times, and when [s].
  std::shared_ptr<const TimeTable> table;
  double table_at = 0;
};

}  // namespace bl::host
