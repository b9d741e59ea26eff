// The ticking thread: takes the newest scene before each tick, keeps past states for rewinding, and publishes the new state.
#include "core/host/ticker.h"

#include <algorithm>
#include <exception>
#include <limits>
#include <new>
#include <utility>

namespace bl::host {

namespace {

// Nobody reads a table of times more often than this while the clock plays [s].
constexpr double kTablePause = 0.5;
// New ticks count so much in the smoothed times.
constexpr double kSmoothing = 0.15;

}  // namespace

// With the mutex held, as all that follow; publish() to gather_changes() not while a tick is computed.
void LiveSession::Shared::publish() {
  auto moment = std::make_shared<Moment>();
  moment->ticked = simulation.state();
  moment->scene = read;
  moment->seq = read_seq;
  moment->state = preview ? preview : moment->ticked;
  moment->is_playing = is_playing;
  moment->is_resting = rests_since.has_value();
  moment->wanted_rate = wanted_rate;
  moment->tick_seconds = tick_seconds;
  moment->rate = is_playing ? rate : 0;
  moment->oldest = past.empty() ? simulation.state()->tick : past.oldest();
  moment->has_forgotten = past.has_given_up();
  moment->history_bytes = past.bytes();
  moment->times = table_of_now();
  moment->failure = failure;
  published = std::move(moment);
  for (const auto& [number, listener] : listeners) listener(published);
}

// Measuring begins and ends between two ticks. It needs the real time, whatever clock the ticks follow.
void LiveSession::Shared::follow_times() {
  if (are_times_watched == (times != nullptr)) return;
  table = nullptr;
  times = are_times_watched ? std::make_unique<TickTimes>([] { return real_clock().now(); }) : nullptr;
  simulation.measure(times.get());
}

// A clock that stands or rests leaves a table that has everything.
std::shared_ptr<const TimeTable> LiveSession::Shared::table_of_now() {
  if (!times || times->ticks() == 0) return nullptr;
  const auto known = table ? static_cast<std::int64_t>(table->ticks.evaluations) : 0;
  if (known == times->ticks()) return table;
  const bool is_last = !is_playing || rests_since;
  if (table && !is_last && clock.now() < table_at + kTablePause) return table;
  table = std::make_shared<TimeTable>(times->table());
  table_at = clock.now();
  return table;
}

// What people say from now on belongs to the tick at which the clock stands now.
void LiveSession::Shared::end_rest() {
  if (!rests_since) return;
  const auto ticks = static_cast<std::int64_t>((clock.now() - *rests_since) * wanted_rate);
  last_tick = *rests_since + static_cast<double>(ticks) / wanted_rate;
  rests_since.reset();
  simulation.pass(ticks);
  next_tick = simulation.state()->tick;
  publish();
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
  done.wait(lock, [this] { return !is_ticking && !rewinds_to; });
  --holds;
  wake.notify_all();
}

std::shared_ptr<const State> LiveSession::Shared::coming(std::unique_lock<std::mutex>& lock) {
  end_rest();
  wait_between_ticks(lock);
  call_off_failed_rewind();
  (void)gestures.say_due(next_tick, std::numeric_limits<double>::infinity());
  gather_changes();
  return pending ? simulation.with_scene(*pending, pending_placed) : simulation.state();
}

std::optional<std::int64_t> LiveSession::Shared::tick_before(std::int64_t ticks) const {
  if (ticks <= 0 || past.empty() || past.oldest() >= next_tick) return std::nullopt;
  return past.reachable(std::min(next_tick - ticks, next_tick - 1));
}

// The present state goes on from there under the present plan.
void LiveSession::Shared::go_on_from(std::shared_ptr<const State> earlier) {
  past.forget_from(earlier->tick);
  simulation.return_to(std::move(earlier));
  preview = nullptr;
  served = -1;
  shown.reset();
  next_tick = simulation.state()->tick;
}

// A rewind to a tick whose state has to be computed again; the lock is given up meanwhile.
void LiveSession::Shared::rewind(std::unique_lock<std::mutex>& lock) {
  const std::int64_t tick = *rewinds_to;
  const std::shared_ptr<const State> present = simulation.state();
  std::shared_ptr<const State> earlier;
  std::string trouble;
  is_ticking = true;
  lock.unlock();
  try {
    simulation.measure(nullptr);
    if (const auto reached = past.recompute(tick, simulation)) earlier = simulation.state();
    else trouble = "the rewind failed (" + reached.error().text() + "); the clock is stopped";
  } catch (const std::exception& exception) {
    trouble = std::string("the rewind failed (") + exception.what() + "); the clock is stopped";
  }
  simulation.put_back(present);
  simulation.measure(times.get());
  lock.lock();
  is_ticking = false;
  // Somebody may want to go back further by now.
  const bool is_last = rewinds_to == tick;
  if (is_last) rewinds_to.reset();
  if (earlier && is_last) go_on_from(std::move(earlier));
  if (!trouble.empty()) {
    rewinds_to.reset();
    failed_rewind = first_rewind;
    next_tick = tick_before_rewind;
    failure = std::move(trouble);
    is_playing = false;
    steps_due = 0;
  }
  if (!rewinds_to) publish();
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
  follow_times();
  shown = said();
  auto scene = scene_to_read();
  const std::int64_t seq = ledger.last_seq();
  is_ticking = true;
  next_tick = simulation.state()->tick + 1;
  std::string trouble;
  lock.unlock();
  const double begin = clock.now();
  try {
    // What is taken from the ledger stays pending until the simulation has really taken it on.
    if (pending) {
      simulation.set_scene(*pending, pending_placed);
      past.set_scene(simulation.state()->tick, *pending, std::move(pending_placed));
    }
    pending.reset();
    pending_placed.clear();
    past.add(simulation.state());
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
  if (!pending) read = std::move(scene), read_seq = seq;
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
  bool has_rested = false;
  while (!is_ending) {
    if (rewinds_to) {
      rewind(lock);
      done.notify_all();
      continue;
    }
    if (holds > 0) {
      done.notify_all();
      wake.wait(lock);
      continue;
    }
    if (rests_since || can_rest()) {
      if (!rests_since) {
        // A clock that has stood until now has not counted on.
        rests_since = std::max(last_tick, clock.now() - 1 / wanted_rate);
        publish();
      }
      has_rested = true;
      done.notify_all();
      wake.wait(lock);
      continue;
    }
    // The clock counted on meanwhile: the next tick is due when it would have been.
    if (std::exchange(has_rested, false)) due = last_tick + 1 / wanted_rate;
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

}  // namespace bl::host
