// A tick is taken once its mark is here: then no entry that it reads can come any more.
#include "core/guest/follower.h"

#include <algorithm>
#include <exception>
#include <limits>

#include "core/base/hash.h"

namespace bl::guest {

namespace {

// New ticks count so much in the smoothed times.
constexpr double kSmoothing = 0.15;
// Who holds the ticks up is looked for again after so long [s].
constexpr double kPause = 0.001;

}  // namespace

Follower::Follower(const Registry& registry, int threads, host::Clock& clock) : clock_(clock), simulation_(registry, threads) {
  simulation_.set_scene(Scene{});
  publish();
  thread_ = std::thread([this] { run(); });
}

Follower::~Follower() {
  {
    const std::lock_guard lock(mutex_);
    is_ending_ = true;
  }
  wake_.notify_all();
  thread_.join();
}

void Follower::changed() {
  is_stale_ = true;
  wake_.notify_all();
}

// Returns with the mutex held; until it is given up, no tick begins.
void Follower::wait_between_ticks(std::unique_lock<std::mutex>& lock) {
  ++holds_;
  done_.wait(lock, [this] { return !is_busy_; });
  --holds_;
}

Result<void> Follower::begin(const Scene& scene, const SavedState* state) {
  std::unique_lock lock(mutex_);
  wait_between_ticks(lock);
  settings_.clear();
  marks_.clear();
  wished_.reset();
  difference_.reset();
  is_difference_told_ = false;
  shown_ = nullptr;
  is_resting_ = false;
  // A state of the same scene would be kept by set_scene(); what comes is to be as it was sent.
  simulation_.set_scene(Scene{});
  simulation_.set_scene(scene);
  const auto restored = state == nullptr ? Result<void>() : simulation_.restore_state(*state);
  reached_ = simulation_.state()->tick;
  changed();
  publish();
  return restored;
}

void Follower::set_scene(std::int64_t tick, Scene scene, Placed placed) {
  const std::lock_guard lock(mutex_);
  if (difference_) return;
  if (tick < reached_ || (!settings_.empty() && tick < settings_.rbegin()->first)) {
    difference_ = Difference{.tick = tick, .why = "late", .expected = {}, .found = {}, .text = {}};
    return changed();
  }
  Setting& setting = settings_[tick];
  setting.scene = std::move(scene);
  setting.placed.merge(placed);
  changed();
}

void Follower::set_next(Scene scene, Placed placed) {
  const std::lock_guard lock(mutex_);
  if (difference_) return;
  Setting& setting = settings_[settings_.empty() ? reached_ : std::max(reached_, settings_.rbegin()->first)];
  setting.scene = std::move(scene);
  setting.placed.merge(placed);
  changed();
}

void Follower::mark(Mark mark) {
  const std::lock_guard lock(mutex_);
  if (difference_) return;
  is_resting_ = mark.is_resting;
  const std::int64_t last = marks_.empty() ? reached_ : marks_.back().tick;
  if (mark.tick > last) marks_.push_back(std::move(mark));
  else if (!is_busy_) publish();
  wake_.notify_all();
}

void Follower::show(Scene scene, Placed placed) {
  const std::lock_guard lock(mutex_);
  wished_ = Setting{std::move(scene), std::move(placed)};
  changed();
}

void Follower::show_nothing_more() {
  const std::lock_guard lock(mutex_);
  if (!wished_) return;
  wished_.reset();
  changed();
}

void Follower::set_pace(bool is_playing, double rate) {
  const std::lock_guard lock(mutex_);
  if (is_playing == is_playing_ && rate == rate_) return;
  is_playing_ = is_playing;
  rate_ = std::max(0.1, rate);
  if (!is_busy_) publish();
  wake_.notify_all();
}

std::shared_ptr<const host::Moment> Follower::moment() const {
  const std::lock_guard lock(mutex_);
  return published_;
}

std::size_t Follower::subscribe(Listener listener) {
  const std::lock_guard lock(mutex_);
  listeners_.emplace(++last_listener_, std::move(listener));
  return last_listener_;
}

void Follower::unsubscribe(std::size_t number) {
  const std::lock_guard lock(mutex_);
  listeners_.erase(number);
}

void Follower::watch_times(bool is_watched) {
  const std::lock_guard lock(mutex_);
  are_times_watched_ = is_watched;
}

void Follower::nudge() {
  const std::lock_guard lock(mutex_);
  for (const auto& [number, listener] : listeners_) listener(published_);
}

std::shared_ptr<const State> Follower::state_with(const Scene& scene, const Placed& placed) {
  std::unique_lock lock(mutex_);
  wait_between_ticks(lock);
  Placed all = placed;
  for (const auto& [tick, setting] : settings_) all.insert(setting.placed.begin(), setting.placed.end());
  return simulation_.with_scene(scene, all);
}

std::optional<Difference> Follower::take_difference() {
  const std::lock_guard lock(mutex_);
  if (!difference_ || std::exchange(is_difference_told_, true)) return std::nullopt;
  return difference_;
}

bool Follower::has_difference() const {
  const std::lock_guard lock(mutex_);
  return difference_ && !is_difference_told_;
}

std::int64_t Follower::agreed() const {
  const std::lock_guard lock(mutex_);
  return agreed_;
}

std::int64_t Follower::behind() const {
  const std::lock_guard lock(mutex_);
  return marks_.empty() ? 0 : marks_.back().tick - published_->ticked->tick;
}

void Follower::settle() {
  std::unique_lock lock(mutex_);
  done_.wait(lock, [this] { return !is_busy_ && !can_tick() && !is_stale_; });
}

// With the mutex held, as all that follow.
void Follower::publish() {
  auto moment = std::make_shared<host::Moment>();
  moment->ticked = simulation_.state();
  moment->state = shown_ ? shown_ : moment->ticked;
  moment->is_playing = is_playing_;
  moment->is_resting = is_resting_ && marks_.empty();
  moment->wanted_rate = rate_;
  moment->tick_seconds = tick_seconds_;
  moment->rate = is_playing_ ? reached_rate_ : 0;
  moment->oldest = moment->ticked->tick;
  if (times_ && times_->ticks() > 0) moment->times = std::make_shared<TimeTable>(times_->table());
  if (difference_) moment->failure = difference_->text;
  published_ = std::move(moment);
  for (const auto& [number, listener] : listeners_) listener(published_);
}

// While few ticks wait, each comes when the room's clock would have it; who is behind does not wait.
double Follower::due() const {
  const std::int64_t waiting = marks_.back().tick - simulation_.state()->tick;
  // Not the present time: who compares it with another look at the clock would find it later each time.
  constexpr double kAtOnce = -std::numeric_limits<double>::infinity();
  return waiting > kBuffer ? kAtOnce : last_tick_ + 0.9 / rate_;
}

// What no tick has read, as the next one will begin with it.
void Follower::refresh(std::unique_lock<std::mutex>& lock) {
  is_stale_ = false;
  std::optional<Setting> setting = wished_;
  if (!setting && !settings_.empty()) setting = settings_.rbegin()->second;
  if (setting)
    for (const auto& [tick, other] : settings_) setting->placed.insert(other.placed.begin(), other.placed.end());
  is_busy_ = true;
  lock.unlock();
  std::shared_ptr<const State> seen = simulation_.state();
  try {
    if (setting) seen = simulation_.with_scene(setting->scene, setting->placed);
    seen = simulation_.shown(std::move(seen));
  } catch (const std::exception&) {
    // The next tick will say so.
  }
  lock.lock();
  is_busy_ = false;
  shown_ = seen == simulation_.state() ? nullptr : std::move(seen);
  publish();
}

void Follower::tick(std::unique_lock<std::mutex>& lock) {
  const std::int64_t now = simulation_.state()->tick;
  std::optional<Setting> setting;
  if (const auto found = settings_.find(now); found != settings_.end()) {
    setting = std::move(found->second);
    settings_.erase(found);
  }
  const std::int64_t next = settings_.empty() ? marks_.front().tick : std::min(marks_.front().tick, settings_.begin()->first);
  if (are_times_watched_ != (times_ != nullptr)) {
    times_ = are_times_watched_ ? std::make_unique<TickTimes>([] { return host::real_clock().now(); }) : nullptr;
    simulation_.measure(times_.get());
  }
  const bool is_passing = !setting && simulation_.is_idle();
  reached_ = is_passing ? next : now + 1;
  is_busy_ = true;
  lock.unlock();
  std::string trouble;
  const double begin = clock_.now();
  try {
    if (setting) simulation_.set_scene(setting->scene, setting->placed);
    if (is_passing) simulation_.pass(next - now);
    else simulation_.step();
  } catch (const std::exception& exception) { trouble = std::string("a tick failed here (") + exception.what() + ")"; }
  const double end = clock_.now(), seconds = end - begin, since = end - last_tick_;
  lock.lock();
  is_busy_ = false;
  tick_seconds_ = tick_seconds_ == 0 ? seconds : tick_seconds_ + kSmoothing * (seconds - tick_seconds_);
  reached_rate_ = since > 2 ? 0 : reached_rate_ + kSmoothing * (1 / std::max(1e-4, since) - reached_rate_);
  last_tick_ = end;
  const State& state = *simulation_.state();
  if (!trouble.empty()) {
    difference_ = Difference{.tick = state.tick, .why = "failed", .expected = {}, .found = {}, .text = trouble};
  } else if (state.tick == marks_.front().tick) {
    const std::string found = hex_digits(state.hash);
    const Mark mark = marks_.front();
    marks_.pop_front();
    if (mark.hash == found) ++agreed_;
    else if (!mark.hash.empty())
      difference_ = Difference{.tick = state.tick, .why = "hash", .expected = mark.hash, .found = found, .text = {}};
  }
  if (difference_) marks_.clear();
  const std::int64_t waiting = marks_.empty() ? 0 : marks_.back().tick - state.tick;
  shown_ = nullptr;
  if (wished_ || !settings_.empty()) is_stale_ = true;
  else if (waiting <= kFarBehind || state.tick % kFarBehind == 0 || difference_) publish();
}

void Follower::run() {
  std::unique_lock lock(mutex_);
  while (!is_ending_) {
    if (holds_ > 0) {
      done_.notify_all();
      clock_.wait(wake_, lock, clock_.now() + kPause);
      continue;
    }
    if (can_tick() && clock_.now() >= due()) {
      tick(lock);
      done_.notify_all();
      const std::int64_t waiting = marks_.empty() ? 0 : marks_.back().tick - simulation_.state()->tick;
      if (is_stale_ && waiting <= kFarBehind) refresh(lock);
      continue;
    }
    if (is_stale_) {
      refresh(lock);
      continue;
    }
    done_.notify_all();
    if (can_tick()) clock_.wait(wake_, lock, due());
    else wake_.wait(lock);
  }
}

}  // namespace bl::guest
