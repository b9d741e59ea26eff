// The pool: workers sleep on a condition variable, chunks are handed out by an atomic counter.
#include "core/base/parallel.h"

#include <algorithm>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

#include "core/base/stop_check.h"

namespace bl {

struct ThreadPool::Shared {
  std::mutex mutex;
  std::condition_variable work_ready, work_done;
  const std::function<void(std::size_t, std::size_t)>* body = nullptr;
  const StopWish* wish = nullptr;  // of the caller
  std::size_t count = 0, grain = 1, next = 0, running = 0;
  std::exception_ptr failure;
  bool is_stopping = false;
  std::vector<std::thread> workers;

  // Takes chunks until none is left; called with the lock held, and returns with it held.
  void drain(std::unique_lock<std::mutex>& lock) {
    while (body != nullptr && next < count) {
      const std::size_t begin = next, end = std::min(count, next + grain);
      next = end;
      ++running;
      const auto* current = body;
      const StopWish* wished = wish;
      lock.unlock();
      std::exception_ptr caught;
      bool is_stopped = false;
      try {
        const InheritedStop loan(wished);
        is_stopped = is_stop_wished();
        if (!is_stopped) (*current)(begin, end);
      } catch (...) { caught = std::current_exception(); }
      lock.lock();
      --running;
      if (is_stopped) next = count;
      if (caught && !failure) failure = caught;
    }
    if (running == 0) work_done.notify_all();
  }
};

ThreadPool::ThreadPool(int threads) : threads_(std::max(1, threads)) {
  if (threads_ == 1) return;
  shared_ = std::make_unique<Shared>();
  shared_->workers.reserve(static_cast<std::size_t>(threads_) - 1);
  const auto work = [s = shared_.get()] {
    std::unique_lock lock(s->mutex);
    while (true) {
      s->work_ready.wait(lock, [s] { return s->is_stopping || (s->body != nullptr && s->next < s->count); });
      if (s->is_stopping) return;
      s->drain(lock);
    }
  };
  try {
    for (int i = 1; i < threads_; ++i) shared_->workers.emplace_back(work);
  } catch (const std::system_error&) {
    // The system gives no more of them: those that are there do the work, and the result is the same.
    threads_ = 1 + static_cast<int>(shared_->workers.size());
    if (threads_ == 1) shared_.reset();
  }
}

ThreadPool::~ThreadPool() {
  if (!shared_) return;
  {
    const std::lock_guard lock(shared_->mutex);
    shared_->is_stopping = true;
  }
  shared_->work_ready.notify_all();
  for (auto& worker : shared_->workers) worker.join();
}

void ThreadPool::for_each_chunk(std::size_t count, std::size_t grain, const std::function<void(std::size_t, std::size_t)>& body) {
  grain = std::max<std::size_t>(1, grain);
  if (!shared_ || count <= grain) {
    for (std::size_t begin = 0; begin < count && !is_stop_wished(); begin += grain) body(begin, std::min(count, begin + grain));
    return;
  }
  std::unique_lock lock(shared_->mutex);
  shared_->body = &body;
  shared_->wish = stop_wish();
  shared_->count = count;
  shared_->grain = grain;
  shared_->next = 0;
  shared_->failure = nullptr;
  shared_->work_ready.notify_all();
  shared_->drain(lock);
  shared_->work_done.wait(lock, [this] { return shared_->running == 0; });
  shared_->body = nullptr;
  if (shared_->failure) std::rethrow_exception(shared_->failure);
}

}  // namespace bl
