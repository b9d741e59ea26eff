// Congestion feedback: limits by hand, and offices that their street holds back.
#include <algorithm>

#include "tests/links/link_case.h"

namespace bl {
namespace {

LinkCase feedback(double load, double demand, double limit) {
  LinkCase link("congestion_feedback");
  link.set("limit", 0.8).set("gain", 0.5).set("least", 0.2).set("tolerance", 0.0);
  link.from("traffic_network.loads",
            Shared(Table{{"junction", "volume_over_capacity"},
                         {{std::string("far"), 9.0}, {std::string("gate"), load}, {std::string("it"), 0.1}}}));
  link.to("node.id", std::string("it"));
  link.to("traffic_zone.access", Shared(std::vector<std::string>{"gate", "unknown"}));
  link.to("traffic_zone.trips_served", 10.0).to("traffic_zone.trips_lost", 0.0);
  link.to("smart_volume.demand", demand).to("smart_volume.demand_limit", limit);
  link.to("smart_volume.wanted", std::min(demand, limit)).to("smart_volume.fitted", std::min(demand, limit));
  return link;
}

TEST(CongestionFeedback, LimitsByTheStreetAtTheAccess) {
  auto link = feedback(1.0, 1000, 1e9);  // a fifth too much, half of it answered: 0.9
  ASSERT_EQ(link.run(), "");
  EXPECT_NEAR(link.number(End::to, "smart_volume.demand_limit"), 900, 1e-9);
  auto next = feedback(1.0, 1000, 900);
  ASSERT_EQ(next.run(), "");
  EXPECT_NEAR(next.number(End::to, "smart_volume.demand_limit"), 810, 1e-9);
}

TEST(CongestionFeedback, LoosensLeavesTheLeastAndIsSilentWithoutTraffic) {
  auto loose = feedback(0.4, 1000, 500);  // room for twice as much: 1.5
  ASSERT_EQ(loose.run(), "");
  EXPECT_NEAR(loose.number(End::to, "smart_volume.demand_limit"), 750, 1e-9);
  auto least = feedback(50, 1000, 210);
  ASSERT_EQ(least.run(), "");
  EXPECT_NEAR(least.number(End::to, "smart_volume.demand_limit"), 200, 1e-9);
  auto calm = feedback(0, 1000, 1e9);
  ASSERT_EQ(calm.run(), "");
  EXPECT_FALSE(calm.proposed(End::to, "smart_volume.demand_limit").has_value());
}

TEST(CongestionFeedback, JustBelowTheLimitTheVolumeRests) {
  for (const double load : {0.785, 0.8}) {
    auto link = feedback(load, 1000, 600);
    ASSERT_EQ(link.set("tolerance", 0.02).run(), "");
    EXPECT_NEAR(link.number(End::to, "smart_volume.demand_limit"), 600, 1e-9) << load;
  }
  auto over = feedback(0.81, 1000, 600);  // aims at 0.792
  ASSERT_EQ(over.set("tolerance", 0.02).run(), "");
  EXPECT_NEAR(over.number(End::to, "smart_volume.demand_limit"), 600 * (1 + 0.5 * (0.792 / 0.81 - 1)), 1e-9);
}

TEST(CongestionFeedback, WithoutAWayTheAccessIsAsBadAsCanBe) {
  auto closed = feedback(0, 1000, 600);
  closed.to("traffic_zone.trips_served", 0.0).to("traffic_zone.trips_lost", 80.0);
  ASSERT_EQ(closed.run(), "");
  EXPECT_NEAR(closed.number(End::to, "smart_volume.demand_limit"), 600 * 0.75, 1e-9);
  auto quiet = feedback(0, 1000, 600);  // no traffic is no reason to jump
  ASSERT_EQ(quiet.run(), "");
  EXPECT_NEAR(quiet.number(End::to, "smart_volume.demand_limit"), 900, 1e-9);
}

TEST(CongestionFeedback, WithoutAccessTheNodeItselfIsTheJunction) {
  auto link = feedback(5, 1000, 1e9);
  link.to("traffic_zone.access", Shared(std::vector<std::string>{}));
  ASSERT_EQ(link.run(), "");
  EXPECT_FALSE(link.proposed(End::to, "smart_volume.demand_limit").has_value()) << "there is room at its own junction";
}

// At the least share there is nothing left to give: the streets are as full as they are, and that is said.
TEST(CongestionFeedback, SaysWhatTheLeastShareCannotMend) {
  auto least = feedback(1.2, 1000, 200);
  ASSERT_EQ(least.run(), "");
  EXPECT_EQ(
      least.remarked(LinkRemark::unmet),
      "limit: cannot be met: the street at the access of `it` carries 1.20 of 0.80, held by `it`, which is down to 20 % of its "
      "demand; raise `limit`, or lower what is insisted on or `least`");
  auto lost = feedback(0.1, 1000, 200);
  lost.to("traffic_zone.trips_served", 1.0).to("traffic_zone.trips_lost", 9.0);
  ASSERT_EQ(lost.run(), "");
  EXPECT_NE(lost.remarked(LinkRemark::unmet).find("of the trips of `it` 90 % find no way, held by `it`"), std::string::npos)
      << lost.remarked(LinkRemark::unmet);
  auto locked = feedback(1.2, 1000, 600);
  ASSERT_EQ(locked.lock(End::to, "smart_volume.demand_limit").run(), "");
  EXPECT_NE(
      locked.remarked(LinkRemark::unmet).find("held by `it` (600 m³, its limit is locked); raise `limit`, unlock the limits, "),
      std::string::npos)
      << locked.remarked(LinkRemark::unmet);
  auto on_its_way = feedback(1.2, 1000, 600), within = feedback(0.8, 1000, 200);
  ASSERT_EQ(on_its_way.run(), "");
  ASSERT_EQ(within.run(), "");
  EXPECT_EQ(on_its_way.remarked(LinkRemark::unmet), "");
  EXPECT_EQ(within.remarked(LinkRemark::unmet), "");
}

TEST(CongestionFeedback, ALimitThatCannotBeMetKeepsASceneFromSettling) {
  World world = World::from_file("scenes/links/congestion_feedback.json");
  ASSERT_EQ(world.submit(command<SetLinkParameter>({.id = "l2_feedback", .parameter = "limit", .value = {"0.01"}})), "");
  EXPECT_FALSE(world.settle(300));
  EXPECT_NE(world.link_error("l2_feedback").find("cannot be met: the street at the access of `offices` carries "),
            std::string::npos)
      << world.link_error("l2_feedback");
}

TEST(CongestionFeedback, SceneHoldsTheOfficesBack) {
  World world = World::from_file("scenes/links/congestion_feedback.json");
  ASSERT_TRUE(world.settle(300));
  EXPECT_NEAR(world.number("street", "street.volume_over_capacity"), 0.9, 0.03);
  EXPECT_LT(world.number("offices", "smart_volume.wanted"), 21000);
  EXPECT_GT(world.number("offices", "smart_volume.wanted"), 15000);
}

TEST(CongestionFeedback, WhatStandsGivesUpWholeStoreysWithItsDemand) {
  const auto standing = [](double limit, std::int64_t built) {
    auto link = feedback(1.0, 1000, limit);
    link.to("smart_volume.storey_height", 3.0)
        .to("footprint.storeys", std::int64_t{10})
        .to("footprint.storeys_min", std::int64_t{1});
    link.to("footprint.storeys_held", built).to("footprint.height_limit", 1e6);
    return link;
  };
  auto first = standing(1e9, 10), next = standing(900, 9);  // shares of 0.9 and 0.81: nine storeys, then eight
  ASSERT_EQ(first.run(), "");
  EXPECT_NEAR(first.number(End::to, "footprint.height_limit"), 9.5 * 3, 1e-9);
  ASSERT_EQ(next.run(), "");
  EXPECT_NEAR(next.number(End::to, "footprint.height_limit"), 8.6 * 3, 1e-9);
  EXPECT_NEAR(next.number(End::to, "smart_volume.demand_limit"), 810, 1e-9);
  auto calm = standing(1e9, 10);
  ASSERT_EQ(calm.set("limit", 2.0).run(), "");
  EXPECT_FALSE(calm.proposed(End::to, "footprint.height_limit").has_value());
}

}  // namespace
}  // namespace bl
