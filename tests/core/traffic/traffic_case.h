// Networks to test traffic with: small ones by hand, random ones, and published ones beside the checkout.
#pragma once

#include <gtest/gtest.h>

#include <fstream>
#include <iostream>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "core/base/random.h"
#include "core/import/tntp.h"
#include "core/traffic/equilibrium.h"
#include "tests/support/reference_files.h"

namespace bl::traffic_test {

struct Case {
  std::vector<traffic::TrafficNode> nodes;
  std::vector<traffic::TrafficLink> links;
  struct Trip {
    std::string from, to;
    double trips;
  };
  std::vector<Trip> trips;

  traffic::TrafficNetwork network(const traffic::CostFactors& factors = {}) const {
    auto made = traffic::TrafficNetwork::make(nodes, links, factors);
    EXPECT_TRUE(made.ok()) << made.error().text();
    return *made;
  }
  std::vector<traffic::TripDemand> demands(const traffic::TrafficNetwork& net, double share = 1) const {
    std::vector<traffic::TripDemand> all;
    for (const Trip& trip : trips) all.push_back({net.node_index(trip.from), net.node_index(trip.to), trip.trips * share});
    return all;
  }
};

/// Braess's network of 1968: a, b, c, d; times 10·v, 50 + v, 50 + v, 10·v, and the bridge b-c with 10 + v. Six trips from a to d.
inline Case braess(bool with_bridge) {
  auto linear = [](const char* id, const char* from, const char* to, double free_time, double slope) {
    return traffic::TrafficLink{id, from, to, free_time, 1, slope / free_time, 1, 100, 0, true};
  };
  Case one;
  for (const char* id : {"a", "b", "c", "d"}) one.nodes.push_back({id, true});
  one.links = {linear("a-b", "a", "b", 1e-8, 10), linear("a-c", "a", "c", 50, 1), linear("b-d", "b", "d", 50, 1),
               linear("c-d", "c", "d", 1e-8, 10), linear("b-c", "b", "c", 10, 1)};
  one.links.back().is_open = with_bridge;
  one.trips = {{"a", "d", 6}};
  return one;
}

/// A grid of two-way streets with random times and capacities, and trips between random corners.
inline Case random_grid(std::uint64_t seed, int side, int pairs) {
  Random random(seed);
  Case one;
  auto name = [](int x, int y) { return "n" + std::to_string(x) + "_" + std::to_string(y); };
  auto link = [&](const std::string& a, const std::string& b) {
    one.links.push_back({a + ">" + b, a, b, random.uniform(10, 100), random.uniform(200, 900), 0.15, 4, random.uniform(50, 500),
                         random.uniform(0, 3), true});
  };
  for (int x = 0; x < side; ++x)
    for (int y = 0; y < side; ++y) {
      one.nodes.push_back({name(x, y), true});
      if (x > 0) link(name(x - 1, y), name(x, y)), link(name(x, y), name(x - 1, y));
      if (y > 0) link(name(x, y - 1), name(x, y)), link(name(x, y), name(x, y - 1));
    }
  for (int p = 0; p < pairs; ++p) {
    const auto at = [&] { return static_cast<int>(random.below(static_cast<std::uint64_t>(side))); };
    one.trips.push_back({name(at(), at()), name(at(), at()), random.uniform(1, 100)});
  }
  return one;
}

inline std::string text_of(const std::filesystem::path& path) {
  std::ifstream file(path);
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
}

/// A published network beside the checkout; nothing, and a sentence, where it is not there.
inline std::optional<Case> published(const std::string& name) {
  const auto net = test::shared_file("data/tntp/" + name + "_net.tntp"),
             trips = test::shared_file("data/tntp/" + name + "_trips.tntp");
  if (net.empty() || trips.empty()) {
    std::cout << "The network " << name << " is not beside this checkout; its figures are not compared.\n";
    return std::nullopt;
  }
  const auto read_net = importing::read_tntp_network(text_of(net));
  const auto read_trips = importing::read_tntp_trips(text_of(trips));
  EXPECT_TRUE(read_net.ok() && read_trips.ok());
  Case one{read_net->nodes, read_net->links, {}};
  for (const auto& entry : read_trips->entries) one.trips.push_back({entry.origin, entry.destination, entry.trips});
  return one;
}

/// Every trip is somewhere: at each node, what arrives and begins equals what leaves and ends, for each origin by itself.
inline void expect_conserved(const traffic::Equilibrium& equilibrium) {
  const traffic::TrafficNetwork& network = equilibrium.network();
  std::vector<double> total(network.link_count(), 0);
  for (const traffic::Bush& bush : equilibrium.bushes()) {
    std::vector<double> balance(network.node_count(), 0);
    double scale = 1;
    for (const traffic::TripDemand& demand : bush.demands) {
      balance[bush.origin] += demand.trips;
      balance[demand.destination] -= demand.trips;
      scale += demand.trips;
    }
    for (std::size_t s = 0; s < bush.links.size(); ++s) {
      EXPECT_GE(bush.flows[s], 0);
      EXPECT_TRUE(network.is_open(bush.links[s]) || bush.flows[s] == 0);
      balance[network.from(bush.links[s])] -= bush.flows[s];
      balance[network.to(bush.links[s])] += bush.flows[s];
      total[bush.links[s]] += bush.flows[s];
    }
    for (const double left : balance) EXPECT_NEAR(left, 0, 1e-10 * scale);
  }
  for (std::size_t l = 0; l < total.size(); ++l) EXPECT_EQ(total[l], equilibrium.flows()[l]);
}

}  // namespace bl::traffic_test
