// The broker's node: settings that cannot work are told before anybody connects.
#include <gtest/gtest.h>

#include "tests/nodes/scene_text.h"
#include "tests/support/world.h"

namespace bl {
namespace {

std::string broker_message(const std::string& ports) {
  World world = World::from_text(one_node("mqtt_broker", ports));
  world.tick();
  return world.text("it", "mqtt_broker.message");
}

TEST(MqttBroker, SaysWhatIsWrongWithItsSettings) {
  EXPECT_EQ(broker_message(""), "");
  EXPECT_EQ(broker_message(R"("user": "ada", "password_from": "env:BL_HUB", "is_encrypted": true, "ca_file": "hub.crt")"), "");
  EXPECT_EQ(broker_message(R"("password_from": "env:BL_HUB")"), "there is a password and no user");
  EXPECT_EQ(broker_message(R"("ca_file": "hub.crt")"), "there is a `ca_file`, but the connection is not encrypted");
  EXPECT_EQ(broker_message(R"("user": "ada", "password_from": "swordfish")"),
            "password_from: the password itself does not belong into a scene: write `env:BL_NAME` or `file:NAME.password`");
  EXPECT_NE(broker_message(R"("user": "ada", "password_from": "env:HOME")").find("has to begin with `BL_`"), std::string::npos);
}

TEST(MqttBroker, TheSceneHoldsNoPassword) {
  World world = World::from_file("scenes/nodes/mqtt_broker.json");
  ASSERT_TRUE(world.settle(50));
  EXPECT_EQ(world.text("hub", "mqtt_broker.message"), "");
  EXPECT_EQ(world.number("thermometer", "sensor.value"), 18);
}

}  // namespace
}  // namespace bl
