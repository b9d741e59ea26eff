// The thread gathers until the first has waited long enough, stores, tells, and begins anew.
#include "core/journal/writer.h"

#include <algorithm>
#include <limits>

namespace bl::journal {

Writer::Writer(std::unique_ptr<Journal> journal, Clock clock, Settings settings)
    : journal_(std::move(journal)), clock_(std::move(clock)), settings_(settings), thread_([this] { work(); }) {}

Writer::~Writer() {
  {
    const std::lock_guard lock(mutex_);
    is_ending_ = true;
  }
  wake_.notify_all();
  thread_.join();
}

void Writer::submit(room::Record record, Done done) { add({std::move(record), {}, std::move(done)}); }

void Writer::perform(Task task, Done done) { add({{}, std::move(task), std::move(done)}); }

void Writer::add(Job job) {
  job.came = clock_.now();
  {
    const std::lock_guard lock(mutex_);
    jobs_.push_back(std::move(job));
  }
  wake_.notify_all();
}

void Writer::resume() {
  const std::lock_guard lock(mutex_);
  problem_ = {};
}

std::string Writer::problem() const {
  const std::lock_guard lock(mutex_);
  return problem_ ? std::string() : problem_.error().text();
}

Writer::Latency Writer::latency() const {
  std::vector<double> times;
  {
    const std::lock_guard lock(mutex_);
    times.assign(times_.begin(), times_.begin() + static_cast<std::ptrdiff_t>(std::min(times_count_, times_.size())));
  }
  if (times.empty()) return {};
  std::sort(times.begin(), times.end());
  return {times[(times.size() - 1) / 2], times[(times.size() - 1) * 95 / 100], times.size()};
}

std::size_t Writer::entries_waiting() const {
  std::size_t count = 0;
  for (const Job& job : jobs_) {
    if (job.task) break;
    count += job.record.entries.size();
  }
  return count;
}

// The records before the next task, as many as a transaction takes; or that task.
std::vector<Writer::Job> Writer::next_batch(std::unique_lock<std::mutex>& lock) {
  // A failure is told at once, and at the end nobody else comes.
  while (problem_ && !is_ending_) {
    if (jobs_.empty()) {
      wake_.wait(lock);
      continue;
    }
    const double due = jobs_.front().came + settings_.gathering;
    const bool is_task_waiting = std::any_of(jobs_.begin(), jobs_.end(), [](const Job& job) { return job.task != nullptr; });
    if (is_task_waiting || entries_waiting() >= settings_.most_entries || clock_.now() >= due) break;
    clock_.wait(wake_, lock, due);
  }
  std::vector<Job> batch;
  std::size_t entries = 0;
  while (!jobs_.empty()) {
    const Job& job = jobs_.front();
    entries += job.record.entries.size();
    if (!batch.empty() && (job.task || entries > settings_.most_entries)) break;
    batch.push_back(std::move(jobs_.front()));
    jobs_.pop_front();
    if (batch.back().task) break;
  }
  return batch;
}

Result<void> Writer::carry_out(std::vector<Job>& batch) {
  if (batch.front().task) return batch.front().task(*journal_);
  std::vector<room::Record> records;
  records.reserve(batch.size());
  for (Job& job : batch) records.push_back(std::move(job.record));
  const double began = clock_.now();
  auto done = journal_->commit(records);
  const double took = clock_.now() - began;
  const std::lock_guard lock(mutex_);
  if (done) times_[times_count_++ % times_.size()] = took;
  return done;
}

void Writer::tidy(bool is_anybody_waiting) {
  const std::int64_t bytes = journal_->unfinished_bytes();
  // A failure takes nothing away from what is stored; it is tried again after the next commit.
  if (bytes >= (is_anybody_waiting ? settings_.tidy_at_once_from : settings_.tidy_from)) (void)journal_->checkpoint();
}

void Writer::work() {
  std::unique_lock lock(mutex_);
  while (true) {
    while (jobs_.empty() && !is_ending_) wake_.wait(lock);
    if (jobs_.empty()) break;
    std::vector<Job> batch = next_batch(lock);
    if (batch.empty()) continue;
    Result<void> done = problem_;
    const bool is_tried = static_cast<bool>(done);
    lock.unlock();
    if (is_tried) done = carry_out(batch);
    lock.lock();
    // Before anybody hears of it, so that what is submitted then fails as well.
    if (is_tried && !done) problem_ = done;
    lock.unlock();
    for (const Job& job : batch)
      if (job.done) job.done(done);
    lock.lock();
    const bool is_anybody_waiting = !jobs_.empty();
    lock.unlock();
    if (done) tidy(is_anybody_waiting);
    lock.lock();
  }
  lock.unlock();
  (void)journal_->close();
}

}  // namespace bl::journal
