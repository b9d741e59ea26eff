// A thread that stores what a room hands over, several commits at a time.
#pragma once

#include <array>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "core/journal/journal.h"

namespace bl::journal {

class Writer {
 public:
  /// The clock of the host. It decides when a transaction begins, and nothing of what is in it.
  struct Clock {
    std::function<double()> now;  ///< seconds since a fixed moment
    /// Waits until this time, or until it is woken; it may also wake early.
    std::function<void(std::condition_variable& wake, std::unique_lock<std::mutex>& lock, double until)> wait;
  };
  struct Settings {
    double gathering = 0.010;                   ///< how long the first of a transaction waits for others [s]
    std::size_t most_entries = 64;              ///< of a transaction; one record with more is not divided
    std::int64_t tidy_from = 4 << 20;           ///< the file is tidied from so many unfinished bytes on, while nobody waits,
    std::int64_t tidy_at_once_from = 64 << 20;  ///< or although somebody does
  };
  /// Called on the writer's thread, in the order of the submissions.
  using Done = std::function<void(const Result<void>&)>;
  using Task = std::function<Result<void>(Journal&)>;

  explicit Writer(std::unique_ptr<Journal> journal, Clock clock) : Writer(std::move(journal), std::move(clock), Settings()) {}
  Writer(std::unique_ptr<Journal> journal, Clock clock, Settings settings);
  /// Stores what waits, then closes the file.
  ~Writer();
  Writer(const Writer&) = delete;
  Writer& operator=(const Writer&) = delete;

  /// `done` is told once the record is on the disk, or why it is not. A failure also fails all that wait, and whatever comes
  /// later, until `resume`: nobody shall find a hole in what is stored.
  void submit(room::Record record, Done done);
  /// Other work with the file, in its place among the commits: a snapshot, hashes, an erasure.
  void perform(Task task, Done done);
  /// Later work is tried again. Whoever calls it then goes back to what is stored (`perform` can read it), and only then submits
  /// more.
  void resume();
  /// Why nothing is written at the moment; empty where all is well.
  std::string problem() const;

  /// How long the last hundred transactions took [s]: of half of them no longer than `median`, of 95 in a hundred no longer than
  /// `p95`.
  struct Latency {
    double median = 0, p95 = 0;
    std::size_t count = 0;
  };
  Latency latency() const;

 private:
  struct Job {
    room::Record record;
    Task task;
    Done done;
    double came = 0;  ///< [s]
  };
  void add(Job job);
  void work();
  std::vector<Job> next_batch(std::unique_lock<std::mutex>& lock);
  std::size_t entries_waiting() const;
  Result<void> carry_out(std::vector<Job>& batch);
  void tidy(bool is_anybody_waiting);

  std::unique_ptr<Journal> journal_;  // of the thread alone
  Clock clock_;
  Settings settings_;
  mutable std::mutex mutex_;
  std::condition_variable wake_;
  std::deque<Job> jobs_;
  bool is_ending_ = false;
  Result<void> problem_;
  std::array<double, 100> times_{};  // of the last transactions, in a ring [s]
  std::size_t times_count_ = 0;
  std::thread thread_;  // last: it uses all of the above
};

}  // namespace bl::journal
