// Ends a test program that waits for ever with a sentence, instead of leaving it to whoever watches the clock.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdio>
#include <cstdlib>
#include <mutex>
#include <string>
#include <thread>

namespace bl {

/// What follows it in its scope has to come to an end within `seconds`.
class Deadline {
 public:
  Deadline(int seconds, std::string what) : what_(std::move(what)), watch_([this, seconds] { wait(seconds); }) {}
  ~Deadline() {
    {
      const std::lock_guard lock(mutex_);
      is_met_ = true;
    }
    met_.notify_all();
    watch_.join();
  }
  Deadline(const Deadline&) = delete;
  Deadline& operator=(const Deadline&) = delete;

 private:
  void wait(int seconds) {
    std::unique_lock lock(mutex_);
    if (met_.wait_for(lock, std::chrono::seconds(seconds), [this] { return is_met_; })) return;
    std::fprintf(stderr, "not done within %d seconds: %s\n", seconds, what_.c_str());
    std::abort();
  }

  std::string what_;
  std::mutex mutex_;
  std::condition_variable met_;
  bool is_met_ = false;
  std::thread watch_;  // the last member: it reads the others
};

}  // namespace bl
