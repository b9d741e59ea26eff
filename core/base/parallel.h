// A small thread pool with passive waiting, and parallel_for over fixed chunks.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>

namespace bl {

/// Runs chunks of work on `threads` threads, the caller among them. One loop at a time; loops must not nest.
/// Which thread runs a chunk is not fixed; chunks must write to places of their own, so that results do not depend on it.
class ThreadPool {
 public:
  explicit ThreadPool(int threads = 1);
  ~ThreadPool();
  ThreadPool(const ThreadPool&) = delete;
  ThreadPool& operator=(const ThreadPool&) = delete;

  int threads() const { return threads_; }
  /// Calls body(begin, end) for consecutive chunks of `grain` indices that cover [0, count).
  /// Chunk borders depend on count and grain only. The first exception of a body is thrown again here.
  void for_each_chunk(std::size_t count, std::size_t grain, const std::function<void(std::size_t, std::size_t)>& body);

 private:
  struct Shared;
  std::unique_ptr<Shared> shared_;
  int threads_;
};

}  // namespace bl
