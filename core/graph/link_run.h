// One link asked about its pairs: reads the frozen state, collects proposals, failures and remarks.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/graph/collected.h"
#include "core/graph/state.h"

namespace bl {

/// What a link goes on to want, as loud as people want it now.
Voice held_voice(const Voice& voice, const LinkPlan& plan);

/// Where a node stands among the nodes of an end, which ascend; nothing where it is none of them.
std::optional<std::uint32_t> place_in(const std::vector<std::uint32_t>& nodes, std::uint32_t node);

/// What a link reads there: the value, or whether people have locked it; nullptr where an optional port is lacking.
const Value* value_read(const State& frozen, const LinkRead& read, PortRef ref);

class LinkRun {
 public:
  /// Of pairs that speak to any target. `whole`: what is kept of whole ends, or nullptr.
  LinkRun(const State& frozen, const LinkPlan& plan, LinkReads* whole);
  /// Of pairs of which only what they say to some targets counts: `targets` are their indices, ascending, at least one.
  LinkRun(const State& frozen, const LinkPlan& plan, std::vector<std::uint32_t> targets);

  /// Every pair once; an end that is read whole takes part in one evaluation for all of its nodes. A pair that fails does not
  /// stop the others, unless the link as a whole has used up what it may.
  void run(const Tick& tick);
  /// The pair of the nodes at these places of the two ends, if it counts: no node pairs with itself, and of a set with itself
  /// each unordered pair counts once.
  void run_pair(std::size_t f, std::size_t t, const Tick& tick);

  std::size_t pairs() const { return pairs_; }
  /// What the first pair that failed says, and how many others there are; nothing where all is well.
  std::optional<Error> error() const;
  /// The gravest that a pair has remarked; of several that are as grave the first, and how many others there are.
  LinkRemarks remarks() const;
  /// Ascending, as the targets are. A wanted value of the last good tick stays in force where all that has failed; a push must
  /// not go on for ever.
  std::vector<Voice> voices(const std::vector<Voice>& last);

 private:
  static constexpr std::size_t kNone = ~std::size_t{0};

  LinkRun(const State& frozen, const LinkPlan& plan, std::size_t targets, LinkReads* whole);
  std::size_t count(End end) const { return plan_.nodes[static_cast<int>(end)].size(); }
  // The places of the end that one evaluation of a pair does not take together.
  std::size_t steps(End end) const { return definition_.is_whole(end) ? 1 : count(end); }
  // The place of a target among those that are spoken to, or kNone.
  std::size_t slot_of(std::uint32_t target) const;
  void note(std::size_t f, std::size_t t, const Error& error);
  void note_overflow(PortRef target);
  void hear(const LinkRemarks& remarks);
  void fail(std::size_t f, std::size_t t);
  // A figure that does not follow any more must not be answered to tick by tick.
  bool is_out_of_date(PortRef ref) const;
  Result<void> evaluate(std::size_t f, std::size_t t, const Tick& tick);
  Result<void> read(std::size_t f, std::size_t t);

  const State& frozen_;
  const LinkPlan& plan_;
  const LinkDefinition& definition_;
  bool is_pairwise_ = false;
  LinkReads own_reads_;
  LinkReads* reads_;  // those of whole ends are there already where they are kept
  LinkWrites writes_;
  std::vector<std::uint32_t> targets_;  // the only ones, by index, ascending; empty: all
  std::vector<Collected> collected_;    // by target; empty while no pair has said anything
  std::vector<bool> has_failed_;        // by target: a pair that would have spoken to it
  std::optional<Error> first_error_;
  LinkRemarks remarks_;
  std::size_t failures_ = 0, remarked_ = 0, pairs_ = 0;
  bool is_stopped_ = false;
};

}  // namespace bl
