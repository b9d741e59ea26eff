// Set cap: limits by hand, tightening and loosening, and houses under a cap of floor area.
#include "tests/links/link_case.h"

namespace bl {
namespace {

LinkCase cap(double total, std::vector<Value> demands, std::vector<Value> limits) {
  LinkCase link("set_cap");
  link.set("cap", 8000.0).set("gain", 0.5).from("statistics.sum", total);
  link.read(End::to, "smart_volume.demand", std::move(demands)).read(End::to, "smart_volume.demand_limit", std::move(limits));
  return link;
}

TEST(SetCap, LimitsAllInOneProportion) {
  auto link = cap(10000, {4000.0, 6000.0}, {1e9, 1e9});  // a fifth too much, half of it answered at once: 0.9
  ASSERT_EQ(link.run(), "");
  EXPECT_NEAR(link.number(End::to, "smart_volume.demand_limit", 0), 3600, 1e-9);
  EXPECT_NEAR(link.number(End::to, "smart_volume.demand_limit", 1), 5400, 1e-9);
}

TEST(SetCap, LoosensAndThenBindsNobody) {
  auto link = cap(4000, {4000.0, 6000.0}, {1600.0, 2400.0});  // room for twice as much: 0.4 · 1.5
  ASSERT_EQ(link.run(), "");
  EXPECT_NEAR(link.number(End::to, "smart_volume.demand_limit", 0), 2400, 1e-9);
  EXPECT_NEAR(link.number(End::to, "smart_volume.demand_limit", 1), 3600, 1e-9);
  auto free = cap(6400, {2000.0, 4400.0}, {1e9, 1e9});
  ASSERT_EQ(free.run(), "");
  EXPECT_FALSE(free.proposed(End::to, "smart_volume.demand_limit", 0).has_value());
}

TEST(SetCap, ALimitOfAnotherLinkOnOneVolumeDoesNotHoldBackTheRest) {
  auto link = cap(8000, {4000.0, 6000.0}, {3200.0, 1.0});
  ASSERT_EQ(link.run(), "");
  EXPECT_NEAR(link.number(End::to, "smart_volume.demand_limit", 0), 3200, 1e-9);
  EXPECT_NEAR(link.number(End::to, "smart_volume.demand_limit", 1), 4800, 1e-9);
}

TEST(SetCap, SaysNothingWithoutASumAndSurvivesZeroDemands) {
  auto link = cap(0, {4000.0}, {1e9});
  ASSERT_EQ(link.run(), "");
  EXPECT_FALSE(link.proposed(End::to, "smart_volume.demand_limit").has_value());
  auto zero = cap(1e-9, {0.0, 100.0}, {0.0, 0.0});
  ASSERT_EQ(zero.run(), "");
  EXPECT_EQ(zero.number(End::to, "smart_volume.demand_limit", 0), 0);
  EXPECT_GT(zero.number(End::to, "smart_volume.demand_limit", 1), 0);
}

TEST(SetCap, SceneHoldsTheFloorAreaInProportion) {
  World world = World::from_file("scenes/links/set_cap.json");
  world.tick(200);
  EXPECT_TRUE(world.state().is_settled());
  EXPECT_NEAR(world.number("total", "statistics.sum"), 5000, 25);
  const double share = world.number("house_1", "smart_volume.wanted") / 4000;
  EXPECT_LT(share, 0.8);
  EXPECT_NEAR(world.number("house_4", "smart_volume.wanted") / 8000, share, 1e-9);
}

}  // namespace
}  // namespace bl
