// Waiting that ends with a stop request.
#pragma once

#include <chrono>
#include <condition_variable>
#include <mutex>

#include "core/base/stop_check.h"

namespace bl {

/// Waits until `is_over` is true or a stop is requested; both are checked twenty times a second.
template <class Predicate>
void wait_unless_stopped(std::condition_variable& changed, std::unique_lock<std::mutex>& lock, Predicate is_over) {
  constexpr std::chrono::milliseconds kBetweenLooks{50};
  while (!changed.wait_for(lock, kBetweenLooks, is_over) && !is_stop_wished()) {}
}

}  // namespace bl
