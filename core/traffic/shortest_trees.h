// Shortest ways from many nodes to all others, kept while costs change: the last ways are measured anew and mended where others
// are shorter now.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/traffic/shortest_paths.h"

namespace bl::traffic {

/// Labels by origin and node. They are those of ShortestPaths::run(), bit for bit, whatever was asked before: what is kept saves
/// work and decides nothing.
class ShortestTrees {
 public:
  ShortestTrees(const TrafficNetwork& network, std::vector<std::uint32_t> origins);

  /// Goes on with the ways found so far where the other network has the structure of the last one, else without them.
  void move_to(const TrafficNetwork& network);
  /// Labels at these costs by link.
  void update(std::span<const double> costs);

  const std::vector<std::uint32_t>& origins() const { return origins_; }
  /// Of the origin at this place in the list.
  std::span<const double> labels(std::size_t place) const { return std::span(labels_).subspan(place * nodes_, nodes_); }
  /// Of an origin by its node; nothing where it is none.
  std::span<const double> labels_of(std::uint32_t origin) const;
  const std::vector<double>& costs() const { return costs_; }

 private:
  void measure(std::size_t place);

  const TrafficNetwork* network_;
  std::vector<std::uint32_t> origins_, place_;  // the latter by node
  std::size_t nodes_ = 0;
  ShortestPaths paths_;
  std::vector<double> costs_, labels_;     // by link; by origin and node
  std::vector<std::uint32_t> last_links_;  // by origin and node
  std::vector<std::uint8_t> is_known_;     // of one origin, while its ways are measured
  std::vector<std::uint32_t> waiting_;
};

}  // namespace bl::traffic
