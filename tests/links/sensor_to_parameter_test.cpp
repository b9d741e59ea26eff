// Sensor to parameter: good readings move the target; stale ones move nothing, and say so.
#include "core/live/commands.h"
#include "tests/links/link_case.h"

namespace bl {
namespace {

LinkCase from_sensor(double value, bool is_good, double age = 0) {
  LinkCase link("sensor_to_parameter");
  link.from("source", value).from("sensor.age", age).from("sensor.is_good", is_good).from("node.id", std::string("mast"));
  return link.from("sensor.message", std::string(is_good ? "" : "no reading has come yet"));
}

TEST(SensorToParameter, CarriesGoodReadings) {
  auto link = from_sensor(21.5, true);
  ASSERT_EQ(link.run(), "");
  EXPECT_EQ(link.number(End::to, "target"), 21.5);
  ASSERT_EQ(link.set("rescale", true).set("gain", 100.0).set("base", 1000.0).run(), "");
  EXPECT_EQ(link.number(End::to, "target"), 3150);
}

TEST(SensorToParameter, OthersAreErrorsOrTheFallback) {
  EXPECT_EQ(from_sensor(21.5, false).run(),
            "the sensor `mast` has no good reading: no reading has come yet. What was proposed last stays in force");
  EXPECT_EQ(from_sensor(21.5, true, 11).set("max_age", 10.0).run(),
            "the sensor `mast` has no good reading: the last reading is older than 10 s. What was proposed last stays in force");
  auto link = from_sensor(21.5, false);
  ASSERT_EQ(link.set("when_stale", std::string("fallback")).set("fallback", 5.0).run(), "");
  EXPECT_EQ(link.number(End::to, "target"), 5);
}

TEST(SensorToParameter, StaleDataMovesNothingSilently) {
  World world = World::from_text(R"({"format": "behaviourlinks", "version": 1, "nodes": [
    {"id": "mast", "types": {"sensor": {"timeout": 2, "tick_length": 1, "unit": "m3"}}},
    {"id": "house", "types": {"smart_volume": {}}}],
    "links": [{"id": "l", "kind": "sensor_to_parameter", "from": "mast", "to": "house"}]})");
  const double before = world.number("house", "smart_volume.demand");
  world.tick(2);
  EXPECT_EQ(world.number("house", "smart_volume.demand"), before);
  EXPECT_NE(world.link_error("l"), "");
  ASSERT_EQ(world.submit(command<live::Receive>({"mast", 1500, "", "", 3})), "");
  world.tick(2);
  EXPECT_EQ(world.number("house", "smart_volume.demand"), 1500);
  EXPECT_EQ(world.link_error("l"), "");
  world.tick(10);
  EXPECT_EQ(world.number("house", "smart_volume.demand"), 1500) << "the last proposal stays in force";
  EXPECT_EQ(world.link_error("l"),
            "links/l: the sensor `mast` has no good reading: the last reading is older than 2 s. What was proposed last stays in "
            "force");
  EXPECT_FALSE(world.state().is_settled());
}

TEST(SensorToParameter, SceneFollowsTheSensor) {
  World world = World::from_file("scenes/links/sensor_to_parameter.json");
  ASSERT_TRUE(world.settle());
  EXPECT_EQ(world.number("cafe", "smart_volume.demand"), 2400);
  EXPECT_NEAR(world.number("cafe", "smart_volume.volume"), 2400, 24);
}

}  // namespace
}  // namespace bl
