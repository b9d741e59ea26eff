// Isochrones and accessibility from shortest paths.
#include "core/traffic/reach.h"

#include <algorithm>
#include <cmath>

#include "core/base/mathematics.h"
#include "core/traffic/shortest_paths.h"

namespace bl::traffic {

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

// A search by time among the links of cheapest ways alone.
std::vector<double> times_along(const TrafficNetwork& network, std::uint32_t from, std::span<const double> labels,
                                std::span<const double> costs, std::span<const double> times) {
  std::vector<double> along(network.node_count(), kUnreached);
  NodeHeap heap(network.node_count());
  along[from] = 0;
  heap.push(from, along);
  while (!heap.is_empty()) {
    const std::uint32_t i = heap.pop(along);
    if (i != from && !network.is_through(i)) continue;
    for (const std::uint32_t l : network.out_links(i)) {
      const std::uint32_t j = network.to(l);
      const bool is_cheapest = network.is_open(l) && labels[i] + costs[l] == labels[j];
      if (!is_cheapest || !(along[i] + times[l] < along[j])) continue;
      along[j] = along[i] + times[l];
      heap.push(j, along);
    }
  }
  return along;
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
    if (std::isfinite(costs[i])) sum += amounts[i] * mathematics::exponential(-costs[i] / fade);
  return sum;
}

}  // namespace bl::traffic
