// Isochrones and accessibility from shortest paths.
#include "core/traffic/reach.h"

#include <algorithm>
#include <cmath>

#include "core/traffic/shortest_paths.h"

namespace bl {

std::vector<double> walking_costs(const TrafficNetwork& network, double speed) {
  std::vector<double> costs;
  for (std::uint32_t l = 0; l < network.link_count(); ++l) costs.push_back(network.link(l).length / speed);
  return costs;
}

std::vector<double> travel_costs(const TrafficNetwork& network, std::uint32_t from, std::span<const double> costs) {
  ShortestPaths paths(network);
  paths.run(from, costs);
  return {paths.labels().begin(), paths.labels().end()};
}

std::vector<ReachedLink> reached_links(const TrafficNetwork& network, std::uint32_t from, std::span<const double> at_nodes,
                                       std::span<const double> costs, double limit) {
  std::vector<ReachedLink> reached;
  for (std::uint32_t l = 0; l < network.link_count(); ++l) {
    const double begin = at_nodes[network.from(l)];
    if (!network.is_open(l) || !(begin < limit)) continue;
    if (network.from(l) != from && !network.is_through(network.from(l))) continue;
    reached.push_back({l, costs[l] > 0 ? std::min(1.0, (limit - begin) / costs[l]) : 1});
  }
  return reached;
}

double accessibility(std::span<const double> costs, std::span<const double> amounts, double fade) {
  double sum = 0;
  for (std::size_t i = 0; i < costs.size(); ++i)
    if (std::isfinite(costs[i])) sum += amounts[i] * std::exp(-costs[i] / fade);
  return sum;
}

}  // namespace bl
