// The sensor: scale, unit, range, filter, age and quality; readings as commands that nobody else undoes.
#include <cmath>

#include <gtest/gtest.h>

#include "core/live/commands.h"
#include "tests/nodes/scene_text.h"
#include "tests/support/world.h"

namespace bl {
namespace {

Command reading(double value, std::int64_t tick, const std::string& problem = "") {
  return command<live::Receive>({"it", value, "noon", problem, tick});
}

World world(const std::string& ports) { return World::from_text(one_node("sensor", ports)); }

TEST(Sensor, ScalesAndKnowsItsUnit) {
  World w = world(R"("unit": "cm", "scale": 2, "offset": 10)");
  EXPECT_EQ(w.submit(reading(95, 1)), "");
  w.tick();
  EXPECT_EQ(w.number("it", "sensor.value"), 2);  // 200 cm
  EXPECT_EQ(w.text("it", "sensor.quality"), "good");
  World plain = world(R"("unit": "dB")");
  EXPECT_EQ(plain.submit(reading(41.5, 1)), "");
  plain.tick();
  EXPECT_EQ(plain.number("it", "sensor.value"), 41.5);
}

TEST(Sensor, AgesInEveryTickThoughNothingElseChanges) {
  World w = world(R"("timeout": 3, "tick_length": 1, "fallback": 7)");
  w.tick();
  EXPECT_EQ(w.text("it", "sensor.quality"), "never");
  EXPECT_EQ(w.text("it", "sensor.message"), "no reading has come yet");
  EXPECT_EQ(w.number("it", "sensor.value"), 7);
  EXPECT_EQ(w.submit(reading(20, 2)), "");
  for (int age = 0; age <= 5; ++age) {
    w.tick();
    EXPECT_EQ(w.number("it", "sensor.age"), age);
    EXPECT_EQ(w.text("it", "sensor.quality"), age <= 3 ? "good" : "stale");
    EXPECT_EQ(w.number("it", "sensor.value"), 20);
  }
  EXPECT_EQ(w.text("it", "sensor.message"), "the last reading is older than 3 s");
  EXPECT_EQ(w.submit(command<SetPort>({"it", {"sensor.when_stale"}, {"\"fallback\""}})), "");
  w.tick();
  EXPECT_EQ(w.number("it", "sensor.value"), 7);
  EXPECT_EQ(w.submit(reading(21, 9)), "");
  w.tick();
  EXPECT_EQ(w.number("it", "sensor.value"), 21);
}

TEST(Sensor, WhatCannotBeTrueTakesNothingAway) {
  World w = world(R"("has_range": true, "lowest": -10, "highest": 40, "timeout": 0)");
  EXPECT_EQ(w.submit(reading(21, 1)), "");
  w.tick();
  EXPECT_EQ(w.submit(reading(999, 2)), "");
  w.tick();
  EXPECT_EQ(w.text("it", "sensor.quality"), "invalid");
  EXPECT_EQ(w.text("it", "sensor.message"), "the reading 999 lies outside -10 to 40");
  EXPECT_EQ(w.number("it", "sensor.value"), 21);
  EXPECT_EQ(w.submit(reading(0, 3, "`warm` is no number")), "");
  w.tick();
  EXPECT_EQ(w.text("it", "sensor.message"), "`warm` is no number");
  EXPECT_EQ(w.number("it", "sensor.value"), 21);
  EXPECT_EQ(w.submit(reading(22, 4)), "");
  w.tick();
  EXPECT_EQ(w.text("it", "sensor.quality"), "good");
  EXPECT_EQ(w.number("it", "sensor.value"), 22);
  EXPECT_EQ(w.submit(command<live::NoteConnection>({"it", "nobody is there"})), "");
  w.tick();
  EXPECT_EQ(w.text("it", "sensor.quality"), "good");
  EXPECT_EQ(w.text("it", "sensor.message"), "nobody is there");
  EXPECT_EQ(w.submit(command<SetPort>({"it", {"sensor.address"}, {"\"ftp://x\""}})), "");
  w.tick();
  EXPECT_EQ(w.text("it", "sensor.quality"), "invalid");
}

TEST(Sensor, TheFilterLetsAStepThroughAsItsTimeConstantSays) {
  World w = world(R"("smoothing": 10, "tick_length": 1, "timeout": 0)");
  EXPECT_EQ(w.submit(reading(0, 1)), "");
  w.tick();
  EXPECT_EQ(w.submit(reading(100, 2)), "");
  w.tick(10);
  EXPECT_NEAR(w.number("it", "sensor.value"), 100 * (1 - std::exp(-1.0)), 1e-9);
}

TEST(Sensor, ASavedSceneGoesOnWithItsFilter) {
  World w = world(R"("smoothing": 10, "tick_length": 1, "timeout": 0)");
  EXPECT_EQ(w.submit(reading(0, 1)), "");
  w.tick();
  EXPECT_EQ(w.submit(reading(100, 2)), "");
  w.tick(3);
  const SavedState saved = save(w.state());
  World later = World::from_text(write_scene(w.session().scene(), full_registry(), &saved));
  w.tick(5);
  later.tick(5);
  EXPECT_EQ(later.state().hash, w.state().hash);
}

TEST(Sensor, NobodyElseTakesReadingsBack) {
  World w = world(R"("timeout": 0)");
  EXPECT_EQ(w.submit(command<RenameNode>({"it", "Mast"}), "anna"), "");
  EXPECT_EQ(w.submit(reading(5, 1), "mqtt://host:1883/t"), "");
  ASSERT_TRUE(w.session().undo("anna").ok());
  EXPECT_FALSE(w.session().undo("anna").ok());
  w.tick();
  EXPECT_EQ(w.number("it", "sensor.value"), 5);
  EXPECT_EQ(w.session().scene().nodes.at("it").name, "");
}

TEST(Sensor, ReadingsNeedASensor) {
  World w = World::from_text(one_node("control", ""));
  EXPECT_EQ(w.submit(reading(5, 1)), "nodes/it: the node is not a `sensor`; typify it first");
  EXPECT_EQ(world("").submit(reading(5, 1, std::string(600, 'x'))), "nodes/it/sensor/problem: is longer than 500 characters");
}

TEST(Sensor, SceneIsWhatItSays) {
  World w = World::from_file("scenes/nodes/sensor.json");
  EXPECT_TRUE(w.settle(20));
  EXPECT_EQ(w.text("warmth", "sensor.quality"), "good");
  EXPECT_EQ(w.number("warmth", "sensor.value"), 21.5);
  EXPECT_EQ(w.text("gauge", "sensor.quality"), "invalid");
  EXPECT_EQ(w.number("gauge", "sensor.value"), 1.2);
  EXPECT_EQ(w.text("counter", "sensor.quality"), "never");
}

}  // namespace
}  // namespace bl
