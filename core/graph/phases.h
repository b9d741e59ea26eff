// The phases of a tick as functions from the frozen state to the next one.
#pragma once

#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/define/definition.h"
#include "core/graph/kept_sets.h"
#include "core/graph/link_memos.h"
#include "core/graph/state.h"
#include "core/graph/tick_times.h"

namespace bl {

/// How much a tick has asked; what has not changed is not asked.
struct TickCounts {
  std::size_t links = 0;          ///< of which pairs were evaluated
  std::size_t pairs = 0;          ///< of all links
  std::size_t nodes = 0;          ///< whose ports were resolved
  std::size_t typifications = 0;  ///< without sets, that were evaluated
  std::size_t sets = 0;           ///< typifications with sets, that were evaluated or looked at
  TickCounts& operator+=(const TickCounts& more) {
    links += more.links, pairs += more.pairs, nodes += more.nodes, typifications += more.typifications, sets += more.sets;
    return *this;
  }
};

/// What a tick does: what the state before it is, what it has changed on the way, and how much had to be asked.
struct TickWork {
  explicit TickWork(const State& before) : frozen(before), next(before) {
    next.state.due = DueWork();
    next.state.due.is_everything = false;
  }

  const State& frozen;
  StateDraft next;
  std::vector<std::uint32_t> spoken_to;  ///< nodes to which other things are proposed than before; ascending after phase 3
  std::vector<PortRef> moved;            ///< ports that phases 4 and 5 have changed; ascending
  bool asks_all = false;                 ///< typifications also where their inputs are the same
  TickCounts counts;
  TickTimes* times = nullptr;  ///< of whoever measures
};

/// Phase 3: every link that is due reads the frozen state and fills its own slot. Parallel over links. Without memos, pairs that
/// are silent are asked as well.
void evaluate_links(TickWork& work, ThreadPool& pool, LinkMemos* memos);
/// Phase 4: per port, proposals combine in ascending link id; then step limit, hard range, locks last. Phase 5: typifications
/// without sets, where an input changed. Both are parallel over the nodes that are due.
void evaluate_nodes(TickWork& work, ThreadPool& pool);
/// What typifications without sets make of their settings where no tick has asked them yet, as far as they keep no memory;
/// whether there were any. For the eye: in a tick, phase 5 does it.
bool evaluate_unasked(StateDraft& draft);
/// Phase 6: typifications with sets; all read what phase 5 left, then all replies are written, in ascending node id. Analyses
/// are begun here, and their results taken in when they are due.
void evaluate_sets(TickWork& work, ThreadPool& pool, SetMemos& memos, AnalysisRunner& runner);
/// Makes the meshes that were not saved with a state, from the values that were.
void recall_meshes(State& state, ThreadPool& pool, SetMemos& memos);
/// Phase 7: residuals, calm count and hash, and what is due in the next tick.
State commit(TickWork&& work);

// What the phases share.

/// The hysteresis of a scene at rest: what is left of moves dies away, and values do not follow the last little. Whoever wants
/// much more than what counts as calm wakes it, and so does whoever edits it.
struct RestLimits {
  bool is_on = false;
  double wakes_at = 0;    ///< a push [m] beyond which rest is over
  double move = 0;        ///< how far a push moves at most while it is not [m]
  double least_move = 0;  ///< shorter moves are not made, at rest or not [m]
  double held_back = 0;   ///< a change, as a share of a value, that is not made
};
RestLimits rest_limits_of(const State& frozen);

/// What a tick changed at one node: what settling looks at.
struct NodeChange {
  double move = 0, change = 0;
  PortRef restless;              ///< the port that has `change`
  bool is_on_its_way = false;    ///< the same voices may change it again
  std::vector<PortRef> unsound;  ///< ports that could not be followed
};
/// What the links of `draft` propose to node `n`, in ascending order of ports, and within a port of links. The voices lie in the
/// draft.
std::vector<const Voice*> voices_at(const StateDraft& draft, std::uint32_t n);
/// Phase 4 of one node: `voices` as above. `node` is its state before.
NodeChange resolve_node(const State& frozen, std::uint32_t n, const RestLimits& rest, std::span<const Voice* const> voices,
                        NodeState& node);
/// Links that spoke to a port which could not be followed say so, and are asked again; each of them may be sound for itself.
void report_overflow(TickWork& work, PortRef port);

/// How many times the move limit a push has to be to wake a scene that rests.
inline constexpr double kWakingPush = 2;

/// Are its own outputs among its inputs, as those of a filter? Then it has to be asked once a tick only, and again while these
/// change.
bool keeps_memory(const TypificationDefinition& definition);
/// Does its result follow from its settings alone, and neither from the time nor from what it remembers?
bool is_only_now(const TypificationDefinition& definition);
/// The number of the tick for a type that declares to read it, Tick::kUnknown for others.
std::int64_t tick_for(const TypeDefinition& definition, std::int64_t tick);
/// Where errors of a typification of a node stand: "nodes/tower/smart_volume".
std::string place_of(const Plan& plan, std::size_t n, std::size_t t);
/// Takes over what an evaluation wrote, or keeps the last good values and the error.
void accept_values(const TypificationDefinition& definition, TypeState& state, std::vector<Value>&& values, Result<void> done,
                   const std::string& place);

}  // namespace bl
