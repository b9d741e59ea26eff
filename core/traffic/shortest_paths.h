// Shortest paths from one node over link costs: labels and the link by which each node is reached.
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "core/traffic/network.h"

namespace bl::traffic {

inline constexpr double kUnreached = std::numeric_limits<double>::infinity();

/// Nodes by their labels, the smallest first and the lower index among equals: a heap of four children to each parent, which
/// knows where a node stands, so that a label can fall.
class NodeHeap {
 public:
  explicit NodeHeap(std::size_t nodes) : place_(nodes, kNoTrafficIndex) {}
  bool is_empty() const { return heap_.empty(); }
  /// Puts a node in, or moves it up after its label has fallen.
  void push(std::uint32_t node, std::span<const double> labels);
  std::uint32_t pop(std::span<const double> labels);

 private:
  void rise(std::size_t at, std::span<const double> labels);
  void sink(std::size_t at, std::span<const double> labels);

  std::vector<std::uint32_t> heap_, place_;
};

/// Dijkstra's algorithm with memory that is used again; one object for one thread.
class ShortestPaths {
 public:
  explicit ShortestPaths(const TrafficNetwork& network);

  /// Labels of all nodes from `origin`; links that are closed, and nodes that let nothing through, are minded.
  void run(std::uint32_t origin, std::span<const double> costs);
  /// The same result from labels that are lengths of real paths already (or kUnreached): only what is too long is mended.
  /// `last_links`: of those paths, one for each node, and mended as well; nothing where nobody needs them. Labels are the very
  /// same numbers as those of run(), because rounding never makes a longer way the shorter one; among equals the links may
  /// differ.
  void mend(std::uint32_t origin, std::span<const double> costs, std::span<double> labels,
            std::span<std::uint32_t> last_links = {});

  std::span<const double> labels() const { return labels_; }
  /// The last link of the path to a node; kNoTrafficIndex at the origin and where nothing leads. Only after run().
  std::span<const std::uint32_t> last_links() const { return last_links_; }

 private:
  template <class Push>
  void relax(std::uint32_t node, std::span<const double> costs, std::span<double> labels, std::span<std::uint32_t> last_links,
             Push&& push);

  const TrafficNetwork* network_;
  NodeHeap heap_;
  std::vector<double> labels_;
  std::vector<std::uint32_t> last_links_, queue_;
  std::vector<std::uint8_t> is_waiting_;
};

}  // namespace bl::traffic
