// Journals: none is written over, and none is cleared away unread.
#include <unistd.h>

#include <cstdlib>
#include <filesystem>

#include <gtest/gtest.h>

#include "core/file/file_io.h"
#include "core/host/journal.h"
#include "core/session/commands.h"

namespace bl::host {
namespace {

namespace files = std::filesystem;

// A folder of its own for each test, in place of the person's.
class JournalTest : public ::testing::Test {
 protected:
  JournalTest() {
    state_ = ::testing::TempDir() + "behaviourlinks_journals_" + std::to_string(getpid());
    files::remove_all(state_);
    setenv("XDG_STATE_HOME", state_.c_str(), 1);
    folder_ = person_folder() + "/journals";
    files::create_directories(folder_);
  }
  ~JournalTest() override { files::remove_all(state_); }
  std::string own(int number) const {
    return folder_ + "/" + std::to_string(getpid()) + "-" + std::to_string(number) + ".journal";
  }
  LogEntry entry(std::int64_t seq, std::int64_t tick) const {
    return {.seq = seq, .tick = tick, .gesture = seq, .author = "desk", .command = command<RenameNode>({"a", "Name"})};
  }

  static constexpr const char* kScene = R"({"format": "behaviourlinks", "version": 1, "nodes": [{"id": "a"}]})";
  static constexpr const char* kGone = "/2147483646-1.journal";
  std::string state_, folder_;
};

TEST_F(JournalTest, OneThatBearsOurNumberIsKeptAndFound) {
  const std::string left = log_header(kScene) + log_line(entry(1, 0), full_registry());
  ASSERT_TRUE(write_file(own(1), left).ok());
  Journal journal;
  ASSERT_TRUE(journal.begin("x.json", kScene, 0).ok());
  journal.add(entry(1, 0), full_registry());
  const auto found = Journal::find(full_registry());
  ASSERT_EQ(found.size(), 1u) << "ours is being written, the other was left";
  EXPECT_EQ(found.front().path, own(1));
  EXPECT_EQ(read_file(own(1)).value(), left);
}

TEST_F(JournalTest, OneThatCannotBeReadIsKeptUnderAnotherName) {
  const std::string text = log_header(kScene) + "{\"seq\": 1, \"tick\": 0, \"command\": \"from_the_future\"}\n";
  ASSERT_TRUE(write_file(folder_ + kGone, text).ok());
  std::vector<std::string> unreadable;
  EXPECT_TRUE(Journal::find(full_registry(), &unreadable).empty());
  ASSERT_EQ(unreadable.size(), 1u);
  const std::string aside = folder_ + kGone + ".unreadable";
  EXPECT_NE(unreadable.front().find(aside), std::string::npos) << unreadable.front();
  EXPECT_EQ(read_file(aside).value(), text);
  unreadable.clear();
  (void)Journal::find(full_registry(), &unreadable);
  EXPECT_TRUE(unreadable.empty()) << "it is told once";
}

TEST_F(JournalTest, EmptyOnesAreClearedAway) {
  for (const std::string& text : {std::string(), std::string("{\"format\": \"behaviourl"), log_header(kScene)}) {
    ASSERT_TRUE(write_file(folder_ + kGone, text).ok());
    std::vector<std::string> unreadable;
    EXPECT_TRUE(Journal::find(full_registry(), &unreadable).empty());
    EXPECT_TRUE(unreadable.empty());
    EXPECT_TRUE(files::is_empty(folder_)) << text;
  }
}

TEST_F(JournalTest, OneThatCannotBeFollowedGoesOnInOrder) {
  Journal journal;
  ASSERT_TRUE(journal.begin("", kScene, 0).ok());
  journal.add(entry(1, 9), full_registry());
  setenv("XDG_STATE_HOME", "/dev/null", 1);  // no folder can be made in there
  EXPECT_FALSE(journal.begin("", kScene, 0).ok());
  EXPECT_NE(journal.problem(), "");
  setenv("XDG_STATE_HOME", state_.c_str(), 1);
  journal.add(entry(2, 4), full_registry());
  files::rename(own(1), folder_ + kGone);
  const auto found = Journal::find(full_registry());
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found.front().log.entries.size(), 2u);
}

// Recovery wants what was said, in order; where the ticks went back meanwhile, the rewind itself is nothing to it.
TEST_F(JournalTest, WhatCameAfterARewindIsFoundInOrder) {
  Journal journal;
  ASSERT_TRUE(journal.begin("", kScene, 6).ok());
  journal.add(entry(7, 9), full_registry());
  LogEntry rewind = entry(8, 9);
  rewind.command = {};
  rewind.rewinds_to = 2;
  journal.add(rewind, full_registry());
  journal.add(entry(9, 3), full_registry());
  files::rename(own(1), folder_ + kGone);
  const auto found = Journal::find(full_registry());
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found.front().log.base, 6);
  ASSERT_EQ(found.front().log.entries.size(), 2u);
  EXPECT_EQ(found.front().log.entries.back().seq, 9);
}

}  // namespace
}  // namespace bl::host
