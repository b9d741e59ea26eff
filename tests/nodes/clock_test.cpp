// The clock: how it passes, stops, goes on and is set back.
#include <nlohmann/json.hpp>
#include <gtest/gtest.h>

#include "tests/nodes/scene_text.h"
#include "tests/support/world.h"

namespace bl {
namespace {

World clock_world(const std::string& ports, int ticks) {
  World world = World::from_text(one_node("clock", ports));
  world.tick(ticks);
  EXPECT_EQ(world.node_error("it", "clock"), "");
  return world;
}
void set_clock(World& world, const std::string& port, double value) {
  ASSERT_EQ(world.submit(command<SetPort>({"it", {"clock." + port}, JsonValue::of(Json(value))})), "");
}
double time_of(const World& world) { return world.number("it", "clock.time_of_day"); }

TEST(Clock, StartsWhereItIsSetAndPassesByTheStep) {
  World world = clock_world(R"("start": 28800, "step": 60)", 1);
  EXPECT_EQ(time_of(world), 28800);
  world.tick(10);
  EXPECT_EQ(time_of(world), 29400);
  EXPECT_EQ(world.number("it", "clock.passed"), 600);
  EXPECT_EQ(world.number("it", "clock.share"), 29400.0 / 86400);
}

TEST(Clock, PassesMidnight) {
  const World world = clock_world(R"("start": 82800, "step": 1800, "runs_for": 0)", 4);
  EXPECT_EQ(time_of(world), 1800);
  EXPECT_EQ(world.number("it", "clock.day"), 1);
  const World midnight = clock_world(R"("start": 82800, "step": 1800, "runs_for": 0)", 3);
  EXPECT_EQ(time_of(midnight), 0);
  EXPECT_EQ(midnight.number("it", "clock.day"), 1);
}

TEST(Clock, StopsAtItsEndAndRests) {
  World world = clock_world(R"("step": 700, "runs_for": 3600)", 1);
  EXPECT_EQ(world.number("it", "clock.has_ended"), 0);
  world.tick(6);
  EXPECT_FALSE(world.state().due.is_nothing());
  world.tick(30);
  EXPECT_EQ(time_of(world), 21600 + 3600);
  EXPECT_TRUE(world.state().due.is_nothing());
  EXPECT_EQ(world.number("it", "clock.has_ended"), 1);
}

TEST(Clock, IsStoppedAndGoesOnFromThere) {
  World world = clock_world(R"("step": 60, "runs_for": 0)", 11);
  ASSERT_EQ(world.submit(command<SetPort>({"it", {"clock.is_running"}, JsonValue::of(Json(false))})), "");
  world.tick(50);
  EXPECT_EQ(time_of(world), 21600 + 600);
  ASSERT_EQ(world.submit(command<SetPort>({"it", {"clock.is_running"}, JsonValue::of(Json(true))})), "");
  set_clock(world, "step", 30);
  world.tick(2);
  EXPECT_EQ(time_of(world), 21600 + 660) << "at the new pace, from where it was";
}

TEST(Clock, ANewStartSetsItBack) {
  World world = clock_world(R"("step": 60, "runs_for": 0)", 30);
  set_clock(world, "start", 3600);
  world.tick();
  EXPECT_EQ(time_of(world), 3600);
  world.tick();
  EXPECT_EQ(time_of(world), 3660);
}

TEST(Clock, AnEndThatHasPassedStopsItWhereItIs) {
  World world = clock_world(R"("step": 60, "runs_for": 0)", 11);
  set_clock(world, "runs_for", 300);
  world.tick(5);
  EXPECT_EQ(time_of(world), 21600 + 600) << "it does not run backwards";
}

TEST(Clock, SceneIsWhatItSays) {
  World world = World::from_file("scenes/nodes/clock.json");
  world.tick(60);
  EXPECT_TRUE(world.settle());
  EXPECT_EQ(world.number("morning", "clock.time_of_day"), 7 * 3600);
  EXPECT_EQ(world.number("night", "clock.time_of_day"), 3600);
  EXPECT_EQ(world.number("night", "clock.day"), 1);
  EXPECT_EQ(world.number("stopped", "clock.time_of_day"), 12 * 3600);
}

}  // namespace
}  // namespace bl
