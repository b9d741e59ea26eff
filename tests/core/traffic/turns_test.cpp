// Forbidden turns: a crossing by hand, random bans against Boost.Graph on the graph of turns, and equilibria that obey them.
#include "core/traffic/turns.h"

#include <algorithm>
#include <boost/graph/adjacency_list.hpp>
#include <boost/graph/dijkstra_shortest_paths.hpp>
#include <set>

#include "core/traffic/shortest_paths.h"
#include "tests/core/traffic/traffic_case.h"

namespace bl::traffic {
namespace {

using traffic_test::Case;
using traffic_test::random_grid;
using Pair = std::pair<std::string, std::string>;

std::set<Pair> pairs_of(const std::vector<ForbiddenTurn>& turns) {
  std::set<Pair> pairs;
  for (const ForbiddenTurn& turn : turns) pairs.emplace(turn.from, turn.to);
  return pairs;
}

// Each turn of the network is forbidden with this probability; those back by the same street as well.
std::vector<ForbiddenTurn> random_turns(const Case& one, Random& random, double share) {
  std::vector<ForbiddenTurn> turns;
  for (const TrafficLink& from : one.links)
    for (const TrafficLink& to : one.links)
      if (from.to == to.from && random.uniform(0, 1) < share) turns.push_back({from.id, to.id});
  return turns;
}

Case split(Case one, const std::vector<ForbiddenTurn>& turns) {
  const auto done = forbid_turns(one.nodes, one.links, turns);
  EXPECT_TRUE(done.ok()) << done.error().text();
  return one;
}

std::uint32_t arrivals_at(const TrafficNetwork& network, const std::string& node) {
  const std::uint32_t index = network.node_index(arrivals_of(node));
  return index == kNoTrafficIndex ? network.node_index(node) : index;
}

// Another model of the same: vertices are links, edges are allowed turns. Least cost by origin and destination.
using Graph = boost::adjacency_list<boost::vecS, boost::vecS, boost::directedS, boost::no_property,
                                    boost::property<boost::edge_weight_t, double>>;
double by_turns(const Case& one, const std::set<Pair>& forbidden, const std::map<std::string, double>& costs,
                const std::string& origin, const std::string& destination) {
  const std::size_t count = one.links.size();
  Graph graph(count + 1);
  for (std::size_t a = 0; a < count; ++a) {
    if (one.links[a].from == origin) boost::add_edge(count, a, costs.at(one.links[a].id), graph);
    for (std::size_t b = 0; b < count; ++b)
      if (one.links[a].to == one.links[b].from && !forbidden.contains({one.links[a].id, one.links[b].id}))
        boost::add_edge(a, b, costs.at(one.links[b].id), graph);
  }
  std::vector<double> distance(count + 1);
  boost::dijkstra_shortest_paths(
      graph, count,
      boost::distance_map(boost::make_iterator_property_map(distance.begin(), boost::get(boost::vertex_index, graph))));
  double least = std::numeric_limits<double>::max();
  for (std::size_t a = 0; a < count; ++a)
    if (one.links[a].to == destination) least = std::min(least, distance[a]);
  return least == std::numeric_limits<double>::max() ? kUnreached : least;
}

// The streets of a way without the turns between them; no forbidden one among them.
void expect_allowed(const TrafficNetwork& network, const std::vector<std::uint32_t>& links, const std::set<Pair>& forbidden) {
  std::string last;
  for (const std::uint32_t l : links) {
    if (is_turn(network.link(l).id)) continue;
    EXPECT_FALSE(forbidden.contains({last, network.link(l).id})) << last << " then " << network.link(l).id;
    last = network.link(l).id;
  }
}

// A crossing x with arms w, e, n, all of 100 s, and a street e - n of 350 s.
Case crossing() {
  Case one;
  for (const char* id : {"e", "n", "w", "x"}) one.nodes.push_back({id, true});
  const auto both = [&](const std::string& a, const std::string& b, double time) {
    one.links.push_back({a + b, a, b, time, 1000, 0, 1, time, 0, true});
    one.links.push_back({b + a, b, a, time, 1000, 0, 1, time, 0, true});
  };
  both("w", "x", 100), both("e", "x", 100), both("n", "x", 100), both("e", "n", 350);
  return one;
}

double time_between(const Case& one, const std::string& from, const std::string& to) {
  const TrafficNetwork network = one.network();
  std::vector<double> costs;
  for (std::uint32_t l = 0; l < network.link_count(); ++l) costs.push_back(network.cost(l, 0));
  ShortestPaths paths(network);
  paths.run(network.node_index(from), costs);
  return paths.labels()[arrivals_at(network, to)];
}

TEST(Turns, ACrossingByHand) {
  const Case plain = crossing();
  EXPECT_EQ(time_between(plain, "w", "n"), 200);
  const Case left = split(plain, {{"wx", "xn"}});
  EXPECT_EQ(time_between(left, "w", "n"), 400) << "on to e, back, and then to the right";
  EXPECT_EQ(time_between(left, "e", "n"), 200) << "whoever comes from elsewhere may turn";
  EXPECT_EQ(time_between(left, "x", "n"), 100) << "whoever sets out here may go anywhere";
  EXPECT_EQ(time_between(left, "w", "x"), 100);
  EXPECT_EQ(time_between(left, "n", "w"), 200) << "the other direction is another turn";
  const Case round = split(plain, {{"wx", "xn"}, {"xe", "ex"}});
  EXPECT_EQ(time_between(round, "w", "n"), 550) << "nobody turns round at e: 100 + 100 + 350";
  const Case straight = split(plain, {{"wx", "xn"}, {"wx", "xw"}, {"xe", "ex"}, {"xe", "en"}});
  EXPECT_EQ(time_between(straight, "w", "e"), 200);
  EXPECT_EQ(time_between(straight, "w", "n"), kUnreached) << "e is the end of the way for who comes from x";
}

TEST(Turns, OnlyNodesWithForbiddenTurnsAreTouched) {
  const Case plain = crossing(), same = split(plain, {}), left = split(plain, {{"wx", "xn"}, {"wx", "xn"}});
  EXPECT_EQ(same.nodes.size(), plain.nodes.size());
  EXPECT_EQ(same.links.size(), plain.links.size());
  EXPECT_EQ(left.nodes.size(), plain.nodes.size() + 3) << "x<wx, x>xn and x>";
  EXPECT_EQ(left.links.size(), plain.links.size() + 3) << "x and x<wx go on by x>, and x by x>xn as well";
  for (std::size_t l = 0; l < plain.links.size(); ++l) EXPECT_EQ(left.links[l].id, plain.links[l].id);
  EXPECT_EQ(left.links.back().length, 0);
  EXPECT_TRUE(is_turn(left.links.back().id));
}

TEST(Turns, WhatCannotBeATurnIsAnErrorWithItsPlace) {
  Case one = crossing();
  const auto error = [&](const ForbiddenTurn& turn) { return forbid_turns(one.nodes, one.links, {turn}).error().text(); };
  EXPECT_EQ(error({"wx", "xz"}), "wx: there is no link `xz` to forbid a turn at");
  EXPECT_EQ(error({"zx", "xw"}), "zx: there is no link `zx` to forbid a turn at");
  EXPECT_EQ(error({"wx", "en"}), "wx: it ends at `x`, where `en` does not begin");
  one.nodes[3].is_through = false;
  EXPECT_EQ(error({"wx", "xn"}), "wx: nothing passes `x` anyway; leave the turn to `xn` out");
}

TEST(Turns, ShortestWaysAgreeWithBoostOnTheGraphOfTurns) {
  int found = 0, cut_off = 0, longer = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    Random random(seed, 5);
    const Case plain = random_grid(seed, 2 + static_cast<int>(random.below(3)), 0);
    const std::vector<ForbiddenTurn> turns = random_turns(plain, random, seed % 3 == 0 ? 0.6 : 0.2);
    const std::set<Pair> forbidden = pairs_of(turns);
    const TrafficNetwork network = split(plain, turns).network();
    std::map<std::string, double> cost_of;
    std::vector<double> costs;
    for (std::uint32_t l = 0; l < network.link_count(); ++l) {
      costs.push_back(network.cost(l, 0));
      cost_of[network.link(l).id] = costs.back();
    }
    ShortestPaths paths(network);
    for (const TrafficNode& from : plain.nodes) {
      const std::uint32_t origin = network.node_index(from.id);
      paths.run(origin, costs);
      for (const TrafficNode& to : plain.nodes) {
        if (to.id == from.id) continue;
        const std::uint32_t node = arrivals_at(network, to.id);
        const double expected = by_turns(plain, forbidden, cost_of, from.id, to.id);
        if (expected == kUnreached) {
          EXPECT_EQ(paths.labels()[node], kUnreached) << "seed " << seed << ": " << from.id << " to " << to.id;
          ++cut_off;
          continue;
        }
        EXPECT_NEAR(paths.labels()[node], expected, 1e-9) << "seed " << seed << ": " << from.id << " to " << to.id;
        std::vector<std::uint32_t> links;
        for (std::uint32_t at = node; at != origin; at = network.from(links.back())) links.push_back(paths.last_links()[at]);
        std::reverse(links.begin(), links.end());
        expect_allowed(network, links, forbidden);
        ++found;
        if (expected > by_turns(plain, {}, cost_of, from.id, to.id) + 1e-9) ++longer;
      }
    }
  }
  EXPECT_GT(found, 1000);
  EXPECT_GT(longer, 100) << "the bans have to matter";
  EXPECT_GT(cut_off, 10);
}

// Demands of a case between the halves of split nodes.
std::vector<TripDemand> demands_of(const Case& one, const TrafficNetwork& network) {
  std::vector<TripDemand> demands;
  for (const Case::Trip& trip : one.trips)
    if (trip.from != trip.to) demands.push_back({network.node_index(trip.from), arrivals_at(network, trip.to), trip.trips});
  return demands;
}

TEST(Turns, InEquilibriumNobodyGainsByAnyAllowedWay) {
  int checked = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Random random(seed, 6);
    const Case plain = random_grid(seed, 4, 12);
    const std::vector<ForbiddenTurn> turns = random_turns(plain, random, 0.25);
    const std::set<Pair> forbidden = pairs_of(turns);
    const TrafficNetwork network = split(plain, turns).network();
    Equilibrium equilibrium(network, demands_of(plain, network));
    ASSERT_TRUE(equilibrium.run(1e-11, 200)) << "seed " << seed;
    traffic_test::expect_conserved(equilibrium);
    std::map<std::string, double> cost_of;
    for (std::uint32_t l = 0; l < network.link_count(); ++l) cost_of[network.link(l).id] = equilibrium.costs()[l];
    std::set<std::pair<std::uint32_t, std::uint32_t>> lost;
    for (const LostTrips& trips : equilibrium.lost()) lost.insert({trips.origin, trips.destination});
    for (const Case::Trip& trip : plain.trips) {
      if (trip.from == trip.to) continue;
      const std::uint32_t from = network.node_index(trip.from), to = arrivals_at(network, trip.to);
      const double least = by_turns(plain, forbidden, cost_of, trip.from, trip.to);
      EXPECT_EQ(lost.contains({from, to}), least == kUnreached);
      for (const Route& route : equilibrium.routes(from, to)) {
        expect_allowed(network, route.links, forbidden);
        if (route.trips > 1e-3) {
          EXPECT_NEAR(route.cost, least, 1e-4 * least) << "seed " << seed << ": " << trip.from << " to " << trip.to;
          ++checked;
        }
      }
    }
  }
  EXPECT_GT(checked, 200);
}

TEST(Turns, NewBansAreAnsweredFromTheOldFlowsAndTheOrderChangesNoBit) {
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    Random random(seed, 7);
    const Case plain = random_grid(seed, 6, 30);
    const std::vector<ForbiddenTurn> turns = random_turns(plain, random, 0.1);
    std::vector<ForbiddenTurn> backwards(turns.rbegin(), turns.rend());
    Case turned = plain;
    std::reverse(turned.links.begin(), turned.links.end());
    const TrafficNetwork before = plain.network(), after = split(plain, turns).network(),
                         same = split(turned, backwards).network();
    Equilibrium free(before, plain.demands(before)), cold(after, demands_of(plain, after)), other(same, demands_of(plain, same));
    ASSERT_TRUE(free.run(1e-10, 200) && cold.run(1e-10, 200) && other.run(1e-10, 200));
    EXPECT_EQ(cold.flows(), other.flows());
    std::vector<OriginFlow> start;
    for (const OriginFlow& flow : free.origin_flows())
      start.push_back({after.node_index(before.node(flow.origin).id), after.link_index(before.link(flow.link).id), flow.flow});
    Equilibrium warm(after, demands_of(plain, after), start);
    ASSERT_TRUE(warm.run(1e-10, 200));
    for (std::uint32_t l = 0; l < after.link_count(); ++l)
      if (!is_turn(after.link(l).id)) { EXPECT_NEAR(warm.flows()[l], cold.flows()[l], 1e-2) << "seed " << seed; }
  }
}

}  // namespace
}  // namespace bl::traffic
