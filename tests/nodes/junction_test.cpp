// The junction: its delay sends trips another way.
#include <gtest/gtest.h>

#include "tests/support/world.h"

namespace bl {
namespace {

TEST(Junction, ASignalMakesAnotherWayWorthIt) {
  World world = World::from_file("scenes/nodes/junction.json");
  ASSERT_TRUE(world.settle(100));
  // Both ways are used, and take equally long with the signal's 5 s.
  const double market = world.number("high_street_1", "street.time_forth") + world.number("high_street_2", "street.time_forth");
  const double mill = world.number("mill_lane_1", "street.time_forth") + world.number("mill_lane_2", "street.time_forth");
  EXPECT_NEAR(market, mill, 1e-3);
  EXPECT_GT(world.number("mill_lane_1", "street.flow_forth"), 100);
  EXPECT_NEAR(world.number("work", "junction.flow"), 900, 1e-6);
  EXPECT_EQ(world.number("home", "junction.streets"), 2);
  EXPECT_NEAR(world.number("market", "junction.volume_over_capacity"),
              world.number("high_street_1", "street.volume_over_capacity"), 1e-12);
  ASSERT_EQ(world.submit(command<SetPort>({.node = "market", .port = {"junction.delay"}, .value = {"300"}})), "");
  world.tick(3);
  EXPECT_EQ(world.number("high_street_1", "street.flow_forth"), 0);
}

}  // namespace
}  // namespace bl
