// Congestion feedback: limits by hand, and offices that their street holds back.
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

TEST(CongestionFeedback, SceneHoldsTheOfficesBack) {
  World world = World::from_file("scenes/links/congestion_feedback.json");
  ASSERT_TRUE(world.settle(300));
  EXPECT_NEAR(world.number("street", "street.volume_over_capacity"), 0.9, 0.03);
  EXPECT_LT(world.number("offices", "smart_volume.wanted"), 21000);
  EXPECT_GT(world.number("offices", "smart_volume.wanted"), 15000);
}

}  // namespace
}  // namespace bl
