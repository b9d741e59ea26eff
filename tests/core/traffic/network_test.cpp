// Networks by hand: the cost formula, generalised cost, errors with their place, and edits.
#include "core/traffic/network.h"

#include <algorithm>
#include <cmath>

#include "tests/core/traffic/traffic_case.h"

namespace bl::traffic {
namespace {

TrafficNetwork one_link(TrafficLink link, const CostFactors& factors = {}) {
  auto made = TrafficNetwork::make({{"a", true}, {"b", true}}, {std::move(link)}, factors);
  EXPECT_TRUE(made.ok()) << made.error().text();
  return *made;
}

TEST(TrafficNetwork, CostFollowsTheFormulaOfTheBureau) {
  const auto network = one_link({"s", "a", "b", 60, 1000, 0.15, 4, 300, 0, true});
  EXPECT_EQ(network.cost(0, 0), 60);
  EXPECT_NEAR(network.cost(0, 1000), 60 * 1.15, 1e-12);
  EXPECT_NEAR(network.cost(0, 2000), 60 * (1 + 0.15 * 16), 1e-12);
}

TEST(TrafficNetwork, TollAndDistanceCountOnTopOfTime) {
  // By hand: 10 min, toll 50 cents at 0.02 min each, 5 miles at 0.04 min each: 10 + 1 + 0.2.
  const auto network = one_link({"s", "a", "b", 10, 100, 0.15, 4, 5, 50, true}, {0.02, 0.04});
  EXPECT_NEAR(network.cost(0, 0), 11.2, 1e-12);
  EXPECT_NEAR(network.time(0, 0), 10, 1e-12);
  EXPECT_NEAR(network.cost(0, 100), 12.7, 1e-12);
  // The area under the cost up to 100: (10 + 1.2) · 100 + 10 · 0.15 · 100 / 5.
  EXPECT_NEAR(network.integral(0, 100), 1150, 1e-9);
}

TEST(TrafficNetwork, SlopeAndIntegralFitTheCostForManyPowers) {
  for (const double power : {0.0, 1.0, 2.5, 4.0, 7.0, 20.0}) {
    const auto network = one_link({"s", "a", "b", 30, 500, 0.4, power, 100, 1, true}, {2, 0.1});
    for (const double flow : {10.0, 400.0, 900.0}) {
      const double h = 1e-3 * flow;
      const double slope = (network.cost(0, flow + h) - network.cost(0, flow - h)) / (2 * h);
      EXPECT_NEAR(network.slope(0, flow), slope, 1e-4 * (1 + slope)) << power << " at " << flow;
      const double mean = (network.integral(0, flow + h) - network.integral(0, flow - h)) / (2 * h);
      EXPECT_NEAR(network.cost(0, flow), mean, 1e-4 * mean) << power << " at " << flow;
    }
  }
}

// Published networks write capacity 1 and put the real one into the factor, or a free time of nearly nothing: the same delay.
TEST(TrafficNetwork, CostDoesNotDependOnHowADelayIsWritten) {
  for (const double power : {0.5, 1.0, 4.0, 7.5, 12.0})
    for (const double flow : {0.0, 3.0, 900.0, 40000.0, 3e6}) {
      const auto plain = one_link({"s", "a", "b", 30, 500, 0.15, power});
      const auto by_factor = one_link({"s", "a", "b", 30, 1, 0.15 / std::pow(500, power), power});
      const auto by_delay = one_link({"s", "a", "b", 3e-8, 500, 0.15e9, power, 0, 0, true, 30 - 3e-8});
      const double cost = 30 * (1 + 0.15 * std::pow(flow / 500, power));
      const double area = 30 * flow + 30 * 0.15 * flow * std::pow(flow / 500, power) / (power + 1);
      for (const auto* network : {&plain, &by_factor, &by_delay}) {
        EXPECT_NEAR(network->cost(0, flow), cost, 1e-13 * cost) << power << " at " << flow;
        EXPECT_NEAR(network->integral(0, flow), area, 1e-13 * area) << power << " at " << flow;
        EXPECT_FALSE(network->is_cut(0, flow));
      }
      EXPECT_NEAR(by_factor.slope(0, flow + 1), plain.slope(0, flow + 1), 1e-12 * plain.slope(0, flow + 1));
    }
}

TEST(TrafficNetwork, WhatNoNumberHoldsIsCutAndSaysSo) {
  const auto network = one_link({"s", "a", "b", 60, 1e-6, 0.15, 20});
  EXPECT_FALSE(network.is_cut(0, 0.01));
  for (const double flow : {1.0, 1e6, 1e12}) {
    EXPECT_TRUE(network.is_cut(0, flow)) << flow;
    EXPECT_TRUE(std::isfinite(network.cost(0, flow)) && std::isfinite(network.slope(0, flow)) &&
                std::isfinite(network.integral(0, flow)))
        << flow;
    EXPECT_GE(network.cost(0, flow), 1e100);
  }
}

TEST(TrafficNetwork, WhatMakesNoSenseIsAnErrorWithItsPlace) {
  auto place_of = [](std::vector<TrafficNode> nodes, std::vector<TrafficLink> links) {
    const auto made = TrafficNetwork::make(std::move(nodes), std::move(links));
    return made ? std::string("good") : made.error().place;
  };
  const TrafficLink good{"s", "a", "b", 1, 1, 0.15, 4, 1, 0, true};
  auto with = [&](auto change) {
    TrafficLink link = good;
    change(link);
    return place_of({{"a", true}, {"b", true}}, {link});
  };
  EXPECT_EQ(with([](TrafficLink&) {}), "good");
  EXPECT_EQ(place_of({{"a", true}, {"a", true}}, {}), "a");
  EXPECT_EQ(place_of({{"a", true}, {"b", true}}, {good, good}), "s");
  EXPECT_EQ(with([](TrafficLink& l) { l.to = "c"; }), "s");
  EXPECT_EQ(with([](TrafficLink& l) { l.to = "a"; }), "s");
  EXPECT_EQ(with([](TrafficLink& l) { l.capacity = 0; }), "s");
  EXPECT_EQ(with([](TrafficLink& l) { l.capacity = 0, l.alpha = 0; }), "good");
  EXPECT_EQ(with([](TrafficLink& l) { l.free_time = NAN; }), "s");
  EXPECT_EQ(with([](TrafficLink& l) { l.toll = HUGE_VAL; }), "s");
  EXPECT_EQ(with([](TrafficLink& l) { l.power = -1; }), "s");
}

TEST(TrafficNetwork, InputOrderDoesNotMatterAndEditsKeepIndices) {
  auto grid = traffic_test::random_grid(3, 4, 0);
  const auto network = grid.network();
  std::reverse(grid.links.begin(), grid.links.end());
  std::reverse(grid.nodes.begin(), grid.nodes.end());
  auto turned = grid.network();
  ASSERT_EQ(network.link_count(), turned.link_count());
  for (std::uint32_t l = 0; l < network.link_count(); ++l) {
    EXPECT_EQ(network.link(l).id, turned.link(l).id);
    EXPECT_EQ(network.from(l), turned.from(l));
    EXPECT_EQ(network.cost(l, 100), turned.cost(l, 100));
  }
  EXPECT_FALSE(turned.set_capacity(0, 0).ok());
  EXPECT_FALSE(turned.set_free_time(0, -1).ok());
  EXPECT_TRUE(turned.set_capacity(0, 1e9).ok());
  EXPECT_LT(turned.cost(0, 1000), network.cost(0, 1000));
  EXPECT_EQ(network.link_index("nowhere"), kNoTrafficIndex);
}

}  // namespace
}  // namespace bl::traffic
