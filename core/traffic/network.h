// The street network: junctions and directed links with what it costs to use them, as flat arrays for the algorithms.
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "core/base/result.h"

namespace bl::traffic {

/// No node or link of a network.
inline constexpr std::uint32_t kNoTrafficIndex = std::numeric_limits<std::uint32_t>::max();

/// A place where links meet, or a zone where trips begin and end.
struct TrafficNode {
  std::string id;
  bool is_through = true;  ///< false: trips begin and end here, but pass nothing (the first-through-node rule)
};

/// One direction of a street. Time units are those of the data (seconds in scenes); capacity and flow share one unit.
struct TrafficLink {
  std::string id, from, to;
  double free_time = 0;  ///< time at no flow
  double capacity = 0;   ///< flow at which the time has grown by the share `alpha`
  double alpha = 0.15, power = 4;
  double length = 0, toll = 0;
  bool is_open = true;
  double wait = 0;  ///< what the end costs besides, whatever the flow
};

/// What a unit of toll and of length counts in time; both 0: time alone.
struct CostFactors {
  double toll = 0, distance = 0;
};

/// Nodes and links in ascending id, whatever the order they came in: the same network gives the same bits.
/// The cost of a link at flow v is free_time · (1 + alpha · (v / capacity)^power) + toll part + distance part
/// (Bureau of Public Roads 1964, with generalised cost as the TNTP test networks define it). Where the delay exceeds 1e100, or
/// the power itself 1e200, it goes on along its tangent, so that costs stay finite; `is_cut` tells. How a network divides one
/// delay among free time, alpha and capacity makes no difference.
class TrafficNetwork {
 public:
  TrafficNetwork() = default;
  /// Ids twice, ends that are nowhere, and numbers without a sense are errors with the id as their place.
  static Result<TrafficNetwork> make(std::vector<TrafficNode> nodes, std::vector<TrafficLink> links,
                                     const CostFactors& factors = {});

  std::size_t node_count() const { return nodes_.size(); }
  std::size_t link_count() const { return links_.size(); }
  const TrafficNode& node(std::uint32_t index) const { return nodes_[index]; }
  const TrafficLink& link(std::uint32_t index) const { return links_[index]; }
  std::uint32_t node_index(std::string_view id) const;  ///< kNoTrafficIndex where there is none
  std::uint32_t link_index(std::string_view id) const;
  std::uint32_t from(std::uint32_t link) const { return from_[link]; }
  std::uint32_t to(std::uint32_t link) const { return to_[link]; }
  bool is_open(std::uint32_t link) const { return is_open_[link] != 0; }
  bool is_through(std::uint32_t node) const { return is_through_[node] != 0; }
  /// Links that leave a node, ascending.
  std::span<const std::uint32_t> out_links(std::uint32_t node) const {
    return std::span(out_).subspan(out_begin_[node], out_begin_[node + 1] - out_begin_[node]);
  }

  /// Links that lead to a node, ascending.
  std::span<const std::uint32_t> in_links(std::uint32_t node) const {
    return std::span(in_).subspan(in_begin_[node], in_begin_[node + 1] - in_begin_[node]);
  }
  /// The same nodes and links, whatever passing costs: what was a way there is one here.
  bool has_structure_of(const TrafficNetwork& other) const {
    return from_ == other.from_ && to_ == other.to_ && is_open_ == other.is_open_ && is_through_ == other.is_through_;
  }
  /// Does some link cost anything besides time?
  bool has_other_costs() const;

  /// Edits; they keep all indices. A capacity must be above 0: a street without any is closed.
  Result<void> set_capacity(std::uint32_t link, double capacity);
  Result<void> set_free_time(std::uint32_t link, double free_time);
  void set_open(std::uint32_t link, bool is_open) {
    links_[link].is_open = is_open;
    is_open_[link] = is_open ? 1 : 0;
  }

  double cost(std::uint32_t link, double flow) const { return time(link, flow) + fixed_[link]; }
  double time(std::uint32_t link, double flow) const;
  /// How fast the cost grows with the flow.
  double slope(std::uint32_t link, double flow) const;
  /// Both at once, for those who need both.
  struct CostAndSlope {
    double cost = 0, slope = 0;
  };
  CostAndSlope cost_and_slope(std::uint32_t link, double flow) const;
  /// The area under the cost from no flow to this one: the link's part of Beckmann's objective.
  double integral(std::uint32_t link, double flow) const;
  /// Is the cost at this flow less than the formula says, because no number could hold the sums of such costs?
  bool is_cut(std::uint32_t link, double flow) const;

 private:
  // What the delay formula needs of a link, without its texts: costs are asked for more often than anything else.
  struct Delay {
    double least = 0;  // time and wait at no flow
    double scale = 0;  // how much the formula adds at capacity
    double capacity = 0, power = 0;
    double edge = 0;  // the load beyond which the delay goes on along its tangent [capacity]
  };
  static Delay delay_of(const TrafficLink& link);

  std::vector<TrafficNode> nodes_;
  std::vector<TrafficLink> links_;
  std::vector<Delay> delays_;
  std::vector<std::uint32_t> from_, to_, out_, out_begin_, in_, in_begin_;
  std::vector<std::uint8_t> is_open_, is_through_;
  std::vector<double> fixed_;  // toll and distance parts of the cost
};

}  // namespace bl::traffic
