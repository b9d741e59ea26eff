// The ticking thread: takes the newest scene before each tick, keeps past states for rewinding, and publishes the new state.
#include "core/host/live_session.h"

#include <algorithm>
#include <condition_variable>
#include <deque>
#include <exception>
#include <limits>
#include <map>
#include <mutex>
#include <new>
#include <optional>
#include <set>
#include <string>
#include <thread>
#include <utility>

namespace bl::host {

namespace {

// States kept for rewinding: their meshes and tables are shared between them as long as nothing changes.
constexpr std::size_t kKeptStates = 400;
// New ticks count so much in the smoothed times.
constexpr double kSmoothing = 0.15;

// Of the phases of a tick, for benches: nothing but the real time will do.
double phase_time() { return real_clock().now(); }

constexpr double kFarAhead = std::numeric_limits<double>::infinity();

}  // namespace

struct LiveSession::Shared {
  Shared(const Registry& registry, Ledger& the_ledger, OpenGestures& the_gestures, const LiveSessionOptions& options)
      : clock(*options.clock),
        ledger(the_ledger),
        gestures(the_gestures),
        simulation(registry, options.threads, phase_time),
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
  bool do_ticks_wait = false;  // for somebody who serves them
  std::int64_t served = -1;    // the last tick that was
  double wanted_rate = 20;
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
  std::optional<Scene> pending;  // what people have said that the simulation has not taken yet
  std::set<std::pair<std::string, std::string>> pending_placed;
  // Of the ticking thread alone.
  std::deque<std::shared_ptr<const State>> past;
  double tick_seconds = 0, rate = 0, last_tick;
  std::thread thread;
  std::map<std::size_t, std::function<void(const std::shared_ptr<const Moment>&)>> listeners;
  std::size_t last_listener = 0;

  void run();
  bool tick(std::unique_lock<std::mutex>& lock);
  std::shared_ptr<const State> take_past(std::int64_t ticks);
  bool is_held_up() const { return do_ticks_wait && served != simulation.state()->tick; }
  Seen said() const { return {ledger.last_seq(), gestures.revision()}; }
  // A clock that stands shows all that people do; one that runs shows what its ticks do not know yet.
  bool is_news() const {
    const bool stands = !is_playing && steps_due == 0;
    return stands ? shown != said() : !shown || shown->gestures != gestures.revision();
  }
  void show_changes(std::unique_lock<std::mutex>& lock);
  void show(std::shared_ptr<const State> seen) { preview = seen == simulation.state() ? nullptr : std::move(seen); }
  void gather_changes();
  void wait_between_ticks(std::unique_lock<std::mutex>& lock);
  void publish();
};

// The next four are called with the mutex held, and not while a tick is computed.
void LiveSession::Shared::publish() {
  auto moment = std::make_shared<Moment>();
  moment->ticked = simulation.state();
  moment->state = preview ? preview : moment->ticked;
  moment->is_playing = is_playing;
  moment->wanted_rate = wanted_rate;
  moment->tick_seconds = tick_seconds;
  moment->rate = is_playing ? rate : 0;
  moment->oldest = past.empty() ? simulation.state()->tick : past.front()->tick;
  moment->times = simulation.times();
  moment->failure = failure;
  published = std::move(moment);
  for (const auto& [number, listener] : listeners) listener(published);
}

// What is taken from the ledger stays pending until a simulation has really taken it on: a tick that fails loses nothing.
void LiveSession::Shared::gather_changes() {
  Ledger::Changes changes = ledger.take_changes();
  pending_placed.merge(changes.placed);
  if (changes.is_logic_changed) pending = ledger.scene();
}

// Returns with the mutex held; until it is given up, no tick begins.
void LiveSession::Shared::wait_between_ticks(std::unique_lock<std::mutex>& lock) {
  ++holds;
  done.wait(lock, [this] { return !is_ticking; });
  --holds;
  wake.notify_all();
}

// The newest kept state that is so many ticks old, or the oldest; those after it are given up. None where there is none.
std::shared_ptr<const State> LiveSession::Shared::take_past(std::int64_t ticks) {
  const std::int64_t now = simulation.state()->tick;
  if (past.empty() || past.front()->tick >= now) return nullptr;
  while (past.size() > 1 && past.back()->tick > std::min(now - ticks, now - 1)) past.pop_back();
  const std::shared_ptr<const State> found = past.back();
  past.pop_back();
  return found;
}

// What no tick has seen is to be seen all the same: as the next tick will begin with it. The simulation itself waits for that
// tick, so that a replay of the log meets the same states.
void LiveSession::Shared::show_changes(std::unique_lock<std::mutex>& lock) {
  const Seen now = said();
  gather_changes();
  std::optional<Scene> scene = gestures.is_waiting() ? std::optional(gestures.shown()) : pending;
  auto placed = pending_placed;
  placed.merge(gestures.placed());
  is_ticking = true;
  lock.unlock();
  std::shared_ptr<const State> seen = simulation.state();
  try {
    if (scene) seen = simulation.with_scene(*scene, placed);
    seen = simulation.shown(std::move(seen));
  } catch (const std::exception&) {
    // The next tick will say so.
  }
  lock.lock();
  is_ticking = false;
  show(std::move(seen));
  shown = now;
  publish();
}

// One tick; the lock is given up while it computes. Whether it went well.
bool LiveSession::Shared::tick(std::unique_lock<std::mutex>& lock) {
  gather_changes();
  shown = said();
  is_ticking = true;
  next_tick = simulation.state()->tick + 1;
  std::string trouble;
  lock.unlock();
  const double begin = clock.now();
  try {
    // What is taken from the ledger stays pending until the simulation has really taken it on.
    if (pending) simulation.set_scene(*pending, pending_placed);
    pending.reset();
    pending_placed.clear();
    past.push_back(simulation.state());
    if (past.size() > kKeptStates) past.pop_front();
    simulation.step();
  } catch (const std::bad_alloc&) {
    trouble = "memory ran out in a tick; the last good state is kept, and the clock is stopped";
  } catch (const std::exception& exception) {
    trouble = std::string("a tick failed (") + exception.what() + "); the last good state is kept, and the clock is stopped";
  }
  const double end = clock.now(), seconds = end - begin, since = end - last_tick;
  tick_seconds = tick_seconds == 0 ? seconds : tick_seconds + kSmoothing * (seconds - tick_seconds);
  last_tick = end;
  rate = since > 2 ? 0 : rate + kSmoothing * (1 / std::max(1e-4, since) - rate);
  lock.lock();
  is_ticking = false;
  preview = nullptr;
  next_tick = simulation.state()->tick;
  failure = std::move(trouble);
  if (!failure.empty()) {
    is_playing = false;
    steps_due = 0;
    // The entries of a log are in the order of their ticks, also where the tick that some were made for never came.
    if (!ledger.log().empty()) next_tick = std::max(next_tick, std::min(ledger.log().back().tick, next_tick + 1));
  }
  if (gestures.is_waiting() && holds == 0) show_changes(lock);
  else publish();
  return failure.empty();
}

void LiveSession::Shared::run() {
  std::unique_lock lock(mutex);
  double due = clock.now();
  while (!is_ending) {
    if (holds > 0) {
      done.notify_all();
      wake.wait(lock);
      continue;
    }
    // A clock that has been set to go faster does not wait as long as it was to wait before.
    const double step = 1 / wanted_rate;
    due = std::min(due, last_tick + step);
    const bool is_due = !is_held_up() && (steps_due > 0 || (is_playing && clock.now() >= due));
    if (is_due) {
      // A late tick is not made up for: the clock goes on from now, so that ticks never queue behind themselves.
      due = std::max(clock.now(), due + step);
      if (steps_due > 0) --steps_due;
      tick(lock);
      done.notify_all();
      continue;
    }
    if (is_news()) {
      show_changes(lock);
      continue;
    }
    done.notify_all();
    if (is_playing && !is_held_up()) clock.wait(wake, lock, due);
    else wake.wait(lock);
  }
}

LiveSession::LiveSession(const Registry& registry, const Scene& scene, LiveSessionOptions options)
    : options_(std::move(options)),
      ledger_(registry, scene),
      gestures_(ledger_),
      shared_(std::make_unique<Shared>(registry, ledger_, gestures_, options_)) {
  shared_->simulation.set_scene(scene);
}

Result<std::unique_ptr<LiveSession>> LiveSession::start(const Registry& registry, const Scene& scene, const SavedState* state,
                                                        LiveSessionOptions options) {
  std::unique_ptr<LiveSession> session(new LiveSession(registry, scene, std::move(options)));
  Shared& shared = *session->shared_;
  if (state != nullptr)
    if (auto restored = shared.simulation.restore_state(*state); !restored) return restored.error();
  shared.next_tick = shared.simulation.state()->tick;
  shared.publish();
  shared.thread = std::thread([&shared] { shared.run(); });
  return session;
}

LiveSession::~LiveSession() {
  if (!shared_->thread.joinable()) return;
  {
    const std::lock_guard lock(shared_->mutex);
    shared_->is_ending = true;
  }
  shared_->wake.notify_all();
  shared_->thread.join();
}

// With the mutex held, as the next eight.
Result<void> LiveSession::end_own_gestures(std::int64_t but) {
  return but != 0 && gestures_.is_open(but) ? Result<void>() : gestures_.end_all(options_.author, shared_->next_tick);
}

Result<void> LiveSession::submit(const Command& command, std::int64_t gesture, const std::string& label) {
  const std::lock_guard lock(shared_->mutex);
  shared_->wake.notify_all();
  if (auto ended = end_own_gestures(gesture); !ended) return ended;
  return ledger_.submit({command, options_.author, gesture, {options_.origin}, label}, shared_->next_tick);
}

Result<void> LiveSession::submit(Submission submission) {
  const std::lock_guard lock(shared_->mutex);
  shared_->wake.notify_all();
  return ledger_.submit(std::move(submission), shared_->next_tick);
}

Result<void> LiveSession::show(const Command& command, std::int64_t gesture) {
  const std::lock_guard lock(shared_->mutex);
  shared_->wake.notify_all();
  if (auto ended = end_own_gestures(gesture); !ended) return ended;
  return gestures_.show({command, options_.author, gesture, {options_.origin}, {}}, shared_->next_tick, shared_->clock.now());
}

Result<void> LiveSession::keep_up() {
  gestures_.forget_past();
  if (!gestures_.is_waiting()) return {};
  const std::lock_guard lock(shared_->mutex);
  shared_->wake.notify_all();
  return gestures_.say_due(shared_->next_tick, shared_->clock.now());
}

Result<void> LiveSession::end_gesture(std::int64_t gesture) {
  const std::lock_guard lock(shared_->mutex);
  shared_->wake.notify_all();
  return gestures_.end(gesture, shared_->next_tick);
}

void LiveSession::abandon(std::int64_t gesture) {
  const std::lock_guard lock(shared_->mutex);
  shared_->wake.notify_all();
  gestures_.drop(gesture);
  // The ticks have seen what was said of it, so that the log keeps it and what takes it back.
  if (gesture != 0) (void)ledger_.abandon(options_.author, shared_->next_tick, gesture);
}

Result<TakenBack> LiveSession::undo(std::int64_t gesture) {
  const std::lock_guard lock(shared_->mutex);
  shared_->wake.notify_all();
  if (auto ended = end_own_gestures(); !ended) return ended.error();
  return ledger_.undo(options_.author, shared_->next_tick, gesture, {options_.origin});
}

Result<TakenBack> LiveSession::redo() {
  const std::lock_guard lock(shared_->mutex);
  shared_->wake.notify_all();
  if (auto ended = end_own_gestures(); !ended) return ended.error();
  return ledger_.redo(options_.author, shared_->next_tick, 0, {options_.origin});
}

Result<void> LiveSession::recover(LogEntry entry) {
  const std::lock_guard lock(shared_->mutex);
  entry.tick = shared_->next_tick;
  shared_->wake.notify_all();
  return ledger_.replay(entry);
}

std::size_t LiveSession::subscribe_moments(std::function<void(const std::shared_ptr<const Moment>&)> listener) {
  const std::lock_guard lock(shared_->mutex);
  shared_->listeners.emplace(++shared_->last_listener, std::move(listener));
  return shared_->last_listener;
}

void LiveSession::unsubscribe_moments(std::size_t number) {
  const std::lock_guard lock(shared_->mutex);
  shared_->listeners.erase(number);
}

std::shared_ptr<const Moment> LiveSession::moment() const {
  const std::lock_guard lock(shared_->mutex);
  return shared_->published;
}

void LiveSession::play(bool is_playing) {
  {
    const std::lock_guard lock(shared_->mutex);
    shared_->is_playing = is_playing;
    if (!shared_->is_ticking) shared_->publish();
  }
  shared_->wake.notify_all();
}

void LiveSession::set_rate(double ticks_per_second) {
  {
    const std::lock_guard lock(shared_->mutex);
    shared_->wanted_rate = std::clamp(ticks_per_second, 0.1, 1000.0);
    if (!shared_->is_ticking) shared_->publish();
  }
  shared_->wake.notify_all();
}

void LiveSession::step(int ticks) {
  {
    const std::lock_guard lock(shared_->mutex);
    shared_->steps_due += std::max(0, ticks);
  }
  shared_->wake.notify_all();
}

void LiveSession::make_ticks_wait(bool is_waiting) {
  {
    const std::lock_guard lock(shared_->mutex);
    shared_->do_ticks_wait = is_waiting;
  }
  shared_->wake.notify_all();
}

bool LiveSession::do_ticks_wait() const {
  const std::lock_guard lock(shared_->mutex);
  return shared_->do_ticks_wait;
}

std::optional<std::int64_t> LiveSession::unserved_tick() const {
  const std::lock_guard lock(shared_->mutex);
  const Shared& shared = *shared_;
  const bool is_wanted = shared.is_playing || shared.steps_due > 0;
  if (shared.is_ticking || !is_wanted || !shared.is_held_up()) return std::nullopt;
  return shared.simulation.state()->tick;
}

void LiveSession::serve(std::int64_t tick) {
  {
    const std::lock_guard lock(shared_->mutex);
    shared_->served = tick;
  }
  shared_->wake.notify_all();
}

void LiveSession::rewind(std::int64_t ticks) {
  std::unique_lock lock(shared_->mutex);
  Shared& shared = *shared_;
  shared.wait_between_ticks(lock);
  (void)gestures_.say_due(shared.next_tick, kFarAhead);  // what fits no more is not shown any longer, either
  const auto state = ticks > 0 ? shared.take_past(ticks) : nullptr;
  if (state == nullptr) return;
  (void)ledger_.rewind(options_.author, shared.next_tick, state->tick);  // it is before the next tick
  shared.simulation.return_to(state);
  shared.preview = nullptr;
  shared.served = -1;
  shared.shown.reset();
  shared.next_tick = state->tick;
  shared.publish();
}

std::shared_ptr<const State> LiveSession::coming_state() {
  std::unique_lock lock(shared_->mutex);
  Shared& shared = *shared_;
  shared.wait_between_ticks(lock);
  (void)gestures_.say_due(shared.next_tick, kFarAhead);
  shared.gather_changes();
  return shared.pending ? shared.simulation.with_scene(*shared.pending, shared.pending_placed) : shared.simulation.state();
}

void LiveSession::settle() {
  std::unique_lock lock(shared_->mutex);
  shared_->wake.notify_all();
  shared_->done.wait(lock, [this] {
    // Ticks that wait to be served are not waited for: who serves them may be who asks.
    return (shared_->steps_due == 0 || (!shared_->is_ticking && shared_->is_held_up())) && !shared_->is_news();
  });
  shared_->wait_between_ticks(lock);
}

}  // namespace bl::host
