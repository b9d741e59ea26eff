// The clock of a running session: the real one, or one that a test moves by hand. No result depends on it.
#pragma once

#include <condition_variable>
#include <functional>
#include <mutex>

namespace bl::host {

class Clock {
 public:
  virtual ~Clock() = default;
  /// Seconds since some moment; never goes back.
  virtual double now() const = 0;
  /// Waits until it is so late, or something wakes the waiting; it may also wake without a reason.
  virtual void wait(std::condition_variable& wake, std::unique_lock<std::mutex>& lock, double until) = 0;
  virtual void sleep(double seconds) = 0;
};

/// The real time that passes.
Clock& real_clock();

/// Keeps a loop of ticks at its rate. A late tick is not made up for, so that ticks never queue behind themselves.
class Pace {
 public:
  explicit Pace(Clock& clock) : clock_(&clock), due_(clock.now()) {}
  /// Waits until so many seconds after the last call, or until the wait is over for another reason, which is asked now and then.
  void wait(double seconds, const std::function<bool()>& is_over);

 private:
  Clock* clock_;
  double due_;
};

}  // namespace bl::host
