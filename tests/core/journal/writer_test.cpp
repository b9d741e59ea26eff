// The thread that stores: what it gathers, what it tells and in which order, and how it stops and goes on after a failure.
#include "core/journal/writer.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>

#include "tests/core/journal/room_file.h"
#include "tests/core/journal/torn_disk.h"
#include "tests/support/random_records.h"

namespace bl::journal::test {
namespace {

// A clock that a test moves by hand. Whoever waits looks at it again after a moment of real time.
class HandTime {
 public:
  Writer::Clock clock() {
    return {[this] { return now_.load(); },
            [this](std::condition_variable& wake, std::unique_lock<std::mutex>& lock, double until) {
              if (now_ < until) wake.wait_for(lock, std::chrono::milliseconds(1));
            }};
  }
  void advance(double seconds) { now_ = now_ + seconds; }

 private:
  std::atomic<double> now_ = 100;  // [s]
};

Writer::Clock real_time() {
  return {[] { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); },
          [](std::condition_variable& wake, std::unique_lock<std::mutex>& lock, double until) {
            const double now = std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
            if (until > now) wake.wait_for(lock, std::chrono::duration<double>(until - now));
          }};
}

// What was told, in order; waits for it.
class Answers {
 public:
  Writer::Done next(int number) {
    return [this, number](const Result<void>& done) {
      const std::lock_guard lock(mutex_);
      answers_.emplace_back(number, done ? "" : done.error().message);
      come_.notify_all();
    };
  }
  std::vector<std::pair<int, std::string>> wait_for(std::size_t count) {
    std::unique_lock lock(mutex_);
    come_.wait_for(lock, std::chrono::seconds(60), [&] { return answers_.size() >= count; });
    return answers_;
  }
  std::size_t count() {
    const std::lock_guard lock(mutex_);
    return answers_.size();
  }

 private:
  std::mutex mutex_;
  std::condition_variable come_;
  std::vector<std::pair<int, std::string>> answers_;
};

std::vector<std::pair<int, std::string>> all_well(int count) {
  std::vector<std::pair<int, std::string>> answers;
  for (int k = 0; k < count; ++k) answers.emplace_back(k, "");
  return answers;
}

std::unique_ptr<Journal> on(const std::string& path, const std::string& vfs = "") {
  auto journal = Journal::create(path, a_room(), full_registry(), {.vfs = vfs});
  EXPECT_TRUE(journal) << why(journal);
  return std::move(*journal);
}

TEST(Writer, GathersForTenMilliseconds) {
  const Folder folder;
  HandTime time;
  RandomRecords records(its_scene(), 1);
  Answers answers;
  Writer writer(on(folder.path("a.blsession")), time.clock());
  for (int k = 0; k < 5; ++k) writer.submit(records.next_of(3), answers.next(k));
  std::this_thread::sleep_for(std::chrono::milliseconds(60));
  EXPECT_EQ(answers.count(), 0u);
  EXPECT_EQ(writer.latency().count, 0u);
  time.advance(0.011);
  EXPECT_EQ(answers.wait_for(5), all_well(5));
  EXPECT_EQ(writer.latency().count, 1u);  // one transaction for all of them
}

TEST(Writer, DoesNotWaitForMoreThan64Entries) {
  const Folder folder;
  HandTime time;
  RandomRecords records(its_scene(), 2);
  Answers answers;
  {
    Writer writer(on(folder.path("a.blsession")), time.clock());
    for (int k = 0; k < 9; ++k) writer.submit(records.next_of(8), answers.next(k));
    // Eight of them are 64 entries; the ninth waits for others.
    EXPECT_EQ(answers.wait_for(8), all_well(8));
    std::this_thread::sleep_for(std::chrono::milliseconds(60));
    EXPECT_EQ(answers.count(), 8u);
    EXPECT_EQ(writer.latency().count, 1u);
    writer.submit(records.next_of(100), answers.next(9));
    EXPECT_EQ(answers.wait_for(10).size(), 10u);
  }
  EXPECT_EQ(answers.wait_for(10), all_well(10));
}

TEST(Writer, StoresWhatWaitsWhenItEnds) {
  const Folder folder;
  const std::string path = folder.path("a.blsession");
  HandTime time;
  RandomRecords records(its_scene(), 3);
  Answers answers;
  {
    Writer writer(on(path), time.clock());
    for (int k = 0; k < 30; ++k) writer.submit(records.next_of(5), answers.next(k));
  }
  EXPECT_EQ(answers.wait_for(30), all_well(30));
  const auto journal = std::move(*Journal::open(path, full_registry(), {}));
  EXPECT_EQ(journal->last_seq(), 150);
}

TEST(Writer, OtherWorkHasItsPlaceAmongTheCommits) {
  const Folder folder;
  HandTime time;
  RandomRecords records(its_scene(), 4);
  Answers answers;
  std::vector<std::int64_t> seen;
  {
    Writer writer(on(folder.path("a.blsession")), time.clock());
    const Writer::Task look = [&seen](Journal& journal) {
      seen.push_back(journal.last_seq());
      return Result<void>();
    };
    writer.submit(records.next_of(2), answers.next(0));
    writer.perform(look, answers.next(1));
    writer.submit(records.next_of(3), answers.next(2));
    writer.perform([](Journal& journal) { return journal.add_snapshot({4, 4, 1, "", "", pack("scene")}); }, answers.next(3));
    writer.perform(look, answers.next(4));
  }
  EXPECT_EQ(answers.wait_for(5), all_well(5));
  EXPECT_EQ(seen, (std::vector<std::int64_t>{2, 5}));
}

// A full disk: all that waits fails with the sentence, and nothing later is written, so that there is no hole.
TEST(Writer, AFailureFailsAllUntilItIsResumed) {
  const Folder folder;
  const std::string path = folder.path("a.blsession");
  TornDisk disk(5);
  HandTime time;
  RandomRecords records(its_scene(), 5);
  Answers answers;
  const std::string full = "the disk is full: free some space. Nothing of this step was stored";
  {
    Writer writer(on(path, disk.name()), time.clock());
    writer.submit(records.next_of(64), answers.next(0));
    ASSERT_EQ(answers.wait_for(1), all_well(1));
    EXPECT_EQ(writer.problem(), "");
    disk.fail_after(0, 1000000, TornDisk::Fault::full);
    RandomRecords lost = records;
    writer.submit(lost.next_of(2), answers.next(1));
    writer.submit(lost.next_of(2), answers.next(2));
    time.advance(0.02);
    ASSERT_EQ(answers.wait_for(3).size(), 3u);
    EXPECT_EQ(writer.problem(), path + ": " + full);
    disk.heal();
    // The disk is well again, but the caller does not know yet what is not there.
    writer.submit(lost.next_of(1), answers.next(3));
    bool is_performed = false;
    writer.perform(
        [&is_performed](Journal&) {
          is_performed = true;
          return Result<void>();
        },
        answers.next(4));
    const auto told = answers.wait_for(5);
    ASSERT_EQ(told.size(), 5u);
    for (int k = 1; k < 5; ++k) EXPECT_EQ(told[static_cast<std::size_t>(k)], std::pair(k, full));
    EXPECT_FALSE(is_performed);
    writer.resume();
    EXPECT_EQ(writer.problem(), "");
    writer.submit(records.next_of(64), answers.next(5));
    EXPECT_EQ(answers.wait_for(6).back(), std::pair(5, std::string()));
  }
  const auto journal = std::move(*Journal::open(path, full_registry(), {.vfs = disk.name()}));
  EXPECT_EQ(journal->last_seq(), 128);
}

TEST(Writer, TidiesTheFileWhileNobodyWaits) {
  const Folder folder;
  const std::string path = folder.path("a.blsession");
  HandTime time;
  RandomRecords records(its_scene(), 6);
  Answers answers;
  Writer::Settings settings;
  settings.tidy_from = 200000;
  Writer writer(on(path), time.clock(), settings);
  std::uintmax_t most = 0;
  int asked = 0;
  const auto wait = [&] { return answers.wait_for(static_cast<std::size_t>(++asked)).back(); };
  for (int k = 0; k < 40; ++k) {
    writer.submit(records.next_of(64), answers.next(k));
    ASSERT_EQ(wait(), std::pair(k, std::string()));
    most = std::max(most, std::filesystem::file_size(path + "-wal"));
    // It tidies after it has answered, unless the next one waits by then.
    std::int64_t unfinished = settings.tidy_from;
    for (int looks = 0; looks < 1000 && unfinished >= settings.tidy_from; ++looks) {
      writer.perform(
          [&unfinished](Journal& journal) {
            unfinished = journal.unfinished_bytes();
            return Result<void>();
          },
          answers.next(k));
      ASSERT_EQ(wait(), std::pair(k, std::string()));
    }
    ASSERT_LT(unfinished, settings.tidy_from);
  }
  EXPECT_LT(most, 500000u);
  EXPECT_GT(std::filesystem::file_size(path), 500000u);
}

// Many threads hand over records, while others look at the times: each is answered once, and all are there.
TEST(Writer, TakesRecordsOfManyThreads) {
  const Folder folder;
  const std::string path = folder.path("a.blsession");
  constexpr int kThreads = 4, kEach = 60;
  std::atomic<int> answered = 0, failed = 0;
  {
    Writer writer(on(path), real_time());
    std::vector<std::thread> threads;
    for (int t = 0; t < kThreads; ++t)
      threads.emplace_back([&writer, &answered, &failed, t] {
        for (int k = 0; k < kEach; ++k) {
          room::Record record;
          record.runs.push_back({"run" + std::to_string(t) + "-" + std::to_string(k), t, k});
          writer.submit(std::move(record), [&answered, &failed](const Result<void>& done) { ++(done ? answered : failed); });
          (void)writer.latency();
          (void)writer.problem();
        }
      });
    for (std::thread& thread : threads) thread.join();
  }
  EXPECT_EQ(answered, kThreads * kEach);
  EXPECT_EQ(failed, 0);
  const auto all = (*Journal::open(path, full_registry(), {}))->load();
  EXPECT_EQ(all->room.stored.runs.size(), static_cast<std::size_t>(kThreads * kEach));
}

TEST(Writer, TellsHowLongCommitsTake) {
  const Folder folder;
  RandomRecords records(its_scene(), 7);
  Answers answers;
  Writer::Settings settings;
  settings.gathering = 0;
  Writer writer(on(folder.path("a.blsession")), real_time(), settings);
  EXPECT_EQ(writer.latency().count, 0u);
  for (int k = 0; k < 130; ++k) {
    writer.submit(records.next_of(1), answers.next(k));
    answers.wait_for(static_cast<std::size_t>(k) + 1);
  }
  const auto latency = writer.latency();
  EXPECT_EQ(latency.count, 100u);
  EXPECT_GT(latency.median, 0);
  EXPECT_GE(latency.p95, latency.median);
  std::printf("a commit of one entry takes %.2f ms, 95 in a hundred no longer than %.2f ms\n", 1e3 * latency.median,
              1e3 * latency.p95);
}

}  // namespace
}  // namespace bl::journal::test
