// Devices speak under their own address; the pace of a run is what its sensors stand for.
#include "core/host/device_door.h"

#include <gtest/gtest.h>

#include "tests/core/live/live_support.h"
#include "tests/support/hand_clock.h"
#include "tests/support/world.h"

namespace bl::host {
namespace {

Scene scene_of(const std::string& nodes) {
  return read_scene(R"({"format": "behaviourlinks", "version": 1, "nodes": [)" + nodes + R"(], "links": []})", full_registry())
      .scene;
}

TEST(DeviceDoor, ReadingsGoIntoTheLogAsTheDevicesOwn) {
  const test::Folder folder;
  folder.write("t.csv", "time,v\n0,100\n10,101\n");
  const Scene scene = scene_of(test::sensor("s", "replay:t.csv#v", R"(, "tick_length": 10)"));
  EXPECT_TRUE(has_recordings(scene, full_registry()));
  Ledger ledger(full_registry(), scene);
  DeviceDoor door({folder.path(), false, {}});
  EXPECT_TRUE(door.follow(ledger.scene(), ledger.last_seq()));
  EXPECT_FALSE(door.follow(ledger.scene(), ledger.last_seq())) << "nothing has come since";
  const auto submit = [&](Submission said) { return ledger.submit(std::move(said), 0); };
  EXPECT_TRUE(door.bring(0, submit).empty());
  ASSERT_EQ(ledger.log().size(), 1u);
  EXPECT_EQ(ledger.log().front().author.kind, AuthorKind::device);
  EXPECT_EQ(ledger.log().front().source.origin, "connection");
  EXPECT_TRUE(door.follow(ledger.scene(), ledger.last_seq()));
  const auto refused = door.bring(1, [](Submission) -> Result<void> { return Error{ErrorCode::conflict, "", "no"}; });
  ASSERT_EQ(refused.size(), 1u);
  EXPECT_EQ(refused.front().text(), ledger.log().front().author.id + ": no");
}

TEST(DeviceDoor, TheShortestTickOfTheSensorsCounts) {
  EXPECT_EQ(tick_length(scene_of(R"({"id": "a"})"), full_registry()), 0.05);
  const Scene two =
      scene_of(test::sensor("s", "", R"(, "tick_length": 10)") + "," + test::sensor("t", "", R"(, "tick_length": 2)"));
  EXPECT_EQ(tick_length(two, full_registry()), 2);
  EXPECT_FALSE(has_recordings(two, full_registry()));
  EXPECT_EQ(tick_length(scene_of(test::sensor("s", "")), full_registry()), 0.05) << "the default of the sensor";
}

TEST(Pace, ALateTickIsNotMadeUpFor) {
  test::HandClock clock;
  const double begin = clock.now();
  Pace pace(clock);
  const auto never = [] { return false; };
  pace.wait(2, never);
  EXPECT_NEAR(clock.now() - begin, 2, 1e-9);
  clock.advance(7);
  pace.wait(2, never);
  EXPECT_NEAR(clock.now() - begin, 9, 1e-9);
  pace.wait(2, never);
  EXPECT_NEAR(clock.now() - begin, 11, 1e-9);
  pace.wait(50, [] { return true; });
  EXPECT_NEAR(clock.now() - begin, 11, 1e-9) << "somebody has ended it";
}

TEST(Pace, ManyWaitsInOneAreCounted) {
  test::HandClock clock;
  const double begin = clock.now();
  Pace pace(clock);
  const auto never = [] { return false; };
  EXPECT_EQ(pace.wait(2, never, 1000), 1000);
  EXPECT_NEAR(clock.now() - begin, 2000, 1e-6);
  const auto is_over = [&] { return clock.now() >= begin + 2051; };
  EXPECT_EQ(pace.wait(2, is_over, 1'000'000'000'000'000'000), 25);
  EXPECT_EQ(pace.wait(2, never), 1);
  EXPECT_NEAR(clock.now() - begin, 2052, 1e-6) << "the next one is due where it would have been";
}

}  // namespace
}  // namespace bl::host
