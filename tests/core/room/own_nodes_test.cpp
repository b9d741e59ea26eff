// Devices add, move and remove nodes under a prefix of their own, and no others.
#include <gtest/gtest.h>

#include "tests/core/room/room_world.h"

namespace bl::room {
namespace {

constexpr const char* kHall = R"({"format": "behaviourlinks", "version": 1, "nodes": [
  {"id": "eyes", "types": {"people_sensor": {"most": 2}}}, {"id": "eyes2"}, {"id": "meter", "types": {"sensor": {}}},
  {"id": "north", "types": {"smart_volume": {"demand": 900}}}], "links": []})";

Command add(const std::string& id) { return command<AddNode>({id, {R"({"types": {"smart_volume": {}}})"}}); }
Command move(const std::string& id) { return command<SetPort>({id, {"node.position"}, {"[1, 2, 3]"}}); }

TEST(DeviceSeats, OwnWhatBearsTheirNameOrThatOfTheSensorOnTheirCard) {
  RoomWorld world(kHall);
  (void)world.seat(Role::facilitator);
  const auto device = world.seat(Role::device, {}, "eyes");
  const std::string own = "device_" + std::to_string(device) + "_";
  for (const std::string& id : {std::string("eyes#p1"), own + "a"}) {
    EXPECT_EQ(sentence(world.command(device, add(id))), "");
    EXPECT_EQ(sentence(world.command(device, move(id))), "");
    EXPECT_EQ(sentence(world.command(device, command<Batch>({std::vector{move(id), command<RemoveNode>({id})}}))), "");
    EXPECT_FALSE(world.scene().nodes.contains(id));
  }
  const Scene before = world.scene();
  for (const char* id : {"eyes2", "eyes_p1", "p1", "meter#p1", "device_1_a"}) {
    EXPECT_NE(why(world.command(device, add(id))), "") << id;
    EXPECT_NE(why(world.command(device, move(id))), "") << id;
    EXPECT_NE(why(world.command(device, command<RemoveNode>({id}))), "") << id;
  }
  EXPECT_EQ(why(world.command(device, move("north"))), "right");
  EXPECT_TRUE(world.scene() == before);
}

TEST(DeviceSeats, HaveAsManyNodesAsTheirSensorAllows) {
  RoomWorld world(kHall);
  (void)world.seat(Role::facilitator);
  const auto device = world.seat(Role::device, {}, "eyes"), other = world.seat(Role::device, {}, "meter");
  EXPECT_EQ(sentence(world.command(device, add("eyes#p1"))), "");
  EXPECT_EQ(sentence(world.command(device, add("eyes#p2"))), "");
  EXPECT_EQ(why(world.command(device, add("eyes#p3"))), "right");
  EXPECT_EQ(sentence(world.command(device, move("eyes#p2"))), "");
  EXPECT_EQ(sentence(world.command(device, command<RemoveNode>({"eyes#p1"}))), "");
  EXPECT_EQ(sentence(world.command(device, add("eyes#p3"))), "");
  EXPECT_EQ(why(world.command(other, move("eyes#p3"))), "right");
  EXPECT_EQ(why(world.command(other, add("meter#p3"))), "right") << "a sensor of numbers has no people";
}

}  // namespace
}  // namespace bl::room
