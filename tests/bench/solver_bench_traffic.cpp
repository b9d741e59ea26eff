// Rows of traffic: user equilibria from nothing and after an edit, and shortest ways, against other methods in the same run.
#include <algorithm>
#include <boost/graph/compressed_sparse_row_graph.hpp>
#include <boost/graph/dijkstra_shortest_paths.hpp>
#include <cmath>
#include <filesystem>
#include <memory>

#include "core/base/hash.h"
#include "core/base/random.h"
#include "core/file/file_io.h"
#include "core/import/tntp.h"
#include "core/traffic/equilibrium.h"
#include "tests/bench/bench_frank_wolfe.h"
#include "tests/bench/solver_bench_district.h"
#include "tests/bench/solver_bench_rows.h"

namespace bl::cli::bench {

namespace {

constexpr int kMostIterations = 3000;  // where they do not suffice, the gap that was reached says so

struct Town {
  std::string name;
  traffic::TrafficNetwork network;
  std::vector<traffic::TripDemand> demands;  // ascending origin
};

// A grid of two-way streets of about 100 m, with trips between 30 of its crossings that fill the busiest streets.
Result<Town> made_up(int junctions) {
  const int side = std::max(2, static_cast<int>(std::lround(std::sqrt(junctions))));
  Random random(20070, static_cast<std::uint64_t>(side));
  const auto name = [&](int x, int y) { return std::to_string(10000 + x * side + y); };
  std::vector<traffic::TrafficNode> nodes;
  std::vector<traffic::TrafficLink> links;
  const auto both = [&](const std::string& a, const std::string& b) {
    const double time = random.uniform(8, 16), capacity = random.uniform(400, 1600);
    for (const auto& [from, to] : {std::pair{a, b}, {b, a}})
      links.push_back({from + "-" + to, from, to, time, capacity, 0.15, 4, 100, 0, true});
  };
  for (int x = 0; x < side; ++x)
    for (int y = 0; y < side; ++y) {
      nodes.push_back({name(x, y), true});
      if (x > 0) both(name(x - 1, y), name(x, y));
      if (y > 0) both(name(x, y - 1), name(x, y));
    }
  auto network = traffic::TrafficNetwork::make(std::move(nodes), std::move(links));
  if (!network) return network.error();
  std::vector<traffic::TripDemand> demands;
  std::vector<std::uint32_t> zones;
  while (zones.size() < std::min<std::size_t>(30, network->node_count())) {
    const auto zone = static_cast<std::uint32_t>(random.below(network->node_count()));
    if (std::find(zones.begin(), zones.end(), zone) == zones.end()) zones.push_back(zone);
  }
  std::sort(zones.begin(), zones.end());
  for (const std::uint32_t from : zones)
    for (const std::uint32_t to : zones)
      if (from != to) demands.push_back({from, to, random.uniform(5, 15) * side / 4});
  return Town{"made up, " + std::to_string(network->node_count()), std::move(*network), std::move(demands)};
}

Result<Town> published(const std::filesystem::path& net, const std::string& name) {
  const auto streets = read_file(net.string());
  const auto table = read_file((net.parent_path() / (name + "_trips.tntp")).string());
  if (!streets || !table) return streets ? table.error() : streets.error();
  const auto read = importing::read_tntp_network(*streets);
  const auto trips = importing::read_tntp_trips(*table);
  if (!read || !trips) return (read ? trips.error() : read.error()).within(name);
  auto network = traffic::TrafficNetwork::make(read->nodes, read->links, read->factors);
  if (!network) return network.error().within(name);
  std::vector<traffic::TripDemand> demands;
  for (const importing::TntpTrips::Entry& entry : trips->entries) {
    const std::uint32_t from = network->node_index(entry.origin), to = network->node_index(entry.destination);
    if (from == traffic::kNoTrafficIndex || to == traffic::kNoTrafficIndex)
      return Error{ErrorCode::not_found, name, "its trips name a zone that its network does not have"};
    if (from != to) demands.push_back({from, to, entry.trips});
  }
  std::sort(demands.begin(), demands.end(), [](const traffic::TripDemand& a, const traffic::TripDemand& b) {
    return a.origin != b.origin ? a.origin < b.origin : a.destination < b.destination;
  });
  return Town{name, std::move(*network), std::move(demands)};
}

Result<std::vector<Town>> towns_of(const SolverBench& bench) {
  std::vector<Town> towns;
  constexpr std::string_view kEnd = "_net.tntp";
  std::vector<std::filesystem::path> nets;
  std::error_code failure;
  if (!bench.options.tntp.empty()) {
    for (const auto& entry : std::filesystem::directory_iterator(bench.options.tntp, failure))
      if (entry.path().filename().string().ends_with(kEnd)) nets.push_back(entry.path());
    if (nets.empty())
      return Error{ErrorCode::not_found, bench.options.tntp, "there are no networks NAME_net.tntp in this folder"};
  }
  std::sort(nets.begin(), nets.end());
  for (const auto& net : nets) {
    const std::string file = net.filename().string();
    auto town = published(net, file.substr(0, file.size() - kEnd.size()));
    if (!town) return town.error();
    towns.push_back(std::move(*town));
  }
  for (const int junctions : bench.sites({100, 400}, {100})) {
    auto town = made_up(junctions);
    if (!town) return town.error();
    towns.push_back(std::move(*town));
  }
  return towns;
}

BenchTable assignments() {
  return {"traffic",
          "User equilibrium against bi-conjugate Frank-Wolfe with the same shortest ways; warm: one capacity halved, from the "
          "flows at a gap of 1e-6",
          {{"network", "network", true},
           {"links", "links"},
           {"pairs", "pairs"},
           {"start", "start", true},
           {"gap", "gap"},
           {"reached", "reached"},
           {"iterations", "iterations"},
           {"ms", "milliseconds"},
           {"FW reached", "peer_reached"},
           {"FW iter.", "peer_iterations"},
           {"FW ms", "peer_milliseconds"},
           {"times", "times_the_peer"},
           {"objectives apart", "objectives_apart"},
           {"hash", "hash", true}}};
}

// Both methods on their marks; each call of `work` is one run from there.
struct Race {
  std::unique_ptr<traffic::Equilibrium> ours;
  std::unique_ptr<FrankWolfe> peer;
  std::vector<Contender> contenders;
};

void add_row(const Town& town, const char* start, double gap, const Race& race, BenchTable& table) {
  const traffic::EquilibriumFigures figures = race.ours->figures();
  const double ours = race.contenders[0].median.of(1), peer = race.contenders[1].median.of(1);
  const double apart = std::abs(race.peer->objective() - figures.objective) / figures.objective;
  table.add({word(town.name), figure(town.network.link_count()), figure(town.demands.size()), word(start), tiny(gap),
             tiny(figures.gap), figure(static_cast<std::size_t>(figures.iterations)), figure(1000 * ours, 3),
             tiny(race.peer->gap()), figure(static_cast<std::size_t>(race.peer->iterations())), figure(1000 * peer, 3),
             figure(peer / ours, 1), tiny(apart), word(hash_of(race.ours->flows()))});
}

bool measure_cold(const SolverBench& bench, const Town& town, double gap, BenchTable& table) {
  Race race;
  race.contenders.push_back({[&] {
                               race.ours = std::make_unique<traffic::Equilibrium>(town.network, town.demands);
                               (void)race.ours->run(gap, kMostIterations);
                             },
                             {},
                             {}});
  race.contenders.push_back({[&] {
                               race.peer = std::make_unique<FrankWolfe>(town.network, town.demands);
                               (void)race.peer->run(gap, kMostIterations);
                             },
                             {},
                             {}});
  take_turns(race.contenders, bench.rounds, bench.turn_seconds, [&] { return bench.goes_on("traffic of " + town.name); });
  if (!bench.goes_on("")) return false;
  add_row(town, "cold", gap, race, table);
  return true;
}

// The street that is used most, by volume over capacity, loses half of its capacity.
bool measure_warm(const SolverBench& bench, const Town& town, double gap, BenchTable& table) {
  traffic::Equilibrium before(town.network, town.demands);
  FrankWolfe peer_before(town.network, town.demands);
  (void)before.run(1e-6, kMostIterations);
  (void)peer_before.run(1e-6, kMostIterations);
  const std::vector<traffic::OriginFlow> start = before.origin_flows();
  std::uint32_t busiest = 0;
  const auto load = [&](std::uint32_t l) { return before.flows()[l] / town.network.link(l).capacity; };
  for (std::uint32_t l = 1; l < town.network.link_count(); ++l)
    if (load(l) > load(busiest)) busiest = l;
  const double capacity = 0.5 * town.network.link(busiest).capacity;
  Race race;
  race.contenders.push_back({[&] {
                               (void)race.ours->set_capacity(busiest, capacity);
                               (void)race.ours->run(gap, kMostIterations);
                             },
                             {},
                             {},
                             [&] { race.ours = std::make_unique<traffic::Equilibrium>(town.network, town.demands, start); }});
  race.contenders.push_back({[&] {
                               race.peer->set_capacity(busiest, capacity);
                               (void)race.peer->run(gap, kMostIterations);
                             },
                             {},
                             {},
                             [&] {
                               race.peer = std::make_unique<FrankWolfe>(town.network, town.demands);
                               race.peer->set_flows(peer_before.flows());
                             }});
  take_turns(race.contenders, bench.rounds, bench.turn_seconds, [&] { return bench.goes_on("an edit of " + town.name); });
  if (!bench.goes_on("")) return false;
  add_row(town, "warm", gap, race, table);
  return true;
}

traffic::TrafficNetwork passable(const traffic::TrafficNetwork& network) {
  std::vector<traffic::TrafficNode> nodes;
  std::vector<traffic::TrafficLink> links;
  for (std::uint32_t n = 0; n < network.node_count(); ++n) nodes.push_back({network.node(n).id, true});
  for (std::uint32_t l = 0; l < network.link_count(); ++l) links.push_back(network.link(l));
  return *traffic::TrafficNetwork::make(std::move(nodes), std::move(links));  // a part of one that could be made
}

using Graph = boost::compressed_sparse_row_graph<boost::directedS>;

// All labels from every node where trips begin, without traffic. Both know the costs by link as an array. Boost knows no nodes
// that let nothing through, so that there are none here.
bool measure_paths(const SolverBench& bench, const Town& town, BenchTable& table) {
  const traffic::TrafficNetwork network = passable(town.network);
  std::vector<std::uint32_t> origins;
  for (const traffic::TripDemand& demand : town.demands)
    if (origins.empty() || origins.back() != demand.origin) origins.push_back(demand.origin);
  const std::size_t count = network.node_count();
  if (count == 0) return true;
  std::vector<double> costs, by_edge;
  std::vector<std::pair<std::size_t, std::size_t>> edges;
  for (std::uint32_t l = 0; l < network.link_count(); ++l) costs.push_back(network.cost(l, 0));
  for (std::uint32_t n = 0; n < count; ++n)
    for (const std::uint32_t l : network.out_links(n)) {
      edges.emplace_back(n, network.to(l));
      by_edge.push_back(costs[l]);
    }
  const Graph graph(boost::edges_are_sorted, edges.begin(), edges.end(), count);
  traffic::ShortestPaths paths(network);
  std::vector<double> labels(count), sums(2);
  Hash hash;
  std::vector<Contender> contenders;
  contenders.push_back({[&] {
                          sums[0] = 0;
                          hash = Hash();
                          for (const std::uint32_t origin : origins) {
                            paths.run(origin, costs);
                            for (const double label : paths.labels())
                              if (label != traffic::kUnreached) sums[0] += label, hash.add(label);
                          }
                        },
                        {},
                        {}});
  contenders.push_back(
      {[&] {
         sums[1] = 0;
         for (const std::uint32_t origin : origins) {
           boost::dijkstra_shortest_paths(
               graph, origin,
               boost::weight_map(boost::make_iterator_property_map(by_edge.begin(), boost::get(boost::edge_index, graph)))
                   .distance_map(boost::make_iterator_property_map(labels.begin(), boost::get(boost::vertex_index, graph))));
           for (const double label : labels)
             if (label != std::numeric_limits<double>::max()) sums[1] += label;
         }
       },
       {},
       {}});
  take_turns(contenders, bench.rounds, bench.turn_seconds, [&] { return bench.goes_on("ways in " + town.name); });
  if (!bench.goes_on("")) return false;
  const double trees = static_cast<double>(origins.size());
  const double ours = contenders[0].median.of(1) / trees, boost_time = contenders[1].median.of(1) / trees;
  table.add({word(town.name), figure(count), figure(network.link_count()), figure(origins.size()), figure(1e6 * ours, 2),
             figure(1e6 * boost_time, 2), figure(boost_time / ours, 2),
             word(std::abs(sums[0] - sums[1]) <= 1e-9 * sums[0] ? "yes" : "no"), word(hash.hex())});
  return true;
}

}  // namespace

BenchTables bench_traffic(const SolverBench& bench) {
  const auto towns = towns_of(bench);
  if (!towns) return towns.error();
  BenchTable equilibria = assignments();
  BenchTable ways{"ways",
                  "Shortest ways from a node to all others, against Boost.Graph's Dijkstra on a compressed graph; all nodes let "
                  "people through",
                  {{"network", "network", true},
                   {"nodes", "nodes"},
                   {"links", "links"},
                   {"trees", "trees"},
                   {"µs/tree", "microseconds"},
                   {"Boost µs/tree", "peer_microseconds"},
                   {"times", "times_the_peer"},
                   {"same", "same", true},
                   {"hash", "hash", true}}};
  bool goes_on = true;
  for (const Town& town : *towns) {
    for (const double gap : {1e-4, 1e-6}) goes_on = goes_on && measure_cold(bench, town, gap, equilibria);
    goes_on = goes_on && measure_warm(bench, town, 1e-4, equilibria) && measure_paths(bench, town, ways);
  }
  if (!goes_on) return Error{ErrorCode::cancelled, "", "stopped"};
  auto districts = bench_districts(bench);
  if (!districts) return districts.error();
  return std::vector<BenchTable>{equilibria, ways, *districts};
}

}  // namespace bl::cli::bench
