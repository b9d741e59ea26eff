// States put away: what a state consists of beyond its settings, without what can be made again.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "core/graph/state.h"

namespace bl {

/// Values in little room: numbers and points as bits, all else as it is.
class PackedValues {
 public:
  void add(const Value& value);
  std::size_t size() const { return kinds_.size(); }
  std::vector<Value> values() const;
  std::size_t bytes() const;

 private:
  enum class Kind : std::uint8_t { number, point, other };
  std::vector<Kind> kinds_;
  std::vector<double> numbers_;
  std::vector<Value> others_;
};

/// What goes into a file of a state, in a form that is quick to make and small: meshes and made objects are not in it. Packed states
/// that follow one another share what has not changed.
class PackedState {
 public:
  /// `before`: an earlier state and what was packed of it; both nullptr where there is none.
  PackedState(const State& state, const State* before, const PackedState* packed_before);

  std::int64_t tick() const { return tick_; }
  const std::shared_ptr<const Plan>& plan() const { return plan_; }
  /// As save() gives it, but for the analyses.
  SavedState saved() const;
  /// Also those that were running: their results are the same whenever they are asked for.
  const std::vector<AnalysisState>& analyses() const { return analyses_; }
  /// About how much memory it takes that none before it takes.
  std::size_t bytes() const { return bytes_; }

 private:
  struct Failure {
    std::uint32_t item = 0, type = 0;
    Error error;
  };
  // Of the nodes or links of one leaf.
  struct Leaf {
    std::vector<PortRef> ports;
    std::vector<std::uint32_t> links;  // whose voices they are
    PackedValues values;
    std::vector<Failure> failures;
    std::size_t bytes() const;
  };
  using Leaves = std::vector<std::shared_ptr<const Leaf>>;

  static Leaf packed_nodes(const State& state, std::size_t leaf);
  static Leaf packed_links(const State& state, std::size_t leaf);
  void keep(Leaves& leaves, Leaf&& leaf);

  std::int64_t tick_ = 0, calm_ = 0;
  std::shared_ptr<const Plan> plan_;
  Leaves nodes_, links_;
  std::vector<std::pair<PortRef, MeshPointer>> meshes_;  // that cannot be made again
  std::vector<AnalysisState> analyses_;
  std::size_t bytes_ = 0;
};

}  // namespace bl
