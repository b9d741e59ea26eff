// The steady clock of the system.
#include "core/host/clock.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>

namespace bl::host {

namespace {

using Seconds = std::chrono::duration<double>;

// In one wait no longer than this, so that any number of seconds is a time that the system knows [s].
constexpr double kLongestWait = 3600;
// Whoever ends a wait without a signal is heard within this time [s].
constexpr double kSlice = 0.5;

class RealClock final : public Clock {
 public:
  double now() const override { return Seconds(std::chrono::steady_clock::now().time_since_epoch()).count(); }
  void wait(std::condition_variable& wake, std::unique_lock<std::mutex>& lock, double until) override {
    wake.wait_for(lock, Seconds(std::clamp(until - now(), 0.0, kLongestWait)));
  }
  // As the system sleeps, not as the library does, which sleeps on after a signal.
  void sleep(double seconds) override {
    const double most = std::clamp(seconds, 0.0, kLongestWait), whole = std::floor(most);
    const struct timespec time { static_cast<std::time_t>(whole), static_cast<long>(1e9 * (most - whole)) };
    (void)::nanosleep(&time, nullptr);
  }
};

}  // namespace

Clock& real_clock() {
  static RealClock clock;
  return clock;
}

std::int64_t Pace::wait(double seconds, const std::function<bool()>& is_over, std::int64_t times) {
  const double begin = std::max(clock_->now() - seconds, due_);
  due_ = begin + static_cast<double>(times) * seconds;
  while (clock_->now() < due_) {
    if (!is_over()) {
      clock_->sleep(std::min(due_ - clock_->now(), kSlice));
      continue;
    }
    const auto gone = static_cast<std::int64_t>((clock_->now() - begin) / seconds);
    due_ = begin + static_cast<double>(gone) * seconds;
    return gone;
  }
  return times;
}

}  // namespace bl::host
