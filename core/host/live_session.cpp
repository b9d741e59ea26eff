// What the holder says to a session, and what it asks.
#include "core/host/live_session.h"

#include <algorithm>
#include <limits>

#include "core/host/ticker.h"

namespace bl::host {

namespace {

constexpr double kFarAhead = std::numeric_limits<double>::infinity();

}  // namespace

LiveSession::LiveSession(const Registry& registry, const Scene& scene, std::int64_t base, LiveSessionOptions options)
    : options_(std::move(options)),
      ledger_(registry, scene, base),
      gestures_(ledger_),
      shared_(std::make_unique<Shared>(registry, ledger_, gestures_, options_)) {}

Result<std::unique_ptr<LiveSession>> LiveSession::start(const Registry& registry, const Scene& scene, const SavedState* state,
                                                        LiveSessionOptions options) {
  const auto no_history = [](Ledger&) { return Result<void>(); };
  return go_on(registry, scene, 0, no_history, state, std::move(options));
}

Result<std::unique_ptr<LiveSession>> LiveSession::go_on(const Registry& registry, const Scene& beginning, std::int64_t base,
                                                        const std::function<Result<void>(Ledger&)>& history,
                                                        const SavedState* state, LiveSessionOptions options) {
  std::unique_ptr<LiveSession> session(new LiveSession(registry, beginning, base, std::move(options)));
  Shared& shared = *session->shared_;
  if (auto done = history(session->ledger_); !done) return done.error();
  (void)session->ledger_.take_changes();  // the state that follows knows them
  shared.simulation.set_scene(session->ledger_.scene());
  if (state != nullptr)
    if (auto restored = shared.simulation.restore_state(*state); !restored) return restored.error();
  shared.next_tick = shared.simulation.state()->tick;
  shared.note_read();
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

// With the mutex held.
Result<void> LiveSession::end_own_gestures(std::int64_t but) {
  return but != 0 && gestures_.is_open(but) ? Result<void>() : gestures_.end_all(options_.author, shared_->next_tick);
}

Result<void> LiveSession::submit(const Command& command, std::int64_t gesture, const std::string& label) {
  const std::lock_guard lock(shared_->mutex);
  shared_->begin_to_hear();
  if (auto ended = end_own_gestures(gesture); !ended) return ended;
  return ledger_.submit({command, options_.author, gesture, {options_.origin}, label}, shared_->next_tick);
}

Result<void> LiveSession::submit(Submission submission) {
  const std::lock_guard lock(shared_->mutex);
  shared_->begin_to_hear();
  return ledger_.submit(std::move(submission), shared_->next_tick);
}

void LiveSession::say(const std::function<void(Ledger& ledger, std::int64_t tick)>& words) {
  const std::lock_guard lock(shared_->mutex);
  shared_->begin_to_hear();
  words(ledger_, shared_->next_tick);
}

void LiveSession::say_between_ticks(
    const std::function<std::shared_ptr<const State>(Ledger& ledger, const std::shared_ptr<const State>& coming)>& words) {
  std::unique_lock lock(shared_->mutex);
  Shared& shared = *shared_;
  const auto coming = shared.coming(lock);
  auto earlier = words(ledger_, coming);
  if (!earlier) return;
  shared.gather_changes();
  if (shared.pending) shared.simulation.set_scene(*shared.pending, shared.pending_placed);
  shared.pending.reset();
  shared.pending_placed.clear();
  shared.note_read();
  shared.go_on_from(std::move(earlier));
  shared.publish();
}

Result<void> LiveSession::show(const Command& command, std::int64_t gesture) {
  const std::lock_guard lock(shared_->mutex);
  shared_->begin_to_hear();
  if (auto ended = end_own_gestures(gesture); !ended) return ended;
  return gestures_.show({command, options_.author, gesture, {options_.origin}, {}}, shared_->next_tick, shared_->clock.now());
}

Result<void> LiveSession::keep_up() {
  gestures_.forget_past();
  if (!gestures_.is_waiting()) return {};
  const std::lock_guard lock(shared_->mutex);
  shared_->begin_to_hear();
  return gestures_.say_due(shared_->next_tick, shared_->clock.now());
}

Result<void> LiveSession::end_gesture(std::int64_t gesture) {
  const std::lock_guard lock(shared_->mutex);
  shared_->begin_to_hear();
  return gestures_.end(gesture, shared_->next_tick);
}

void LiveSession::abandon(std::int64_t gesture) {
  const std::lock_guard lock(shared_->mutex);
  shared_->begin_to_hear();
  gestures_.drop(gesture);
  // The ticks have seen what was said of it, so that the log keeps it and what takes it back.
  if (gesture != 0) (void)ledger_.abandon(options_.author, shared_->next_tick, gesture);
}

Result<TakenBack> LiveSession::undo(std::int64_t gesture) {
  const std::lock_guard lock(shared_->mutex);
  shared_->begin_to_hear();
  if (auto ended = end_own_gestures(); !ended) return ended.error();
  return ledger_.undo(options_.author, shared_->next_tick, gesture, {options_.origin});
}

Result<TakenBack> LiveSession::redo() {
  const std::lock_guard lock(shared_->mutex);
  shared_->begin_to_hear();
  if (auto ended = end_own_gestures(); !ended) return ended.error();
  return ledger_.redo(options_.author, shared_->next_tick, 0, {options_.origin});
}

Result<void> LiveSession::recover(LogEntry entry) {
  const std::lock_guard lock(shared_->mutex);
  shared_->begin_to_hear();
  entry.tick = shared_->next_tick;
  return ledger_.replay(entry);
}

const std::vector<LogEntry>& LiveSession::log() const {
  const std::lock_guard lock(shared_->mutex);
  shared_->call_off_failed_rewind();
  return ledger_.log();
}

void LiveSession::finish_rewind() {
  std::unique_lock lock(shared_->mutex);
  shared_->done.wait(lock, [this] { return !shared_->rewinds_to; });
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
  const std::lock_guard lock(shared_->mutex);
  shared_->stir();
  shared_->is_playing = is_playing;
  if (!shared_->is_ticking) shared_->publish();
}

void LiveSession::watch_times(bool is_watched) {
  const std::lock_guard lock(shared_->mutex);
  shared_->are_times_watched = is_watched;
}

void LiveSession::set_rate(double ticks_per_second) {
  const std::lock_guard lock(shared_->mutex);
  shared_->stir();
  shared_->wanted_rate = std::clamp(ticks_per_second, 0.1, 1000.0);
  if (!shared_->is_ticking) shared_->publish();
}

void LiveSession::step(int ticks) {
  const std::lock_guard lock(shared_->mutex);
  shared_->stir();
  shared_->steps_due += std::max(0, ticks);
}

void LiveSession::make_ticks_wait(bool is_waiting) {
  const std::lock_guard lock(shared_->mutex);
  shared_->stir();
  shared_->do_ticks_wait = is_waiting;
}

bool LiveSession::do_ticks_wait() const {
  const std::lock_guard lock(shared_->mutex);
  return shared_->do_ticks_wait;
}

std::optional<std::int64_t> LiveSession::unserved_tick() const {
  const std::lock_guard lock(shared_->mutex);
  const Shared& shared = *shared_;
  const bool is_wanted = shared.is_playing || shared.steps_due > 0;
  if (shared.is_ticking || shared.rewinds_to || !is_wanted || !shared.is_held_up()) return std::nullopt;
  return shared.simulation.state()->tick;
}

void LiveSession::serve(std::int64_t tick) {
  {
    const std::lock_guard lock(shared_->mutex);
    shared_->served = tick;
  }
  shared_->wake.notify_all();
}

void LiveSession::let_rest(bool may_rest) {
  const std::lock_guard lock(shared_->mutex);
  if (shared_->may_rest == may_rest) return;
  shared_->stir();
  shared_->may_rest = may_rest;
}

void LiveSession::rewind(std::int64_t ticks) {
  std::unique_lock lock(shared_->mutex);
  Shared& shared = *shared_;
  shared.end_rest();
  // Who goes back further while a state is computed does not wait for that one.
  const bool is_under_way = shared.rewinds_to.has_value();
  if (!is_under_way) shared.wait_between_ticks(lock);
  shared.call_off_failed_rewind();
  (void)gestures_.say_due(shared.next_tick, kFarAhead);  // what fits no more is not shown any longer, either
  const auto tick = shared.tick_before(ticks);
  if (!tick) return;
  (void)ledger_.rewind(options_.author, shared.next_tick, *tick);  // it is before the next tick
  if (!is_under_way) {
    shared.first_rewind = ledger_.last_seq();
    shared.tick_before_rewind = shared.next_tick;
  }
  shared.next_tick = *tick;
  if (auto state = is_under_way ? nullptr : shared.past.whole(*tick)) {
    shared.go_on_from(std::move(state));
    shared.publish();
  } else {
    shared.rewinds_to = *tick;
    shared.wake.notify_all();
  }
}

std::shared_ptr<const State> LiveSession::coming_state() {
  std::unique_lock lock(shared_->mutex);
  return shared_->coming(lock);
}

void LiveSession::settle() {
  std::unique_lock lock(shared_->mutex);
  shared_->wake.notify_all();
  shared_->done.wait(lock, [this] {
    // Ticks that wait to be served are not waited for: who serves them may be who asks.
    return !shared_->rewinds_to && (shared_->steps_due == 0 || (!shared_->is_ticking && shared_->is_held_up())) &&
           !shared_->is_news();
  });
  shared_->wait_between_ticks(lock);
}

}  // namespace bl::host
