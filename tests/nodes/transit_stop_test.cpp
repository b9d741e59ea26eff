// The transit stop: service by hand.
#include <gtest/gtest.h>

#include "tests/support/world.h"

namespace bl {
namespace {

TEST(TransitStop, ServiceByHand) {
  World world = World::from_file("scenes/nodes/transit_stop.json");
  EXPECT_TRUE(world.settle(20));
  EXPECT_EQ(world.number("bus", "transit_stop.departures"), 4);
  EXPECT_EQ(world.number("bus", "transit_stop.mean_wait"), 450);
  EXPECT_EQ(world.number("train", "transit_stop.departures"), 2);
}

}  // namespace
}  // namespace bl
