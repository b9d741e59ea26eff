// The zone: one node in three roles, a walk to the street, and an island.
#include <cmath>

#include <gtest/gtest.h>

#include "tests/nodes/scene_text.h"
#include "tests/support/world.h"

namespace bl {
namespace {

TEST(TrafficZone, WithoutANetworkItSaysSo) {
  World world = World::from_text(one_node("traffic_zone", R"("trips_out": 5)"));
  world.tick();
  EXPECT_EQ(world.text("it", "traffic_zone.reason"), "no traffic network takes care of it, or its network fails");
}

TEST(TrafficZone, AVolumeIsAZoneAndAJunctionAtOnce) {
  World world = World::from_file("scenes/nodes/traffic_zone.json");
  ASSERT_TRUE(world.settle(200));
  EXPECT_NEAR(world.number("house", "smart_volume.volume"), 4000, 40);
  EXPECT_NEAR(world.number("house", "traffic_zone.trips_served"), 120, 1e-6);
  EXPECT_NEAR(world.number("main_1", "street.flow_forth"), 120, 1e-6);
  EXPECT_EQ(world.number("house", "junction.streets"), 1);
  EXPECT_EQ(world.text("house", "traffic_zone.reason"), "");
  EXPECT_EQ(world.text("island", "traffic_zone.reason"), "it has no access: lay a link to a junction, or allow a longer walk to one");
  EXPECT_EQ(world.number("island", "traffic_zone.trips_lost"), 15);
  // From the shops, 250 m by street and a walk of 60 m at 1.34 m/s lead to the school, 500 m to the house.
  const double school = world.number("main_2", "street.time_back") + 60 / 1.34;
  const double house = world.number("main_2", "street.time_back") + world.number("main_1", "street.time_back");
  EXPECT_NEAR(world.number("shops", "traffic_zone.accessibility"), 150 * std::exp(-school / 600) + 10 * std::exp(-house / 600),
              0.1);
}

TEST(TrafficZone, ListsWhatIsInReach) {
  World world = World::from_file("scenes/nodes/traffic_zone.json");
  ASSERT_EQ(world.submit(command<SetPort>({.node = "school", .port = {"traffic_zone.list_reach"}, .value = {"true"}})), "");
  ASSERT_EQ(world.submit(command<SetPort>({.node = "main_2", .port = {"street.for_cars"}, .value = {"false"}})), "");
  world.tick(3);
  const Table& reach = world.table("school", "traffic_zone.reach");
  ASSERT_EQ(reach.rows.size(), 3u);
  EXPECT_NEAR(reach.number(0, "walking"), 60 / 1.34, 1e-9) << reach.text(0, "junction");
  EXPECT_NEAR(reach.number(1, "walking"), (60 + world.number("main_1", "street.used_length")) / 1.34, 1e-9);
  EXPECT_NEAR(reach.number(1, "driving"), 60 / 1.34 + world.number("main_1", "street.time_back"), 0.01);
  EXPECT_EQ(reach.number(2, "driving"), -1) << "the shops are reached on foot only";
  EXPECT_NEAR(reach.number(2, "walking"), 310 / 1.34, 1e-9);
  EXPECT_TRUE(world.table("shops", "traffic_zone.reach").rows.empty());
}

}  // namespace
}  // namespace bl
