// The progress of a long import, and the request to stop it.
#pragma once

#include <atomic>
#include <cstddef>

namespace bl::importing {

/// Read and written by two threads at once. The progress is for display only: no result depends on it.
struct ImportWatch {
  std::atomic<bool> is_stopped{false};         ///< set by the caller to stop the import
  std::atomic<std::size_t> file{0};            ///< which file, from 0
  std::atomic<const char*> step{"reading"};    ///< the present step
  std::atomic<std::size_t> done{0}, total{0};  ///< elements of that step; a total of 0 is not known
};

/// Reports the progress, and returns whether to go on. `watch` may be null.
inline bool goes_on(ImportWatch* watch, const char* step, std::size_t done, std::size_t total) {
  if (watch == nullptr) return true;
  watch->step = step;
  watch->done = done;
  watch->total = total;
  return !watch->is_stopped;
}

}  // namespace bl::importing
