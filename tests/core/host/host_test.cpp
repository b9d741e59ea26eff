// The host on a clock that is moved by hand: what a drag shows and says, what comes of a rewind, and who hears of what.
#include "core/host/host.h"

#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <mutex>
#include <vector>

#include <gtest/gtest.h>

#include "core/base/text.h"
#include "core/file/file_io.h"
#include "core/session/session.h"
#include "tests/core/host/replays.h"
#include "tests/support/hand_clock.h"
#include "tests/support/world.h"

namespace bl::host {
namespace {

constexpr const char* kPair = R"({"format": "behaviourlinks", "version": 1, "nodes": [
  {"id": "a", "position": [0, 0, 0], "types": {"smart_volume": {}}}, {"id": "b", "position": [9, 0, 0], "types": {"smart_volume": {}}}],
  "links": [{"id": "l", "kind": "attract", "from": "a", "to": "b"}]})";

class HostTest : public testing::Test {
 protected:
  HostTest() {
    auto started = Host::start(full_registry(), read_scene(kPair, full_registry()).scene, nullptr,
                               {.author = "anna", .origin = "test", .clock = &clock_});
    host_ = std::move(*started);
  }
  LiveSession& session() { return host_->session(); }
  std::string show(double x, std::int64_t gesture) {
    const auto done = host_->show({command<SetPort>({"b", {"node.position"}, {"[" + shortest(x) + ", 0, 0]"}})}, gesture);
    return done ? "" : done.error().text();
  }
  Vector3 shown_place() { return std::get<Vector3>(value_in(*session().moment()->state, "b", "node.position")); }
  void tick(int count) {
    session().step(count);
    session().settle();
  }
  void expect_replays() { test::expect_replays(*host_); }

  test::HandClock clock_;
  std::unique_ptr<Host> host_;
};

TEST_F(HostTest, ADragIsShownInEachFrameWhileTheClockStands) {
  const std::int64_t drag = session().new_gesture();
  for (int frame = 1; frame <= 60; ++frame) {
    ASSERT_EQ(show(frame, drag), "");
    session().settle();
    ASSERT_EQ(shown_place().x, frame);
    ASSERT_EQ(session().moment()->ticked->tick, 0);
    clock_.advance(1.0 / 60);
  }
  EXPECT_LE(session().log().size(), 10u);
  ASSERT_TRUE(session().end_gesture(drag).ok());
  EXPECT_LE(session().log().size(), 11u);
  EXPECT_EQ(host_->history().size(), 1u);
  EXPECT_EQ(session().log().back().source.origin, "test");
  tick(2);
  expect_replays();
  ASSERT_TRUE(session().undo().ok());
  EXPECT_TRUE(session().said() == read_scene(kPair, full_registry()).scene);
}

TEST_F(HostTest, ADragIsShownBetweenTicksThatKnowNothingOfIt) {
  const std::int64_t drag = session().new_gesture();
  ASSERT_EQ(show(20, drag), "");
  tick(1);
  ASSERT_EQ(show(30, drag), "") << "within the same tenth of a second";
  tick(1);
  EXPECT_EQ(shown_place().x, 30);
  EXPECT_LT(std::get<Vector3>(value_in(*session().moment()->ticked, "b", "node.position")).x, 21);
  EXPECT_EQ(session().log().size(), 1u);
  clock_.advance(0.2);
  ASSERT_TRUE(session().keep_up().ok());
  EXPECT_EQ(session().log().size(), 2u) << "a hand that rests is heard as well";
  tick(1);
  ASSERT_TRUE(session().end_gesture(drag).ok());
  EXPECT_EQ(session().log().size(), 2u);
  expect_replays();
}

TEST_F(HostTest, AnythingElseOfTheHolderComesAfterWhatTheDragShows) {
  const std::int64_t drag = session().new_gesture();
  ASSERT_EQ(show(20, drag), "");
  ASSERT_EQ(show(30, drag), "");
  ASSERT_TRUE(host_->submit({command<RenameNode>({"a", "A"})}, 0, "Call it A").ok());
  EXPECT_EQ(session().log().size(), 3u);
  ASSERT_EQ(host_->history().size(), 2u);
  EXPECT_EQ(host_->history().back().label, "Call it A");
  ASSERT_TRUE(session().undo().ok());
  ASSERT_TRUE(session().undo().ok());
  EXPECT_TRUE(session().scene() == read_scene(kPair, full_registry()).scene);
}

TEST_F(HostTest, AnAbandonedDragLeavesNoStep) {
  const Scene before = session().scene();
  const std::int64_t drag = session().new_gesture();
  for (int frame = 1; frame < 30; ++frame) {
    ASSERT_EQ(show(frame, drag), "");
    clock_.advance(1.0 / 60);
  }
  tick(1);
  session().abandon(drag);
  EXPECT_TRUE(session().scene() == before);
  EXPECT_TRUE(host_->history().empty());
  EXPECT_FALSE(session().can_redo());
  tick(1);
  expect_replays();
  session().abandon(session().new_gesture());
  EXPECT_TRUE(session().scene() == before) << "there was nothing";
}

TEST_F(HostTest, ARewindIsAnEntryOfTheSameLog) {
  tick(6);
  ASSERT_TRUE(host_->submit({command<SetPort>({"b", {"node.position"}, {"[20, 0, 0]"}})}).ok());
  tick(3);
  session().rewind(5);
  EXPECT_EQ(session().moment()->state->tick, 4);
  ASSERT_EQ(session().log().size(), 2u);
  EXPECT_EQ(session().log().back().rewinds_to, 4);
  EXPECT_EQ(session().log().back().tick, 9);
  EXPECT_EQ(host_->history().size(), 1u);
  expect_replays();
  tick(4);
  ASSERT_TRUE(host_->submit({command<RemoveLink>({"l"})}).ok());
  session().rewind(2);
  tick(3);
  expect_replays();
  ASSERT_TRUE(session().undo().ok());
  ASSERT_TRUE(session().undo().ok());
  EXPECT_TRUE(session().said() == read_scene(kPair, full_registry()).scene);
  session().rewind(1000);
  EXPECT_EQ(session().moment()->state->tick, 0);
  session().rewind(1);
  EXPECT_EQ(session().log().back().rewinds_to, 0) << "there is nothing before it";
  expect_replays();
}

TEST_F(HostTest, TicksComeWithTheClock) {
  const auto wait_for = [&](std::int64_t tick) {
    for (int k = 0; k < 60000 && session().moment()->ticked->tick < tick; ++k)
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    return session().moment()->ticked->tick;
  };
  const std::int64_t begin = session().moment()->ticked->tick;
  session().set_rate(10);
  session().play(true);
  // The first tick comes at once. Only once it is there does the clock move on: else the second could follow unseen.
  EXPECT_EQ(wait_for(begin + 1), begin + 1);
  clock_.advance(0.11);
  EXPECT_EQ(wait_for(begin + 2), begin + 2);
  clock_.advance(0.11);
  EXPECT_EQ(wait_for(begin + 3), begin + 3);
  // A clock that is set to go faster does not wait as long as it was to wait before.
  session().set_rate(1000);
  clock_.advance(0.0015);
  EXPECT_EQ(wait_for(begin + 4), begin + 4);
  session().play(false);
}

TEST_F(HostTest, SubscribersHearOfEntriesAndOfMoments) {
  std::mutex mutex;
  std::vector<std::int64_t> ticks, entries;
  const std::size_t moments = session().subscribe_moments([&](const std::shared_ptr<const Moment>& moment) {
    const std::lock_guard lock(mutex);
    ticks.push_back(moment->ticked->tick);
  });
  session().subscribe([&](const LogEntry& entry) { entries.push_back(entry.seq); });
  tick(3);
  ASSERT_TRUE(session().submit({.command = command<RenameNode>({"a", "A"}), .author = "ben", .source = {"page", 1}}).ok());
  EXPECT_FALSE(session().submit({.command = command<RenameNode>({"a", "A"}), .author = "ben", .source = {"page", 1}}).ok());
  session().unsubscribe_moments(moments);
  tick(1);
  const std::lock_guard lock(mutex);
  EXPECT_TRUE(std::is_sorted(ticks.begin(), ticks.end()));
  EXPECT_EQ(ticks.back(), 3);
  EXPECT_EQ(entries, (std::vector<std::int64_t>{1}));
  EXPECT_TRUE(host_->history().empty()) << "what others do is no step of the holder";
}

// A save leaves the running state as it is, and what is saved is what the next tick begins with.
TEST_F(HostTest, WhatIsSavedGoesOnAsTheSessionDoes) {
  tick(4);
  const std::int64_t drag = session().new_gesture();
  ASSERT_EQ(show(30, drag), "");
  ASSERT_EQ(show(40, drag), "");
  const SavedState state = save(*session().coming_state());
  World loaded = World::from_text(write_scene(session().said(), full_registry(), &state));
  EXPECT_EQ(loaded.point("b", "node.position").x, 40);
  tick(3);
  loaded.tick(3);
  EXPECT_EQ(loaded.state().hash, session().moment()->ticked->hash);
  expect_replays();
}

TEST_F(HostTest, AJournalHoldsWhatWasSaidSinceItBegan) {
  const std::string folder = testing::TempDir() + "host_journals_" + std::to_string(getpid());
  std::filesystem::remove_all(folder);
  setenv("XDG_STATE_HOME", folder.c_str(), 1);
  ASSERT_TRUE(host_->submit({command<RenameNode>({"a", "A"})}).ok());
  host_->begin_journal("pair.json", write_scene(session().said(), full_registry()));
  EXPECT_EQ(host_->journal_problem(), "");
  const std::int64_t drag = session().new_gesture();
  for (int frame = 1; frame <= 6; ++frame) ASSERT_EQ(show(frame, drag), "");
  ASSERT_TRUE(session().end_gesture(drag).ok());
  std::string text;
  for (const auto& item : std::filesystem::directory_iterator(person_folder() + "/journals"))
    if (item.path().extension() == ".journal") text = read_file(item.path().string()).value();
  unsetenv("XDG_STATE_HOME");
  std::filesystem::remove_all(folder);
  const auto log = read_log(text, full_registry(), LogUse::recovery);
  ASSERT_TRUE(log.ok()) << log.error().text();
  EXPECT_EQ(log->base, 1);
  ASSERT_EQ(log->entries.size(), 2u) << "six frames within a tenth of a second";
  auto again = Host::start(full_registry(), read_scene(log->scene, full_registry()).scene, nullptr, {.author = "anna"});
  ASSERT_TRUE(again.ok());
  EXPECT_TRUE((*again)->recover(log->entries).empty());
  EXPECT_TRUE((*again)->session().said() == session().said());
}

}  // namespace
}  // namespace bl::host
