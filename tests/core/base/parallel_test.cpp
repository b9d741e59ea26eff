// The thread pool: every index once, chunk borders that do not depend on the threads, exceptions, and stress.
#include "core/base/parallel.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cstdint>
#include <mutex>
#include <set>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "core/base/hash.h"
#include "tests/support/deadline.h"

namespace bl {
namespace {

constexpr int kThreadCounts[] = {1, 2, 3, 8};

using Chunks = std::set<std::pair<std::size_t, std::size_t>>;

Chunks chunks_of(ThreadPool& pool, std::size_t count, std::size_t grain) {
  Chunks chunks;
  std::mutex mutex;
  pool.for_each_chunk(count, grain, [&](std::size_t begin, std::size_t end) {
    const std::lock_guard lock(mutex);
    chunks.emplace(begin, end);
  });
  return chunks;
}

TEST(Parallel, CoversEveryIndexOnce) {
  for (const int threads : kThreadCounts) {
    ThreadPool pool(threads);
    EXPECT_EQ(pool.threads(), threads);
    for (const std::size_t count : {0, 1, 2, 7, 64, 1000})
      for (const std::size_t grain : {0, 1, 3, 64, 5000}) {
        std::vector<std::atomic<int>> visits(count);
        pool.for_each_chunk(count, grain, [&](std::size_t begin, std::size_t end) {
          EXPECT_LT(begin, end);
          EXPECT_LE(end, count);
          for (std::size_t i = begin; i < end; ++i) ++visits[i];
        });
        for (std::size_t i = 0; i < count; ++i) ASSERT_EQ(visits[i], 1) << i << " of " << count << " by " << grain;
      }
  }
}

TEST(Parallel, ChunksDependOnCountAndGrainOnly) {
  ThreadPool one(1);
  EXPECT_EQ(chunks_of(one, 10, 4), (Chunks{{0, 4}, {4, 8}, {8, 10}}));
  for (const int threads : kThreadCounts) {
    ThreadPool pool(threads);
    EXPECT_EQ(chunks_of(pool, 1000, 7), chunks_of(one, 1000, 7));
    EXPECT_EQ(chunks_of(pool, 3, 7), chunks_of(one, 3, 7));
  }
}

TEST(Parallel, SumsOfChunksAgreeForEveryNumberOfThreads) {
  // The usual way to reduce: one slot for each chunk, added up in order. The sum of doubles is then the same to the bit.
  const auto sum = [](int threads) {
    ThreadPool pool(threads);
    std::vector<double> slots(100);
    pool.for_each_chunk(1000, 10, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) slots[begin / 10] += 1.0 / static_cast<double>(1 + Hash::mix(i) % 1000);
    });
    double total = 0;
    for (const double slot : slots) total += slot;
    return total;
  };
  for (const int threads : kThreadCounts) EXPECT_EQ(sum(threads), sum(1));
}

TEST(Parallel, ThreadsBelowOneAreOne) {
  EXPECT_EQ(ThreadPool(0).threads(), 1);
  EXPECT_EQ(ThreadPool(-5).threads(), 1);
  EXPECT_EQ(ThreadPool().threads(), 1);
}

TEST(Parallel, OneThreadIsTheCaller) {
  ThreadPool pool(1);
  pool.for_each_chunk(
      10, 1, [caller = std::this_thread::get_id()](std::size_t, std::size_t) { EXPECT_EQ(std::this_thread::get_id(), caller); });
}

TEST(Parallel, NoMoreThreadsThanAskedFor) {
  for (const int threads : kThreadCounts) {
    ThreadPool pool(threads);
    std::set<std::thread::id> seen;
    std::mutex mutex;
    for (int round = 0; round < 50; ++round)
      pool.for_each_chunk(100, 1, [&](std::size_t, std::size_t) {
        const std::lock_guard lock(mutex);
        seen.insert(std::this_thread::get_id());
      });
    EXPECT_LE(seen.size(), static_cast<std::size_t>(threads));
  }
}

TEST(Parallel, ThrowsTheExceptionOfABodyAgain) {
  for (const int threads : kThreadCounts) {
    ThreadPool pool(threads);
    for (const std::size_t bad : {0, 50, 99}) {
      std::string message;
      try {
        pool.for_each_chunk(100, 1, [&](std::size_t begin, std::size_t) {
          if (begin == bad) throw std::runtime_error("chunk " + std::to_string(begin));
        });
      } catch (const std::runtime_error& error) { message = error.what(); }
      EXPECT_EQ(message, "chunk " + std::to_string(bad)) << threads << " threads";
    }
    // The pool is as good as before.
    EXPECT_EQ(chunks_of(pool, 100, 9).size(), 12u);
  }
}

TEST(Parallel, OneExceptionIsEnoughWhenAllChunksThrow) {
  for (const int threads : kThreadCounts) {
    ThreadPool pool(threads);
    EXPECT_THROW(pool.for_each_chunk(50, 1, [](std::size_t, std::size_t) { throw std::logic_error("each"); }), std::logic_error);
    EXPECT_NO_THROW(pool.for_each_chunk(50, 1, [](std::size_t, std::size_t) {}));
  }
}

TEST(Parallel, ManyShortLoops) {
  for (const int threads : kThreadCounts) {
    ThreadPool pool(threads);
    std::vector<std::uint64_t> values(64, 0);
    for (int round = 0; round < 3000; ++round)
      pool.for_each_chunk(values.size(), 1 + static_cast<std::size_t>(round) % 9, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) ++values[i];
      });
    for (const std::uint64_t value : values) ASSERT_EQ(value, 3000u);
  }
}

TEST(Parallel, PoolsCanBeMadeAndDroppedWithoutWork) {
  const Deadline deadline(120, "pools are made and dropped");
  for (int round = 0; round < 200; ++round) {
    std::atomic<int> done = 0;
    {
      ThreadPool idle(1 + round % 8);
      EXPECT_EQ(idle.threads(), 1 + round % 8);
      if (round % 2 == 0) idle.for_each_chunk(3, 1, [&](std::size_t, std::size_t) { ++done; });
    }
    EXPECT_EQ(done, round % 2 == 0 ? 3 : 0);
  }
}

}  // namespace
}  // namespace bl
