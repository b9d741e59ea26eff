// Laws of a drag: what is seen in every frame is said ten times a second, is one step to undo, and replays to the same hash.
#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/base/text.h"
#include "core/session/open_gestures.h"
#include "tests/support/world.h"

namespace bl {
namespace {

constexpr int kVolumes = 5, kFrames = 600;
constexpr double kFrame = 1.0 / 60;  // [s]

std::string volumes() {
  std::string scene = R"({"format": "behaviourlinks", "version": 1, "nodes": [)";
  for (int i = 0; i < kVolumes; ++i)
    scene += std::string(i > 0 ? ", " : "") + R"({"id": "v)" + std::to_string(i) + R"(", "position": [)" + std::to_string(i) +
             R"(, 0, 0], "types": {"smart_volume": {"demand": 100}}})";
  return scene + R"(], "links": [{"id": "l", "kind": "keep_distance", "from": "v0", "to": "v1"}]})";
}

Command moved(int frame) {
  std::vector<Command> commands;
  for (int i = 0; i < kVolumes; ++i)
    commands.push_back(command<SetPort>(
        {"v" + std::to_string(i), {"node.position"}, {"[" + std::to_string(i) + ", " + shortest(0.25 * frame) + ", 0]"}}));
  return command<Batch>({std::move(commands)});
}

double shown_y(const Scene& scene, const std::string& node) {
  return std::get<Vector3>(scene.nodes.at(node).types.at("node").at("position")).y;
}

class Drag : public testing::Test {
 protected:
  // Sixty frames and twenty ticks a second.
  void run() {
    gesture_ = world_.session().new_gesture();
    for (int frame = 1; frame <= kFrames; ++frame) {
      const auto done =
          gestures_.show({.command = moved(frame), .author = "anna", .gesture = gesture_}, world_.state().tick, frame * kFrame);
      ASSERT_TRUE(done.ok()) << done.error().text();
      ASSERT_EQ(shown_y(gestures_.shown(), "v3"), 0.25 * frame) << "each frame is seen";
      said_at_.resize(world_.session().log().size(), frame * kFrame);
      if (frame % 3 == 0) world_.tick();
    }
  }

  World world_ = World::from_text(volumes());
  OpenGestures gestures_{world_.session().ledger()};
  std::int64_t gesture_ = 0;
  std::vector<double> said_at_;  // by entry [s]
};

TEST_F(Drag, SaysOneEntryForEachPortAndTenthOfASecondAtMost) {
  run();
  for (std::size_t i = 1; i < said_at_.size(); ++i) EXPECT_GE(said_at_[i] - said_at_[i - 1], 0.1 - 1e-9) << i;
  EXPECT_LE(said_at_.size(), 101u);
  ASSERT_TRUE(gestures_.end(gesture_, world_.state().tick).ok());
  EXPECT_LE(world_.session().log().size(), 102u);
  EXPECT_EQ(shown_y(world_.session().scene(), "v4"), 0.25 * kFrames) << "the last value is always said";
  EXPECT_EQ(&gestures_.shown(), &world_.session().scene());
}

TEST_F(Drag, IsOneStepThatCostsWhatItTouched) {
  const Scene before = world_.session().scene();
  run();
  ASSERT_TRUE(gestures_.end(gesture_, world_.state().tick).ok());
  const Scene after = world_.session().scene();
  const std::size_t entries = world_.session().log().size();
  ASSERT_TRUE(world_.session().undo("anna").ok());
  EXPECT_TRUE(world_.session().scene() == before);
  EXPECT_LE(world_.session().log().size() - entries, static_cast<std::size_t>(kVolumes));
  EXPECT_FALSE(world_.session().undo("anna").ok()) << "there was one step";
  ASSERT_TRUE(world_.session().redo("anna").ok());
  EXPECT_TRUE(world_.session().scene() == after);
}

TEST_F(Drag, ReplaysToTheSameHash) {
  std::string log = log_header(volumes());
  world_.session().subscribe([&](const LogEntry& entry) { log += log_line(entry, full_registry()); });
  run();
  ASSERT_TRUE(gestures_.end(gesture_, world_.state().tick).ok());
  world_.tick(3);
  ASSERT_TRUE(world_.session().undo("anna").ok());
  world_.tick(3);
  log += log_line(LogCheck{world_.state().tick, hex_digits(world_.state().hash), true});
  const auto read = read_log(log, full_registry());
  ASSERT_TRUE(read.ok()) << read.error().text();
  const auto report = replay(*read, full_registry(), 1);
  ASSERT_TRUE(report.ok()) << report.error().text();
  EXPECT_EQ(report->checks, 1u);
  EXPECT_FALSE(report->first_mismatch.has_value());
}

// A first frame that changes nothing, or only something, leaves no more to undo.
TEST_F(Drag, OfWhichTheFirstFrameMovesOnlyOneIsUndoneInOneEntryForEachPlace) {
  const std::int64_t gesture = world_.session().new_gesture();
  const Command first = command<SetPort>({"v2", {"node.position"}, {"[2, 9, 0]"}});
  ASSERT_TRUE(world_.session().submit(command<Batch>({std::vector{first, moved(0)}}), "anna", gesture).ok());
  ASSERT_TRUE(world_.session().submit(command<Batch>({std::vector{moved(0), first}}), "anna", gesture).ok());
  for (int frame = 1; frame < 5; ++frame) ASSERT_TRUE(world_.session().submit(moved(frame), "anna", gesture).ok());
  const std::size_t entries = world_.session().log().size();
  ASSERT_TRUE(world_.session().undo("anna").ok());
  EXPECT_LE(world_.session().log().size() - entries, static_cast<std::size_t>(kVolumes));
  EXPECT_TRUE(world_.session().scene() == World::from_text(volumes()).session().scene());
}

}  // namespace
}  // namespace bl
