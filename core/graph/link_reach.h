// Finds the pairs of a link between sets that may say something, by the places of their nodes.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "core/base/point_grid.h"
#include "core/graph/state.h"

namespace bl {

/// The places of the nodes of one link whose kind says where pairs are silent. It is kept from tick to tick, and is no state: a
/// new one finds the same pairs.
class LinkReach {
 public:
  /// Knows the places of this state, of a plan with the same links as the last one. False where all pairs have to be looked at:
  /// the kind does not say where it is silent, or never is, or there are few pairs.
  bool follow(const State& frozen, const LinkPlan& plan);

  /// A pair as the places of its nodes in the lists of the two ends.
  using Pair = std::pair<std::uint32_t, std::uint32_t>;
  /// Calls visit(f, t) for all pairs that may speak, in the order in which all pairs would come.
  template <class Visit>
  void visit_all(const LinkPlan& plan, const Visit& visit) {
    for (std::uint32_t f = 0; f < plan.nodes[0].size(); ++f) {
      find_partners(End::to, grid(End::from)[f]);
      for (const std::uint32_t t : found_) visit(f, t);
    }
  }
  /// The nodes for which the link may say something else after changes of some nodes: these, and their partners, at their
  /// places now and as they were; ascending. Nothing where these are so many that all pairs are asked as well.
  std::optional<std::vector<std::uint32_t>> concerned(const State& frozen, const LinkPlan& plan,
                                                      std::span<const std::uint32_t> changed);
  /// All pairs of these nodes that may speak, in the order in which all pairs would come.
  std::vector<Pair> pairs_of(const LinkPlan& plan, std::span<const std::uint32_t> nodes);

 private:
  void begin(const State& frozen, const LinkPlan& plan);
  void read_all(const State& frozen, const LinkPlan& plan);
  void read_changes(const State& frozen, const LinkPlan& plan);
  PointGrid& grid(End end) { return grids_[is_symmetric_ ? 0 : static_cast<std::size_t>(end)]; }
  bool is_silent(double squared_distance) const {
    return squared_distance >= least_squared_ && squared_distance <= most_squared_;
  }
  // Into found_: the nodes of an end to which somebody there may speak; ascending.
  void find_partners(End end, const Point3& there);

  bool is_known_ = false, is_useful_ = false, is_symmetric_ = false, in_plan_ = false;
  // Between these distances a pair is silent for sure.
  double least_ = 0, least_squared_ = 0, most_ = 0, most_squared_ = 0;
  NodeStates nodes_;                  // as they were read last
  PointGrid grids_[2];                // by end; the first one alone where both ends are the same nodes
  std::size_t moves_ = 0;             // since the grids were made
  std::vector<std::uint64_t> marks_;  // a bit for each node of an end; all clear between two searches
  std::vector<std::uint32_t> found_;
};

}  // namespace bl
