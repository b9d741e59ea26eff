// The ticking thread: takes the newest scene before each tick, keeps past states for rewinding, and publishes what it made.
#include "ui/desktop/app/live_session.h"

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <exception>
#include <mutex>
#include <new>
#include <optional>
#include <set>
#include <string>
#include <thread>
#include <utility>

namespace bl::desktop {

namespace {

using Clock = std::chrono::steady_clock;

// States kept for rewinding: their meshes and tables are shared between them as long as nothing changes.
constexpr std::size_t kKeptStates = 400;
// In place of a number of entries: not even the state without any has been looked at.
constexpr std::size_t kNeverShown = static_cast<std::size_t>(-1);
// New ticks count so much in the smoothed times.
constexpr double kSmoothing = 0.15;

bool has_recordings(const Scene& scene) {
  return std::any_of(scene.nodes.begin(), scene.nodes.end(), [](const auto& entry) {
    const auto sensor = entry.second.types.find("sensor");
    if (sensor == entry.second.types.end()) return false;
    const auto address = sensor->second.find("address");
    const auto* text = address != sensor->second.end() ? std::get_if<std::string>(&address->second) : nullptr;
    return text != nullptr && text->starts_with("replay:");
  });
}

double seconds_now() { return std::chrono::duration<double>(Clock::now().time_since_epoch()).count(); }

}  // namespace

struct LiveSession::Shared {
  Shared(const Registry& registry, Ledger& the_ledger, int threads)
      : ledger(the_ledger), simulation(registry, threads, seconds_now) {}

  std::mutex mutex;
  std::condition_variable wake, done;
  // Behind the mutex. Scene and log of the ledger are changed by people's thread alone, which therefore reads them without a
  // lock and locks to change them; the ticking thread locks to read them, and to take the list of what has changed.
  Ledger& ledger;
  std::shared_ptr<const Moment> published;
  std::int64_t next_tick = 0;  // the tick whose links read what people say now
  int steps_due = 0;
  int holds = 0;  // people's thread waits for the pause between two ticks; no tick begins meanwhile
  std::int64_t rewind_by = 0;
  bool is_playing = false, is_ending = false, is_ticking = false;
  bool do_ticks_wait = false;  // for somebody who serves them
  std::int64_t served = -1;    // the last tick that was
  double wanted_rate = 20;
  std::size_t shown_entries = kNeverShown;  // of the log: what they have said is in what is published
  std::shared_ptr<const State> preview;  // the last tick's state with what people have changed since, and with what nodes make of
                                         // settings that no tick has seen; none where there is nothing of it
  std::string failure;                   // of the last tick; a tick that goes well ends it
  // Of whoever has set `is_ticking`; else behind the mutex too.
  Simulation simulation;
  std::optional<Scene> pending;  // what people have said that the simulation has not taken yet
  std::set<std::pair<std::string, std::string>> pending_placed;
  // Of the ticking thread alone.
  std::deque<std::shared_ptr<const State>> past;
  double tick_seconds = 0, rate = 0;
  Clock::time_point last_tick{};
  std::thread thread;

  void run();
  bool tick(std::unique_lock<std::mutex>& lock);
  void go_back(std::int64_t ticks);
  bool is_held_up() const { return do_ticks_wait && served != simulation.state()->tick; }
  bool is_news() const { return !is_playing && steps_due == 0 && shown_entries != ledger.log().size(); }
  void show_changes(std::unique_lock<std::mutex>& lock);
  void show(std::shared_ptr<const State> seen) { preview = seen == simulation.state() ? nullptr : std::move(seen); }
  void gather_changes();
  void take_on_changes();
  void wait_between_ticks(std::unique_lock<std::mutex>& lock);
  void publish();
};

// The next five are called with the mutex held, and not while a tick is computed.
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
}

// What is taken from the ledger stays pending until a simulation has really taken it on: a tick that fails loses nothing.
void LiveSession::Shared::gather_changes() {
  Ledger::Changes changes = ledger.take_changes();
  pending_placed.merge(changes.placed);
  if (changes.is_logic_changed) pending = ledger.scene();
}

void LiveSession::Shared::take_on_changes() {
  if (pending) simulation.set_scene(*pending, pending_placed);
  pending.reset();
  pending_placed.clear();
}

// Returns with the mutex held; until it is given up, no tick begins.
void LiveSession::Shared::wait_between_ticks(std::unique_lock<std::mutex>& lock) {
  ++holds;
  done.wait(lock, [this] { return !is_ticking; });
  --holds;
  wake.notify_all();
}

void LiveSession::Shared::go_back(std::int64_t ticks) {
  const std::int64_t wanted = simulation.state()->tick - ticks;
  while (past.size() > 1 && past.back()->tick > wanted) past.pop_back();
  if (past.empty() || past.back()->tick >= simulation.state()->tick) return;
  simulation.return_to(past.back());
  past.pop_back();
}

// While the clock stands, what people change is to be seen all the same: as the next tick will begin with it. The simulation
// itself waits for that tick, so that a replay of the log meets the same states.
void LiveSession::Shared::show_changes(std::unique_lock<std::mutex>& lock) {
  const std::size_t entries = ledger.log().size();
  gather_changes();
  if (pending || shown_entries == kNeverShown) {
    is_ticking = true;
    lock.unlock();
    std::shared_ptr<const State> seen = simulation.state();
    try {
      if (pending) seen = simulation.with_scene(*pending, pending_placed);
      seen = simulation.shown(std::move(seen));
    } catch (const std::exception&) {
      // The next tick will say so.
    }
    lock.lock();
    is_ticking = false;
    show(std::move(seen));
    publish();
  }
  shown_entries = entries;
}

// One tick; the lock is given up while it computes. Whether it went well.
bool LiveSession::Shared::tick(std::unique_lock<std::mutex>& lock) {
  gather_changes();
  shown_entries = ledger.log().size();
  is_ticking = true;
  next_tick = simulation.state()->tick + 1;
  std::string trouble;
  lock.unlock();
  const Clock::time_point begin = Clock::now();
  try {
    take_on_changes();
    past.push_back(simulation.state());
    if (past.size() > kKeptStates) past.pop_front();
    simulation.step();
  } catch (const std::bad_alloc&) {
    trouble = "memory ran out in a tick; the last good state is kept, and the clock is stopped";
  } catch (const std::exception& exception) {
    trouble = std::string("a tick failed (") + exception.what() + "); the last good state is kept, and the clock is stopped";
  }
  const double seconds = std::chrono::duration<double>(Clock::now() - begin).count();
  tick_seconds = tick_seconds == 0 ? seconds : tick_seconds + kSmoothing * (seconds - tick_seconds);
  const double since = std::chrono::duration<double>(Clock::now() - last_tick).count();
  last_tick = Clock::now();
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
  publish();
  return failure.empty();
}

void LiveSession::Shared::run() {
  std::unique_lock lock(mutex);
  Clock::time_point due = Clock::now();
  while (!is_ending) {
    if (holds > 0) {
      done.notify_all();
      wake.wait(lock);
      continue;
    }
    if (rewind_by > 0) {
      go_back(std::exchange(rewind_by, 0));
      preview = nullptr;
      served = -1;
      shown_entries = kNeverShown;
      next_tick = simulation.state()->tick;
      publish();
      done.notify_all();
    }
    // A clock that has been set to go faster does not wait as long as it was to wait before.
    const auto step = std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(1 / wanted_rate));
    due = std::min(due, last_tick + step);
    const bool is_due = !is_held_up() && (steps_due > 0 || (is_playing && Clock::now() >= due));
    if (is_due) {
      // A late tick is not made up for: the clock goes on from now, so that ticks never queue behind themselves.
      due = std::max(Clock::now(), due + step);
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
    if (is_playing && !is_held_up()) wake.wait_until(lock, due);
    else wake.wait(lock);
  }
}

LiveSession::LiveSession(const Registry& registry, const Scene& scene, int threads)
    : ledger_(registry, scene), shared_(std::make_unique<Shared>(registry, ledger_, threads)) {
  shared_->simulation.set_scene(scene);
}

Result<std::unique_ptr<LiveSession>> LiveSession::start(const Registry& registry, const Scene& scene, const SavedState* state,
                                                        int threads) {
  std::unique_ptr<LiveSession> session(new LiveSession(registry, scene, threads));
  Shared& shared = *session->shared_;
  if (state != nullptr)
    if (auto restored = shared.simulation.restore_state(*state); !restored) return restored.error();
  shared.next_tick = shared.simulation.state()->tick;
  shared.do_ticks_wait = servers > 0 && has_recordings(scene);
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

Result<void> LiveSession::submit(const Command& command, std::int64_t gesture) {
  const std::lock_guard lock(shared_->mutex);
  shared_->wake.notify_all();
  return ledger_.submit(command, kAuthor, shared_->next_tick, gesture);
}

Result<TakenBack> LiveSession::undo(std::int64_t gesture) {
  const std::lock_guard lock(shared_->mutex);
  shared_->wake.notify_all();
  return ledger_.undo(kAuthor, shared_->next_tick, gesture);
}

Result<TakenBack> LiveSession::redo() {
  const std::lock_guard lock(shared_->mutex);
  shared_->wake.notify_all();
  return ledger_.redo(kAuthor, shared_->next_tick);
}

Result<void> LiveSession::replay(LogEntry entry) {
  const std::lock_guard lock(shared_->mutex);
  entry.tick = shared_->next_tick;
  shared_->wake.notify_all();
  return ledger_.replay(entry);
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
  if (shared.is_ticking || shared.rewind_by > 0 || !is_wanted || !shared.is_held_up()) return std::nullopt;
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
  {
    std::unique_lock lock(shared_->mutex);
    shared_->rewind_by += std::max<std::int64_t>(0, ticks);
    shared_->wake.notify_all();
    // A clock that is late ticks on without a pause: only the going back itself is waited for.
    shared_->done.wait(lock, [this] { return shared_->rewind_by == 0; });
  }
  if (rewound_) rewound_();
}

std::shared_ptr<const State> LiveSession::take_on_changes() {
  std::unique_lock lock(shared_->mutex);
  shared_->wait_between_ticks(lock);
  shared_->gather_changes();
  shared_->take_on_changes();
  shared_->show(shared_->simulation.shown(shared_->simulation.state()));
  shared_->shown_entries = ledger_.log().size();
  shared_->publish();
  return shared_->simulation.state();
}

void LiveSession::settle() {
  std::unique_lock lock(shared_->mutex);
  shared_->wake.notify_all();
  shared_->done.wait(lock, [this] {
    // Ticks that wait to be served are not waited for: who serves them may be who asks.
    return shared_->rewind_by == 0 && (shared_->steps_due == 0 || (!shared_->is_ticking && shared_->is_held_up())) &&
           !shared_->is_news();
  });
  shared_->wait_between_ticks(lock);
}

}  // namespace bl::desktop
