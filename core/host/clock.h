// The clock of a running session: the real one, or one that a test moves by hand. No result depends on it.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <functional>
#include <mutex>

namespace bl::host {

class Clock {
 public:
  virtual ~Clock() = default;
  /// Seconds since a fixed moment; never goes back.
  virtual double now() const = 0;
  /// Waits until this time, or until it is woken; it may also wake early without a reason.
  virtual void wait(std::condition_variable& wake, std::unique_lock<std::mutex>& lock, double until) = 0;
  /// May end early, as at a signal.
  virtual void sleep(double seconds) = 0;
};

/// The real time that passes.
Clock& real_clock();

/// Keeps a loop of ticks at its rate. A late tick is not made up for, so that ticks never pile up.
class Pace {
 public:
  explicit Pace(Clock& clock) : clock_(&clock), due_(clock.now()) {}
  /// Waits until this number of seconds after the last call, or until the given condition, which is checked now and then, ends
  /// the wait. With `times`, so many such waits in one. Returns how many of them went by.
  std::int64_t wait(double seconds, const std::function<bool()>& is_over, std::int64_t times = 1);

 private:
  Clock* clock_;
  double due_;
};

}  // namespace bl::host
