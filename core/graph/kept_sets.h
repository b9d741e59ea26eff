// What phase 6 keeps of sets from tick to tick, so that members which are as they were are neither read nor answered again.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/graph/state.h"

namespace bl {

/// The sets of one typification as they were read last. It is no state: with an empty one, every tick comes to the same bits.
class KeptSets {
 public:
  /// Reads the members that may differ from those that were read last, or all of them where nothing is known or wanted of the
  /// last evaluation. The values are valid until the next call.
  std::span<SetValues> read(const StateDraft& draft, const SetGroup& group, bool is_anew);
  /// Once everything is written of the tick in which the sets were read. `is_complete`: all replies have arrived; else the next
  /// evaluation starts anew.
  void note_written(const StateDraft& draft, const SetGroup& group, bool is_complete);

 private:
  void read_all(const StateDraft& draft, std::span<const SetPlan> plans);
  std::vector<std::uint32_t> may_differ(const StateDraft& draft) const;

  struct Seen {
    std::shared_ptr<const NodeState> node;  ///< as it was when all was written; held, so that no other one gets its address
    bool may_differ = false;                ///< from what was read: it was written to afterwards
  };

  std::shared_ptr<const SetDependents> structure_;  ///< of the plans that have these sets
  std::vector<SetValues> sets_;
  std::vector<std::vector<Seen>> seen_;  ///< by set and member
  NodeStates nodes_;                     ///< of the state that the tick of the last reading went out from
  std::vector<std::uint32_t> written_;   ///< nodes that this tick has written to; ascending
  bool is_complete_ = false;
};

/// What typifications with sets keep from tick to tick; no state.
struct SetMemo {
  Memo own;  ///< of the evaluation
  KeptSets sets;
};
/// By node and type id.
using SetMemos = std::map<std::pair<std::string, std::string>, SetMemo>;

/// The sets of a group in their order.
std::span<const SetPlan> sets_of(const Plan& plan, const SetGroup& group);
/// All members of a set, read anew.
SetValues read_set(const StateDraft& draft, const SetPlan& plan);

}  // namespace bl
