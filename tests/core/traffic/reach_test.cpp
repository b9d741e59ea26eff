// Reach and trip distribution by hand.
#include "core/traffic/reach.h"

#include <cmath>

#include "core/traffic/trip_distribution.h"
#include "tests/core/traffic/traffic_case.h"

namespace bl::traffic {
namespace {

// a -100 m- b -100 m- c, both ways, and d that no street leads to.
TrafficNetwork lane() {
  auto link = [](const char* from, const char* to) {
    return TrafficLink{std::string(from) + to, from, to, 10, 100, 0.15, 4, 100, 0, true};
  };
  return *TrafficNetwork::make({{"a", true}, {"b", true}, {"c", true}, {"d", true}},
                               {link("a", "b"), link("b", "c"), link("b", "a"), link("c", "b")});
}

TEST(Reach, WalkingAndDrivingTimesFromAPlace) {
  const TrafficNetwork network = lane();
  const auto walk = travel_costs(network, 0, walking_costs(network, 1.25));
  EXPECT_EQ(walk[0], 0);
  EXPECT_DOUBLE_EQ(walk[2], 160);
  EXPECT_EQ(walk[3], kUnreached);
  std::vector<double> drive(network.link_count(), 10);
  drive[network.link_index("ab")] = network.cost(network.link_index("ab"), 100);
  EXPECT_DOUBLE_EQ(travel_costs(network, 0, drive)[2], 21.5);
}

TEST(Reach, AnIsochroneEndsWithinALink) {
  const TrafficNetwork network = lane();
  const auto costs = walking_costs(network, 1);
  const auto reached = reached_links(network, 0, travel_costs(network, 0, costs), costs, 130);
  ASSERT_EQ(reached.size(), 3u);  // a-b whole, back again in part, b-c in part
  EXPECT_EQ(network.link(reached[0].link).id, "ab");
  EXPECT_EQ(reached[0].share, 1);
  EXPECT_NEAR(reached[2].share, 0.3, 1e-12);
}

TEST(Reach, AccessibilityFadesAndLeavesOutWhatIsOutOfReach) {
  const std::vector<double> costs{0, 600, kUnreached}, amounts{10, 20, 1000};
  EXPECT_NEAR(accessibility(costs, amounts, 600), 10 + 20 * std::exp(-1.0), 1e-12);
}

TEST(TripDistribution, OneSideHeldByHand) {
  // From the first: two destinations, equal attraction, one a fade farther: e to 1.
  const std::vector<double> times{0, 100, 200, 100, 0, 100, 200, 100, 0}, leaving{10, 0, 0}, arriving{0, 5, 5};
  const auto out = distribute_trips(times, leaving, arriving, 100, TripConstraint::origins);
  EXPECT_NEAR(out.trips[1], 10 * std::exp(1.0) / (1 + std::exp(1.0)), 1e-12);
  EXPECT_NEAR(out.trips[1] + out.trips[2], 10, 1e-12);
  EXPECT_EQ(out.lost[0], 0);
}

TEST(TripDistribution, BothSidesHeld) {
  Random random(5);
  const std::size_t n = 8;
  std::vector<double> times, leaving, arriving;
  for (std::size_t i = 0; i < n * n; ++i) times.push_back(random.uniform(10, 1000));
  for (std::size_t i = 0; i < n; ++i) leaving.push_back(random.uniform(1, 100)), arriving.push_back(random.uniform(1, 50));
  const auto out = distribute_trips(times, leaving, arriving, 300, TripConstraint::both);
  double sum_leaving = 0, sum_arriving = 0;
  for (std::size_t i = 0; i < n; ++i) sum_leaving += leaving[i], sum_arriving += arriving[i];
  for (std::size_t i = 0; i < n; ++i) {
    double row = 0, column = 0;
    for (std::size_t j = 0; j < n; ++j) row += out.trips[i * n + j], column += out.trips[j * n + i];
    EXPECT_NEAR(row, leaving[i], 1e-9);
    EXPECT_NEAR(column, arriving[i] * sum_leaving / sum_arriving, 1e-6 * column);
    EXPECT_EQ(out.trips[i * n + i], 0);
  }
}

TEST(TripDistribution, WhoFindsNoDestinationIsLost) {
  const double far = kUnreached;
  const std::vector<double> times{0, far, far, 0}, leaving{7, 3}, arriving{1, 1};
  for (const auto constraint : {TripConstraint::origins, TripConstraint::both}) {
    const auto out = distribute_trips(times, leaving, arriving, 100, constraint);
    EXPECT_EQ(out.lost[0], 7);
    EXPECT_EQ(out.lost[1], 3);
    EXPECT_EQ(out.trips[1], 0);
  }
}

}  // namespace
}  // namespace bl::traffic
