// Sensors in a room: connected only where that was asked for, their readings are entries, and a replay needs no device.
#include <chrono>
#include <condition_variable>
#include <deque>
#include <filesystem>
#include <fstream>
#include <mutex>

#include <unistd.h>

#include <gtest/gtest.h>

#include "core/journal/export.h"
#include "core/serve/room_host.h"
#include "tests/support/world.h"

namespace bl::serve {
namespace {

constexpr const char* kGauge = R"({"format": "behaviourlinks", "version": 1, "nodes": [
  {"id": "gauge", "types": {"sensor": {"address": "replay:gauge.csv#level", "tick_length": 1}}}], "links": []})";

class RoomDevices : public ::testing::TestWithParam<bool> {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::temp_directory_path() / ("behaviourlinks_devices_" + std::to_string(::getpid()));
    std::filesystem::create_directories(folder_);
    std::ofstream(folder_ / "scene.json") << kGauge;
    std::ofstream(folder_ / "gauge.csv") << "time,level\n0,1.5\n1,2.5\n2,\n3,3.5\n";
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  void run_for(RoomHost& host, int milliseconds) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::milliseconds(milliseconds);
    while (std::chrono::steady_clock::now() < end) {
      std::deque<std::function<void()>> tasks;
      {
        std::unique_lock lock(mutex_);
        wake_.wait_for(lock, std::chrono::milliseconds(10), [this] { return !tasks_.empty(); });
        tasks = std::exchange(tasks_, {});
      }
      for (auto& task : tasks) task();
      host.turn();
    }
  }

  std::filesystem::path folder_;
  std::mutex mutex_;
  std::condition_variable wake_;
  std::deque<std::function<void()>> tasks_;
  std::int64_t at_ = 1000;
};

TEST_P(RoomDevices, SpeakOnlyWhereTheyWereConnected) {
  const bool is_live = GetParam();
  RoomHostOptions options;
  options.wall_time = [this] { return at_ += 10; };
  options.on_own_thread = [this](std::function<void()> task) {
    const std::lock_guard lock(mutex_);
    tasks_.push_back(std::move(task));
    wake_.notify_all();
  };
  if (is_live) options.live = live::LiveOptions{folder_.string(), true, {}};
  const std::string path = folder_ / "room.blsession";
  {
    auto host = RoomHost::open(path, "BKRT", folder_ / "scene.json", options);
    ASSERT_TRUE(host.ok()) << host.error().text();
    for (int k = 0; k < 60 && (k < 2 || (is_live && (*host)->health().seq < 3)); ++k) run_for(**host, 1000);
    EXPECT_EQ((*host)->health().seq, is_live ? 3 : 0);
  }
  auto journal = journal::Journal::open_to_read(path, full_registry());
  ASSERT_TRUE(journal.ok()) << journal.error().text();
  const auto loaded = (*journal)->load();
  ASSERT_TRUE(loaded.ok());
  for (const room::EntryRecord& record : loaded->room.stored.entries) {
    EXPECT_EQ(record.entry.author.kind, AuthorKind::device);
    EXPECT_EQ(record.entry.command.id, "receive");
  }
  const auto log = read_log(journal::log_text((*journal)->room(), *loaded, full_registry()), full_registry());
  ASSERT_TRUE(log.ok()) << log.error().text();
  const auto report = replay(*log, full_registry(), 1);
  ASSERT_TRUE(report.ok()) << report.error().text();
  EXPECT_GT(report->checks, 0u);
  EXPECT_FALSE(report->first_mismatch.has_value());
}

INSTANTIATE_TEST_SUITE_P(With, RoomDevices, ::testing::Bool());

}  // namespace
}  // namespace bl::serve
