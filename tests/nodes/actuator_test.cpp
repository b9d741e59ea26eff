// The actuator: the message that leaves, in its unit and format, and addresses that cannot be.
#include <gtest/gtest.h>

#include "tests/nodes/scene_text.h"
#include "tests/support/world.h"

namespace bl {
namespace {

std::string message_of(const std::string& ports) {
  World world = World::from_text(one_node("actuator", ports));
  world.tick();
  const std::string error = world.node_error("it", "actuator");
  return error.empty() ? world.text("it", "actuator.message") : error;
}

TEST(Actuator, WritesItsMessage) {
  EXPECT_EQ(message_of(R"("value": 0.1)"), "0.1");
  EXPECT_EQ(message_of(R"("value": 2.5, "unit": "cm", "format": "{value} cm")"), "250 cm");
  EXPECT_EQ(message_of(R"("value": 2.345, "decimals": 2, "format": "{\"a\": {value}, \"b\": {value}}")"),
            "{\"a\": 2.35, \"b\": 2.35}");
}

TEST(Actuator, RefusesWhatCannotBeSent) {
  const std::string place = "nodes/it/actuator/";
  EXPECT_EQ(message_of(R"("format": "on")"), place + "format: has no `{value}` in place of the number: put one in");
  EXPECT_EQ(message_of(R"("address": "http://host/x")"),
            place + "address: messages are sent by `mqtt://` or `osc://` only: write such an address");
  EXPECT_EQ(message_of(R"("address": "mqtt://me:secret@host/x")"),
            place + "address: names and passwords do not belong into an address: they would stand in the scene and in every log");
}

TEST(Actuator, SceneIsWhatItSays) {
  World world = World::from_file("scenes/nodes/actuator.json");
  EXPECT_TRUE(world.settle(20));
  EXPECT_EQ(world.text("blinds", "actuator.message"), "{\"percent\": 35}");
  EXPECT_EQ(world.text("lamp", "actuator.message"), "0.5");
}

}  // namespace
}  // namespace bl
