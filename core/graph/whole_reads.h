// Keeps what a link reads of whole ends from tick to tick, so that what has changed at one node costs no look at all others.
#pragma once

#include "core/define/definition.h"
#include "core/graph/state.h"

namespace bl {

/// It is no state: a new one reads the same values.
class WholeReads {
 public:
  /// Knows the values of this state, of a plan with the same links as the last one. False where no end is whole.
  bool follow(const State& frozen, const LinkPlan& plan);
  /// By declared read; the pair fills in what it reads of ends that are not whole. Of whole ends, the values stay valid until
  /// the next call of follow().
  LinkReads& reads() { return reads_; }

 private:
  void read_all(const State& frozen, const LinkPlan& plan);
  void read_changes(const State& frozen, const LinkPlan& plan);

  bool is_known_ = false, has_whole_ = false;
  LinkReads reads_;
  LoadedEnds loaded_;
  NodeStates nodes_;                  // as they were read last; they keep the values alive
  SharedItems<NodePlan> node_plans_;  // and these the ids
};

}  // namespace bl
