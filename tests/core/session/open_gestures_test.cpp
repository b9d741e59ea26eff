// Gestures under way: what is seen, what is said of it and when, and what others do meanwhile.
#include "core/session/open_gestures.h"

#include <gtest/gtest.h>

#include "tests/support/world.h"

namespace bl {
namespace {

constexpr const char* kTwoVolumes = R"({"format": "behaviourlinks", "version": 1, "nodes": [
  {"id": "a", "types": {"smart_volume": {"demand": 10}}}, {"id": "b", "types": {"smart_volume": {"demand": 20}}}], "links": []})";

Command demand(const char* node, const char* value) { return command<SetPort>({node, {"smart_volume.demand"}, {value}}); }

double demand_in(const Scene& scene, const char* node) {
  return std::get<double>(scene.nodes.at(node).types.at("smart_volume").at("demand"));
}

class OpenGesturesTest : public testing::Test {
 protected:
  std::string show(const Command& command, double now, std::int64_t gesture = 1, const char* author = "anna") {
    const auto done = gestures_.show({.command = command, .author = author, .gesture = gesture}, 0, now);
    return done ? "" : done.error().text();
  }
  std::size_t entries() const { return ledger_.log().size(); }

  Ledger ledger_{full_registry(), read_scene(kTwoVolumes, full_registry()).scene};
  OpenGestures gestures_{ledger_};
};

TEST_F(OpenGesturesTest, TheFirstFrameIsSaidAtOnceAndTheNextWhenTheyAreDue) {
  EXPECT_EQ(show(demand("a", "11"), 5), "");
  EXPECT_EQ(entries(), 1u);
  EXPECT_EQ(show(demand("a", "12"), 5.05), "");
  EXPECT_EQ(entries(), 1u);
  EXPECT_EQ(demand_in(gestures_.shown(), "a"), 12);
  EXPECT_EQ(demand_in(ledger_.scene(), "a"), 11);
  EXPECT_TRUE(gestures_.is_waiting());
  ASSERT_TRUE(gestures_.say_due(0, 5.08).ok());
  EXPECT_EQ(entries(), 1u);
  ASSERT_TRUE(gestures_.say_due(0, 5.11).ok());
  EXPECT_EQ(entries(), 2u);
  EXPECT_EQ(demand_in(ledger_.scene(), "a"), 12);
  EXPECT_FALSE(gestures_.is_waiting());
}

TEST_F(OpenGesturesTest, AHandThatRestsSaysNothing) {
  EXPECT_EQ(show(demand("a", "10"), 0), "");
  EXPECT_EQ(entries(), 0u);
  EXPECT_EQ(show(demand("a", "11"), 1), "");
  for (int k = 2; k < 9; ++k) EXPECT_EQ(show(demand("a", "11"), k), "");
  EXPECT_EQ(entries(), 1u);
}

// Back where it was said last: that is what has to be seen and said.
TEST_F(OpenGesturesTest, WhatReturnsIsNotShownWhereItWasInBetween) {
  EXPECT_EQ(show(demand("a", "11"), 0), "");
  EXPECT_EQ(show(demand("a", "12"), 0.01), "");
  EXPECT_EQ(show(demand("a", "11"), 0.02), "");
  EXPECT_EQ(demand_in(gestures_.shown(), "a"), 11);
  ASSERT_TRUE(gestures_.end(1, 0).ok());
  EXPECT_EQ(demand_in(ledger_.scene(), "a"), 11);
}

TEST_F(OpenGesturesTest, TheLastValueOfEachPlaceIsSaid) {
  EXPECT_EQ(show(demand("a", "11"), 0), "");
  EXPECT_EQ(show(command<Batch>({std::vector{demand("a", "12"), demand("b", "22")}}), 0.01), "");
  EXPECT_EQ(show(demand("a", "13"), 0.02), "");
  ASSERT_TRUE(gestures_.end(1, 0).ok());
  EXPECT_EQ(entries(), 2u);
  EXPECT_EQ(demand_in(ledger_.scene(), "a"), 13);
  EXPECT_EQ(demand_in(ledger_.scene(), "b"), 22);
}

TEST_F(OpenGesturesTest, OthersAreSeenUnderWhatWaits) {
  EXPECT_EQ(show(demand("a", "11"), 0), "");
  EXPECT_EQ(show(demand("a", "12"), 0.01), "");
  ASSERT_TRUE(ledger_.submit(demand("b", "33"), "ben", 0).ok());
  EXPECT_EQ(demand_in(gestures_.shown(), "a"), 12);
  EXPECT_EQ(demand_in(gestures_.shown(), "b"), 33);
  EXPECT_EQ(show(demand("b", "1"), 0.02, 1, "ben"), "gesture: the gesture 1 is somebody else's");
}

TEST_F(OpenGesturesTest, WhatFitsNoMoreIsToldByWhoSaysIt) {
  EXPECT_EQ(show(demand("a", "11"), 0), "");
  EXPECT_EQ(show(demand("a", "12"), 0.01), "");
  ASSERT_TRUE(ledger_.submit(command<RemoveNode>({"a"}), "ben", 0).ok());
  EXPECT_FALSE(gestures_.shown().nodes.contains("a"));
  const auto end = gestures_.end(1, 0);
  ASSERT_FALSE(end.ok());
  EXPECT_EQ(end.error().message, "there is no node `a`, did you mean `b`?");
  EXPECT_FALSE(gestures_.is_open(1));
}

TEST_F(OpenGesturesTest, WhatIsRefusedOrDroppedLeavesNothing) {
  EXPECT_NE(show(demand("a", "-4"), 0), "");
  EXPECT_FALSE(gestures_.is_open(1));
  EXPECT_EQ(show(demand("a", "11"), 0), "");
  EXPECT_NE(show(demand("a", "\"much\""), 0.01), "");
  EXPECT_EQ(show(demand("a", "12"), 0.02), "");
  gestures_.drop(1);
  EXPECT_EQ(demand_in(gestures_.shown(), "a"), 11);
  ASSERT_TRUE(ledger_.undo("anna", 0).ok());
  EXPECT_EQ(demand_in(gestures_.shown(), "a"), 10);
}

}  // namespace
}  // namespace bl
