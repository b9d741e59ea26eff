// Reach from a place: travel times, the parts of streets within a time, and accessibility.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/traffic/network.h"

namespace bl::traffic {

/// What a walk costs on each link: at one speed along its length [m, m/s].
std::vector<double> walking_costs(const TrafficNetwork& network, double speed);

/// Least costs from a node to all nodes; kUnreached where no open way leads.
std::vector<double> travel_costs(const TrafficNetwork& network, std::uint32_t from, std::span<const double> costs);

/// How long the cheapest ways from a node take, where `costs` hold more than time: `labels` are the least costs from it, as of
/// travel_costs(). Of several ways that cost the same the quickest counts.
std::vector<double> times_along(const TrafficNetwork& network, std::uint32_t from, std::span<const double> labels,
                                std::span<const double> costs, std::span<const double> times);

/// The first part of a link that is reached within a limit: the share of its length from where it begins.
struct ReachedLink {
  std::uint32_t link = 0;
  double share = 0;
};
/// The isochrone as streets: ascending links, those out of reach left out. `at_nodes` as from travel_costs().
std::vector<ReachedLink> reached_links(const TrafficNetwork& network, std::uint32_t from, std::span<const double> at_nodes,
                                       std::span<const double> costs, double limit);

/// What can be reached, less the farther it is: the sum of amount · exp(-cost / fade) (Hansen 1959, with the exponential
/// decay). What is out of reach counts as nothing.
double accessibility(std::span<const double> costs, std::span<const double> amounts, double fade);

}  // namespace bl::traffic
