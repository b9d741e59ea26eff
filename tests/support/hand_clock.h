// A clock that a test moves by hand.
#pragma once

#include <atomic>
#include <chrono>

#include "core/host/clock.h"

namespace bl::test {

class HandClock final : public host::Clock {
 public:
  void advance(double seconds) { now_ = now_ + seconds; }
  double now() const override { return now_; }
  // Whoever waits looks at the clock again after a moment of real time.
  void wait(std::condition_variable& wake, std::unique_lock<std::mutex>& lock, double until) override {
    if (now_ < until) wake.wait_for(lock, std::chrono::milliseconds(1));
  }
  void sleep(double seconds) override { advance(seconds); }

 private:
  std::atomic<double> now_ = 100;  // [s]
};

}  // namespace bl::test
