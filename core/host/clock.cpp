// The steady clock of the system.
#include "core/host/clock.h"

#include <algorithm>
#include <chrono>
#include <thread>

namespace bl::host {

namespace {

using Seconds = std::chrono::duration<double>;

// In one wait no longer than this, so that any number of seconds is a time that the system knows [s].
constexpr double kLongestWait = 3600;
// Whoever ends a wait is heard within this time [s].
constexpr double kSlice = 0.05;

class RealClock final : public Clock {
 public:
  double now() const override { return Seconds(std::chrono::steady_clock::now().time_since_epoch()).count(); }
  void wait(std::condition_variable& wake, std::unique_lock<std::mutex>& lock, double until) override {
    wake.wait_for(lock, Seconds(std::clamp(until - now(), 0.0, kLongestWait)));
  }
  void sleep(double seconds) override { std::this_thread::sleep_for(Seconds(seconds)); }
};

}  // namespace

Clock& real_clock() {
  static RealClock clock;
  return clock;
}

void Pace::wait(double seconds, const std::function<bool()>& is_over) {
  due_ = std::max(clock_->now(), due_ + seconds);
  while (!is_over() && clock_->now() < due_) clock_->sleep(std::min(due_ - clock_->now(), kSlice));
}

}  // namespace bl::host
