// Blocks of a sampling grid, each with the sites that may own something in it.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "core/geometry/inside/line_sums.h"

namespace bl::geometry {

struct LineBlock {
  std::array<int, 3> low{}, high{};  ///< steps [low, high) along each axis
  int size(std::size_t k) const { return high[k] - low[k]; }
};

/// Goes down from a block to blocks no wider than `leaf` steps (along the axes that are `split`), or owned by one site. Of the
/// sites of the block above those stay whose least distance to the block is no more than the least of all greatest distances:
/// the metrics grow with the distance, so no owner is missed, however heavy and far away it is.
template <Metric M>
class BlockDescent {
 public:
  BlockDescent(const SampleFrame& frame, std::span<const FrameSite> sites, std::array<bool, 3> split, int leaf)
      : frame_(frame), sites_(sites), split_(split), leaf_(leaf) {}

  /// Calls visit(block, candidates) for the blocks at the end.
  template <class Visit>
  void go_down(const LineBlock& block, std::span<const std::uint32_t> above, Visit&& visit) const {
    std::vector<std::uint32_t> candidates;
    filter(block, above, candidates);
    if (candidates.empty()) return;
    std::size_t widest = 3;
    for (std::size_t k = 0; k < 3; ++k) {
      if (split_[k] && block.size(k) > leaf_ && (widest == 3 || block.size(k) > block.size(widest))) widest = k;
    }
    if (widest == 3 || candidates.size() == 1) return visit(block, std::span<const std::uint32_t>(candidates));
    LineBlock lower = block, upper = block;
    lower.high[widest] = upper.low[widest] = block.low[widest] + block.size(widest) / 2;
    go_down(lower, candidates, visit);
    go_down(upper, candidates, visit);
  }

 private:
  void filter(const LineBlock& block, std::span<const std::uint32_t> above, std::vector<std::uint32_t>& out) const {
    if (above.size() <= 1) return out.assign(above.begin(), above.end());
    std::array<double, 3> low{}, high{};
    for (std::size_t k = 0; k < 3; ++k) {
      low[k] = frame_.low[k] + block.low[k] * frame_.step;
      high[k] = frame_.low[k] + block.high[k] * frame_.step;
    }
    std::vector<double> nearest;
    nearest.reserve(above.size());
    double bound = std::numeric_limits<double>::infinity();
    for (const std::uint32_t site : above) {
      const FrameSite& s = sites_[site];
      double least = 0, most = 0;
      for (std::size_t k = 0; k < 3; ++k) {
        const double below = low[k] - s.at[k], beyond = s.at[k] - high[k];
        const double gap = std::max({0.0, below, beyond}), far = std::max(-below, -beyond);
        least += gap * gap;
        most += far * far;
      }
      nearest.push_back(closeness<M>(least, s.weight, s.radius));
      bound = std::min(bound, closeness<M>(most, s.weight, s.radius));
    }
    bound += 1e-12 * std::abs(bound);  // ties stay
    for (std::size_t i = 0; i < above.size(); ++i) {
      if (nearest[i] <= bound) out.push_back(above[i]);
    }
  }

  const SampleFrame& frame_;
  std::span<const FrameSite> sites_;
  std::array<bool, 3> split_;
  int leaf_;
};

/// A block that one thread works through at a time.
struct LineTask {
  LineBlock block;
  std::vector<std::uint32_t> candidates;  ///< ascending

  std::size_t place_of(std::uint32_t site) const {
    return static_cast<std::size_t>(std::lower_bound(candidates.begin(), candidates.end(), site) - candidates.begin());
  }
  /// Of the lines along axis 2.
  std::size_t line_number(int u, int v) const {
    return static_cast<std::size_t>(v - block.low[1]) * static_cast<std::size_t>(block.size(0)) +
           static_cast<std::size_t>(u - block.low[0]);
  }
  std::size_t line_count() const { return static_cast<std::size_t>(block.size(0)) * static_cast<std::size_t>(block.size(1)); }
};

/// Blocks of about equal size, and far more of them than threads; they depend on the grid and the sites alone.
template <Metric M>
std::vector<LineTask> tasks_of(const SampleFrame& frame, std::span<const FrameSite> sites,
                               std::span<const std::uint32_t> participants, std::array<bool, 3> split) {
  int longest = 1;
  LineBlock whole;
  for (std::size_t k = 0; k < 3; ++k) {
    whole.high[k] = frame.count[k];
    if (split[k]) longest = std::max(longest, frame.count[k]);
  }
  std::vector<LineTask> tasks;
  BlockDescent<M>(frame, sites, split, std::max(8, longest / 8))
      .go_down(whole, participants, [&](const LineBlock& block, std::span<const std::uint32_t> candidates) {
        tasks.push_back({block, {candidates.begin(), candidates.end()}});
      });
  return tasks;
}

}  // namespace bl::geometry
