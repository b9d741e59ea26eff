// A bush: all ways that the trips of one origin use, as a set of links without a cycle, with the flow on each.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/traffic/network.h"
#include "core/traffic/shortest_paths.h"

namespace bl::traffic {

/// Trips from one zone to another, per unit of time.
struct TripDemand {
  std::uint32_t origin = 0, destination = 0;
  double trips = 0;
};

/// Flow of one origin on one link: what an equilibrium is saved as.
struct OriginFlow {
  std::uint32_t origin = 0, link = 0;
  double flow = 0;
};

/// The same of one origin for all of its links, each once.
struct BushFlows {
  std::uint32_t origin = 0;
  std::span<const std::uint32_t> links;
  std::span<const double> flows;  ///< as `links`
};

/// Nodes in an order in which every link leads onward; links and flows stand by the node they lead to ("slots").
struct Bush {
  std::uint32_t origin = 0;
  std::vector<TripDemand> demands;        ///< that can be reached, ascending destination
  std::vector<std::uint32_t> order;       ///< the origin first; nodes that nothing leads to are not here
  std::vector<std::uint32_t> slot_begin;  ///< per place in `order`, and one past the end
  std::vector<std::uint32_t> links;       ///< per slot
  std::vector<double> flows;              ///< per slot
};

/// Flow, cost and slope of every link, kept together while flow is shifted.
struct LinkLoads {
  std::vector<double> flows, costs, slopes;

  explicit LinkLoads(const TrafficNetwork& network);
  void set(const TrafficNetwork& network, std::uint32_t link, double flow);
};

/// Works on one bush after the other with memory of its own. The method is Dial's Algorithm B (Transportation Research B 40,
/// 2006): links that shorten the longest way to their end join the bush, unused ones leave it; then flow is shifted from the
/// longest used way to the shortest one by Newton's step, at every node where the two differ.
class BushWorker {
 public:
  explicit BushWorker(const TrafficNetwork& network);

  /// Makes order and slots anew around the links that carry flow (flows by link; 0 elsewhere), with shortest ways to all
  /// others, and spreads the demands over them. What cannot be reached any more is left out of `bush.demands`.
  void plant(Bush& bush, std::span<const TripDemand> demands, std::span<const double> flows, const LinkLoads& loads);
  /// The same around flows that a bush of this origin had before, without a search: `labels` are the shortest ways at `costs`.
  /// Who has no flow hangs on the lowest link of a shortest way. Where flows run in a circle it is plant() that makes the bush.
  void replant(Bush& bush, std::span<const TripDemand> demands, const BushFlows& flows, std::span<const double> labels,
               std::span<const double> costs, const LinkLoads& loads);
  /// Gives every node exactly what leaves it and what ends there, in the shares in which it came; heals rounding as well.
  void balance(Bush& bush);
  /// Drops unused links, adds those that promise a shorter way, and orders the nodes anew.
  void improve(Bush& bush, const LinkLoads& loads);
  /// One sweep of Newton shifts from the farthest node to the origin. Returns the largest share by which the longest used
  /// way to a node was longer than its shortest one, before the shifts.
  double shift(Bush& bush, LinkLoads& loads);
  /// Sum over the bush of flow · (how much longer than the shortest way the link is): 0 or more, exactly.
  double excess(const Bush& bush, const LinkLoads& loads);
  /// The same where the shortest ways are known.
  double excess(const Bush& bush, const LinkLoads& loads, std::span<const double> labels) const;
  /// Labels of the last excess().
  const std::vector<double>& labels() const { return labels_; }

 private:
  void grow(Bush& bush, std::span<const double> flows, const LinkLoads& loads);
  bool release();
  bool put_in_order(Bush& bush, std::size_t reached);
  void hang(std::uint32_t origin, std::span<const double> labels, std::span<const double> costs);
  bool passes(std::uint32_t node, std::uint32_t origin) const { return node == origin || network_->is_through(node); }
  void rebuild(Bush& bush);
  void label(const Bush& bush, const LinkLoads& loads);
  void shift_at(Bush& bush, std::uint32_t node, LinkLoads& loads);

  const TrafficNetwork* network_;
  ShortestPaths paths_;
  NodeHeap heap_;
  std::vector<double> labels_, longest_, node_flow_, link_flow_;
  std::vector<std::uint32_t> place_, short_slot_, long_slot_, pending_;
  std::vector<std::uint8_t> in_bush_;
  std::vector<std::uint32_t> up_short_, up_long_;
  std::vector<std::uint32_t> chosen_, begin_, next_, onward_,
      arrived_;  // of replant(): links of the bush; those that leave each node
  std::vector<double> chosen_flows_;
};

}  // namespace bl::traffic
