// Set cap: limits by hand, tightening and loosening, and houses under a cap of floor area.
#include "tests/links/link_case.h"

namespace bl {
namespace {

LinkCase cap(double total, std::vector<Value> demands, std::vector<Value> limits) {
  LinkCase link("set_cap");
  link.set("cap", 8000.0).set("gain", 0.5).set("tolerance", 0.0).set("least", 0.001).from("statistics.sum", total);
  const Value house = std::string("house");
  link.read(End::to, "node.id", std::vector<Value>(demands.size(), house));
  link.read(End::to, "smart_volume.wanted", limits).read(End::to, "smart_volume.fitted", limits);
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

TEST(SetCap, JustBelowTheCapTheLimitRests) {
  for (const double total : {7920.0, 7960.0, 8000.0}) {
    auto link = cap(total, {4000.0, 6000.0}, {3200.0, 4800.0});
    ASSERT_EQ(link.set("tolerance", 0.01).run(), "");
    EXPECT_NEAR(link.number(End::to, "smart_volume.demand_limit", 0), 3200, 1e-9) << total;
    EXPECT_EQ(link.remarked(LinkRemark::at_work), "") << total;
  }
  // From outside the band it aims at 7960, half of the way.
  auto high = cap(8040, {4000.0}, {3200.0});
  ASSERT_EQ(high.set("tolerance", 0.01).run(), "");
  EXPECT_NEAR(high.number(End::to, "smart_volume.demand_limit"), 3200 * (1 + 0.5 * (7960.0 / 8040 - 1)), 1e-9);
  EXPECT_EQ(high.remarked(LinkRemark::at_work), "cap: a sum of 8040 of 8000");
  auto low = cap(7900, {4000.0}, {3200.0});
  ASSERT_EQ(low.set("tolerance", 0.01).run(), "");
  EXPECT_NEAR(low.number(End::to, "smart_volume.demand_limit"), 3200 * (1 + 0.5 * (7960.0 / 7900 - 1)), 1e-9);
}

TEST(SetCap, LeavesTheLeastShareAndSaysWhoHoldsTheCap) {
  auto link = cap(9000, {4000.0, 6000.0}, {1000.0, 1500.0});
  link.read(End::to, "node.id", {std::string("hotel"), std::string("cafe")});
  link.read(End::to, "smart_volume.wanted", {3900.0, 1500.0}).read(End::to, "smart_volume.fitted", {3900.0, 1500.0});
  ASSERT_EQ(link.set("least", 0.25).run(), "");
  EXPECT_NEAR(link.number(End::to, "smart_volume.demand_limit", 1), 1500, 1e-9);
  EXPECT_EQ(
      link.remarked(LinkRemark::unmet),
      "cap: the cap cannot be met: a sum of 9000 of 8000, held by `hotel` (3900 m³ are insisted on); raise the cap, or lower "
      "what is insisted on or `least`");
  link.read(End::to, "smart_volume.fitted", {3900.0, 2500.0});  // has not followed yet
  ASSERT_EQ(link.run(), "");
  EXPECT_EQ(link.remarked(LinkRemark::unmet), "");
  EXPECT_NE(link.remarked(LinkRemark::at_work), "");
}

// One that lies outside of the boundary has nothing, and can give nothing: the others alone decide whether the cap can be met.
TEST(SetCap, WhoHasNothingDoesNotHideThatTheCapCannotBeMet) {
  auto link = cap(9000, {4000.0, 6000.0}, {1000.0, 1500.0});
  link.read(End::to, "smart_volume.wanted", {1000.0, 1500.0}).read(End::to, "smart_volume.fitted", {1000.0, 0.0});
  ASSERT_EQ(link.set("least", 0.25).run(), "");
  EXPECT_NE(link.remarked(LinkRemark::unmet).find("all are down to 25 % of their demands"), std::string::npos)
      << link.remarked(LinkRemark::at_work);
}

// As many digits as tell what is there from what is allowed, and as show the cap as it was typed.
TEST(SetCap, SaysNumbersThatDiffer) {
  const auto said = [](double total, double most) {
    auto link = cap(total, {4000.0}, {3200.0});
    link.set("cap", most);
    EXPECT_EQ(link.run(), "");
    return link.remarked(LinkRemark::at_work);
  };
  EXPECT_EQ(said(10000.04, 10000), "cap: a sum of 10000.04 of 10000.00");
  EXPECT_EQ(said(4.04, 0.4), "cap: a sum of 4.0 of 0.4");
  EXPECT_EQ(said(5, 0), "cap: a sum of 5 of 0");
  EXPECT_EQ(said(9000, 8000), "cap: a sum of 9000 of 8000");
}

// One limit is locked by people: the others come down to the least share, and then it is named.
TEST(SetCap, ALockedLimitDoesNotHoldUpTheOthersAndIsNamed) {
  auto link = cap(9000, {4000.0, 6000.0}, {1e9, 3000.0});
  link.read(End::to, "node.id", {std::string("hotel"), std::string("cafe")}).lock(End::to, "smart_volume.demand_limit", 0);
  link.read(End::to, "smart_volume.wanted", {4000.0, 3000.0}).read(End::to, "smart_volume.fitted", {4000.0, 3000.0});
  ASSERT_EQ(link.set("least", 0.25).run(), "");
  EXPECT_NEAR(link.number(End::to, "smart_volume.demand_limit", 1), 3000 * (1 + 0.5 * (8000.0 / 9000 - 1)), 1e-9);
  EXPECT_NE(link.remarked(LinkRemark::at_work), "");
  link.read(End::to, "smart_volume.demand_limit", {1e9, 1500.0});
  link.read(End::to, "smart_volume.wanted", {4000.0, 1500.0}).read(End::to, "smart_volume.fitted", {4000.0, 1500.0});
  ASSERT_EQ(link.run(), "");
  EXPECT_EQ(link.remarked(LinkRemark::unmet),
            "cap: the cap cannot be met: a sum of 9000 of 8000, held by `hotel` (4000 m³, its limit is locked); raise the cap, "
            "unlock the limits, or lower what is insisted on or `least`");
}

// Everything that could give way is locked: said as soon as the shapes are there, not after hundreds of ticks.
TEST(SetCap, WhereAllLimitsAreLockedItSaysSoAtOnce) {
  World world = World::from_file("scenes/links/set_cap.json");
  for (const char* id : {"house_1", "house_2", "house_3", "house_4", "house_5"})
    ASSERT_EQ(world.submit(command<LockPort>({.node = id, .port = {"smart_volume.demand_limit"}})), "");
  world.tick(20);
  const std::string said = world.link_error("l1_cap");
  EXPECT_NE(said.find("the cap cannot be met: a sum of "), std::string::npos) << said;
  EXPECT_NE(said.find("`house_4` (8000 m³, its limit is locked)"), std::string::npos) << said;
  EXPECT_FALSE(world.state().is_settled());
}

TEST(SetCap, SceneHoldsTheFloorAreaInProportion) {
  World world = World::from_file("scenes/links/set_cap.json");
  world.tick(200);
  EXPECT_TRUE(world.state().is_settled());
  EXPECT_LE(world.number("total", "statistics.sum"), 5000);
  EXPECT_GE(world.number("total", "statistics.sum"), 4950) << "the band in which the limit rests";
  const double share = world.number("house_1", "smart_volume.wanted") / 4000;
  EXPECT_LT(share, 0.8);
  EXPECT_NEAR(world.number("house_4", "smart_volume.wanted") / 8000, share, 1e-9);
}

}  // namespace
}  // namespace bl
