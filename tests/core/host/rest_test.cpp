// A session at rest on a clock that is moved by hand: its thread sleeps, the clock counts on, and the log cannot tell the
// difference.
#include <atomic>
#include <chrono>
#include <thread>

#include <gtest/gtest.h>

#include "core/base/text.h"
#include "core/host/host.h"
#include "tests/core/host/replays.h"
#include "tests/support/hand_clock.h"
#include "tests/support/world.h"

namespace bl::host {
namespace {

constexpr std::int64_t kRate = 20;  // [1/s], of a fresh session

class RestTest : public testing::Test {
 protected:
  RestTest() {
    const SceneReading reading = read_scene(project_file("scenes/links/attract.json"), full_registry());
    auto started = Host::start(full_registry(), reading.scene, nullptr, {.author = "anna", .origin = "test", .clock = &clock_});
    host_ = std::move(*started);
    node_ = reading.scene.nodes.begin()->first;
    session().subscribe_moments([this](const auto&) { ++moments_; });
  }
  LiveSession& session() { return host_->session(); }
  // The hand moves the clock, the thread ticks when it gets there; whether it came true within a minute of real time.
  template <class Condition>
  bool until(const Condition& is_so, double step = 1.0 / kRate) {
    const double end = real_clock().now() + 60;
    while (!is_so() && real_clock().now() < end) {
      clock_.advance(step);
      std::this_thread::sleep_for(std::chrono::microseconds(200));
    }
    return is_so();
  }
  bool comes_to_rest() {
    session().let_rest(true);
    session().play(true);
    return until([this] { return session().moment()->is_resting; });
  }
  Result<void> move(double x) {
    return host_->submit({command<SetPort>({node_, {"node.position"}, {"[" + shortest(x) + ", 0, 0]"}})});
  }

  test::HandClock clock_;
  std::atomic<int> moments_ = 0;
  std::unique_ptr<Host> host_;
  std::string node_;
};

TEST_F(RestTest, NothingIsPublishedWhileTheClockCountsOn) {
  ASSERT_TRUE(comes_to_rest());
  const auto moment = session().moment();
  EXPECT_TRUE(moment->state->is_settled());
  EXPECT_TRUE(moment->is_playing);
  const int moments = moments_;
  for (int k = 0; k < 50; ++k) {
    clock_.advance(1);
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  EXPECT_EQ(moments_, moments);
  EXPECT_EQ(session().moment(), moment);
  // Whoever asks for the state that is to come gets the tick at which the clock stands.
  const std::int64_t passed = session().coming_state()->tick - moment->state->tick;
  EXPECT_GE(passed, 50 * kRate - 1) << "but for the rounding of the clock";
  EXPECT_LE(passed, 50 * kRate + 2);
}

TEST_F(RestTest, ACommandWakesItAtTheTickOfTheClockAndTheLogReplays) {
  ASSERT_TRUE(comes_to_rest());
  const std::int64_t rested = session().moment()->state->tick;
  clock_.advance(600);
  ASSERT_TRUE(move(40).ok());
  const std::int64_t said = session().log().back().tick;
  EXPECT_GE(said, rested + 600 * kRate - 1);
  EXPECT_LE(said, rested + 600 * kRate + 2);
  EXPECT_FALSE(session().moment()->is_resting);
  ASSERT_TRUE(until([&] { return session().moment()->ticked->tick > said + 5; }));
  ASSERT_TRUE(until([&] { return session().moment()->is_resting; })) << "it comes to rest again";
  clock_.advance(30);
  session().play(false);
  EXPECT_GE(session().moment()->ticked->tick, said + 30 * kRate - 1) << "a clock that is stopped shows where it stands";
  test::expect_replays(*host_);
}

TEST_F(RestTest, AClockThatStoodHasNotCounted) {
  ASSERT_TRUE(comes_to_rest());
  session().play(false);
  const std::int64_t stopped = session().moment()->ticked->tick;
  clock_.advance(1000);
  session().play(true);
  ASSERT_TRUE(until([&] { return session().moment()->is_resting; }, 0.001));
  EXPECT_LE(session().coming_state()->tick, stopped + 20);
}

TEST_F(RestTest, ARewindReachesWhatWasBeforeTheRest) {
  ASSERT_TRUE(comes_to_rest());
  const std::int64_t rested = session().moment()->state->tick;
  clock_.advance(600);
  session().rewind(5);
  EXPECT_LE(session().moment()->state->tick, rested);
  ASSERT_TRUE(session().log().back().rewinds_to.has_value());
  EXPECT_GE(session().log().back().tick, rested + 600 * kRate - 1);
}

TEST_F(RestTest, WhoeverNeedsEachTickGetsIt) {
  session().play(true);
  ASSERT_TRUE(until([this] { return session().moment()->state->is_settled(); }));
  const std::int64_t settled = session().moment()->state->tick;
  ASSERT_TRUE(until([&] { return session().moment()->state->tick > settled + 60; }));
  EXPECT_FALSE(session().moment()->is_resting);
  session().let_rest(true);
  ASSERT_TRUE(until([this] { return session().moment()->is_resting; }));
  session().let_rest(false);
  const std::int64_t awake = session().moment()->state->tick;
  EXPECT_TRUE(until([&] { return session().moment()->state->tick > awake + 3; }));
  EXPECT_FALSE(session().moment()->is_resting);
}

TEST_F(RestTest, AnEditThatChangesNothingThatTicksReadLetsItRestOn) {
  ASSERT_TRUE(comes_to_rest());
  ASSERT_TRUE(host_->submit({command<SetView>({{R"({"canvas": {}})"}, false})}).ok());
  EXPECT_TRUE(until([this] { return session().moment()->is_resting; }));
}

}  // namespace
}  // namespace bl::host
