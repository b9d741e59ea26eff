// The street: lanes, toll, closing, and the sentence of one that nobody serves.
#include <gtest/gtest.h>

#include "tests/nodes/scene_text.h"
#include "tests/support/world.h"

namespace bl {
namespace {

TEST(Street, WithoutANetworkItSaysSo) {
  World world = World::from_text(one_node("street", ""));
  world.tick();
  EXPECT_EQ(world.text("it", "street.reason"), "no traffic network takes care of it, or its network fails");
}

TEST(Street, FourStreetsInParallel) {
  World world = World::from_file("scenes/nodes/street.json");
  ASSERT_TRUE(world.settle(100));
  EXPECT_EQ(world.text("closed", "street.reason"), "it is closed");
  EXPECT_EQ(world.text("network", "traffic_network.message"), "`closed`: it is closed");
  EXPECT_EQ(world.number("closed", "street.flow_forth"), 0);
  EXPECT_EQ(world.number("narrow", "street.flow_forth"), 0) << "300 m at 8 m/s are never worth it here";
  // 0.05 EUR at 180 s each are 9 s: so much longer takes the wide street.
  EXPECT_NEAR(world.number("wide", "street.time_forth"), world.number("toll_road", "street.time_forth") + 9, 0.01);
  EXPECT_NEAR(world.number("wide", "street.flow_forth") + world.number("toll_road", "street.flow_forth"), 2400, 1e-6);
  EXPECT_EQ(world.number("toll_road", "street.time_back"), 0) << "one way";
  EXPECT_EQ(world.number("wide", "street.used_length"), 320);
  EXPECT_EQ(world.number("narrow", "street.used_length"), 300);
}

TEST(Street, OfNoLanesOrForWalkingIsClosedToCars) {
  World world = World::from_file("scenes/nodes/street.json");
  ASSERT_EQ(world.submit(command<SetPort>({.node = "wide", .port = {"street.lanes"}, .value = {"0"}})), "");
  ASSERT_EQ(world.submit(command<SetPort>({.node = "toll_road", .port = {"street.for_cars"}, .value = {"false"}})), "");
  world.tick(3);
  EXPECT_EQ(world.text("wide", "street.reason"), "it is closed");
  EXPECT_EQ(world.text("toll_road", "street.reason"), "it is for walking only");
  EXPECT_NEAR(world.number("narrow", "street.flow_forth"), 2400, 1e-6);
  EXPECT_NEAR(world.number("narrow", "street.volume_over_capacity"), 8, 1e-9);
}

}  // namespace
}  // namespace bl
