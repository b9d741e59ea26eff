// What a long import tells the one who waits for it, and the way to stop it.
#pragma once

#include <atomic>
#include <cstddef>

namespace bl::importing {

/// Read and written by two threads at once. What is told is for the eye only: no result depends on it.
struct ImportWatch {
  std::atomic<bool> is_stopped{false};         ///< set by the one who waits
  std::atomic<std::size_t> file{0};            ///< which file, from 0
  std::atomic<const char*> step{"reading"};    ///< what is done with it
  std::atomic<std::size_t> done{0}, total{0};  ///< elements of that step; a total of 0 is not known
};

/// Tells how far it is; whether to go on. `watch` may be null.
inline bool goes_on(ImportWatch* watch, const char* step, std::size_t done, std::size_t total) {
  if (watch == nullptr) return true;
  watch->step = step;
  watch->done = done;
  watch->total = total;
  return !watch->is_stopped;
}

}  // namespace bl::importing
