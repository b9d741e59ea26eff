// Capacity change: each target by hand, and a bridge with another lane.
#include "tests/links/link_case.h"

namespace bl {
namespace {

std::string proposed_ports(const std::string& target, double value) {
  LinkCase link("capacity_change");
  link.set("target", target).from("control.output", value);
  if (const std::string error = link.run(); !error.empty()) return error;
  std::string ports;
  for (const char* port : {"street.lanes", "street.speed", "street.open"})
    if (link.proposed(End::to, port))
      ports += std::string(port) + "=" + std::to_string(static_cast<int>(link.number(End::to, port)));
  return ports;
}

TEST(CapacityChange, OneTargetOnly) {
  EXPECT_EQ(proposed_ports("lanes", 3), "street.lanes=3");
  EXPECT_EQ(proposed_ports("speed", 8), "street.speed=8");
  EXPECT_EQ(proposed_ports("open", 0), "street.open=0");
  EXPECT_EQ(proposed_ports("speed", 0), "target: a speed has to be above 0; close the street by `open` instead");
}

TEST(CapacityChange, SceneGivesTheBridgeALane) {
  World world = World::from_file("scenes/links/capacity_change.json");
  ASSERT_TRUE(world.settle(100));
  EXPECT_EQ(world.number("bridge", "street.lanes"), 2);
  EXPECT_EQ(world.number("ferry_lane", "street.open"), 0.5);
  const double wide = world.number("left", "traffic_zone.mean_travel_time");
  ASSERT_EQ(world.submit(command<SetPort>({.node = "lanes", .port = {"control.value"}, .value = {"1"}})), "");
  world.tick(5);
  ASSERT_TRUE(world.settle(100));
  EXPECT_GT(world.number("left", "traffic_zone.mean_travel_time"), 1.2 * wide);
  EXPECT_GT(world.number("ferry_lane", "street.flow_forth"), 500);
}

}  // namespace
}  // namespace bl
