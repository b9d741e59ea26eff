// Shortest paths against Boost.Graph on random networks, and by hand where nodes let nothing through.
#include "core/traffic/shortest_paths.h"

#include <boost/graph/adjacency_list.hpp>
#include <boost/graph/dijkstra_shortest_paths.hpp>

#include "core/traffic/shortest_trees.h"
#include "tests/core/traffic/traffic_case.h"

namespace bl::traffic {
namespace {

using Graph = boost::adjacency_list<boost::vecS, boost::vecS, boost::directedS, boost::no_property,
                                    boost::property<boost::edge_weight_t, double>>;

std::vector<double> by_boost(const TrafficNetwork& network, std::uint32_t origin, std::span<const double> costs) {
  Graph graph(network.node_count());
  for (std::uint32_t l = 0; l < network.link_count(); ++l)
    if (network.is_open(l)) boost::add_edge(network.from(l), network.to(l), costs[l], graph);
  std::vector<double> distance(network.node_count());
  boost::dijkstra_shortest_paths(
      graph, origin,
      boost::distance_map(boost::make_iterator_property_map(distance.begin(), boost::get(boost::vertex_index, graph))));
  for (double& d : distance)
    if (d == std::numeric_limits<double>::max()) d = kUnreached;
  return distance;
}

TEST(ShortestPaths, AgreeWithBoostGraphOnRandomNetworks) {
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    Random random(seed);
    TrafficNetwork network = traffic_test::random_grid(seed, 2 + static_cast<int>(random.below(12)), 0).network();
    std::vector<double> costs;
    for (std::uint32_t l = 0; l < network.link_count(); ++l) {
      costs.push_back(random.below(5) == 0 ? 0 : random.uniform(0, 100));
      if (random.below(3) == 0) network.set_open(l, false);
    }
    ShortestPaths paths(network);
    for (int round = 0; round < 5; ++round) {
      const auto origin = static_cast<std::uint32_t>(random.below(network.node_count()));
      paths.run(origin, costs);
      const auto expected = by_boost(network, origin, costs);
      for (std::uint32_t n = 0; n < network.node_count(); ++n) {
        EXPECT_EQ(paths.labels()[n], expected[n]) << "seed " << seed << ", node " << n;
        double length = 0;
        std::uint32_t at = n;
        for (std::size_t steps = 0; at != origin && paths.last_links()[at] != kNoTrafficIndex && steps < network.node_count();
             ++steps) {
          length += costs[paths.last_links()[at]];
          at = network.from(paths.last_links()[at]);
        }
        if (expected[n] == kUnreached) EXPECT_NE(at, origin);
        else EXPECT_TRUE(at == origin && std::abs(length - expected[n]) < 1e-9) << "seed " << seed << ", node " << n;
      }
    }
  }
}

TEST(ShortestPaths, MendingReachesTheSameLabels) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Random random(seed);
    const TrafficNetwork network = traffic_test::random_grid(seed, 9, 0).network();
    std::vector<double> costs, before;
    for (std::uint32_t l = 0; l < network.link_count(); ++l) before.push_back(random.uniform(1, 100));
    for (const double cost : before) costs.push_back(random.below(2) == 0 ? cost : cost * random.uniform(0.2, 1));
    ShortestPaths paths(network);
    paths.run(7, before);
    std::vector<double> labels(paths.labels().begin(), paths.labels().end());
    paths.mend(7, costs, labels);
    paths.run(7, costs);
    for (std::uint32_t n = 0; n < network.node_count(); ++n) EXPECT_EQ(labels[n], paths.labels()[n]);
  }
}

TEST(ShortestPaths, NothingPassesAZoneThatLetsNothingThrough) {
  // a - z - b is short, a - c - b is long; z may be left and entered, not passed.
  const auto link = [](const char* from, const char* to, double time) {
    return TrafficLink{std::string(from) + to, from, to, time, 1, 0, 1, 1, 0, true};
  };
  const auto network = *TrafficNetwork::make({{"a", true}, {"b", true}, {"c", true}, {"z", false}},
                                             {link("a", "z", 1), link("z", "b", 1), link("a", "c", 5), link("c", "b", 5)});
  std::vector<double> costs;
  for (std::uint32_t l = 0; l < network.link_count(); ++l) costs.push_back(network.cost(l, 0));
  ShortestPaths paths(network);
  paths.run(network.node_index("a"), costs);
  EXPECT_EQ(paths.labels()[network.node_index("z")], 1);
  EXPECT_EQ(paths.labels()[network.node_index("b")], 10);
  paths.run(network.node_index("z"), costs);
  EXPECT_EQ(paths.labels()[network.node_index("b")], 1);
  EXPECT_EQ(paths.labels()[network.node_index("a")], kUnreached);
}

TEST(ShortestTrees, TheyAreThoseOfASearchWhateverCameBefore) {
  const TrafficNetwork network = traffic_test::random_grid(5, 7, 0).network();
  Random random(5);
  std::vector<std::uint32_t> origins{0, 9, 30};
  ShortestTrees trees(network, origins);
  std::vector<double> costs;
  for (std::uint32_t l = 0; l < network.link_count(); ++l) costs.push_back(network.cost(l, 0));
  for (int round = 0; round < 50; ++round) {
    trees.update(costs);
    for (std::size_t k = 0; k < origins.size(); ++k) {
      ShortestPaths paths(network);
      paths.run(origins[k], costs);
      EXPECT_TRUE(std::equal(paths.labels().begin(), paths.labels().end(), trees.labels(k).begin())) << round;
      EXPECT_EQ(trees.labels_of(origins[k]).data(), trees.labels(k).data());
    }
    // Whole numbers now and then, so that many ways are equally long; and streets without any length.
    for (double& cost : costs) cost = round % 3 == 0 ? static_cast<double>(random.below(4)) : cost * random.uniform(0.8, 1.2);
  }
  EXPECT_TRUE(trees.labels_of(1).empty());
}

}  // namespace
}  // namespace bl::traffic
