// The running state S(t), which every view reads. Immutable once published.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/base/shared_list.h"
#include "core/define/link_remark.h"
#include "core/graph/analysis.h"
#include "core/graph/plan.h"
#include "core/graph/tensions.h"

namespace bl {

struct TypeState {
  TypeState() = default;
  TypeState(const TypeState& other)
      : values(copied(other.values)), tension(other.tension), error(other.error), is_evaluated(other.is_evaluated) {}
  TypeState(TypeState&&) = default;
  TypeState& operator=(const TypeState&) = default;
  TypeState& operator=(TypeState&&) = default;
  ~TypeState() = default;

  std::vector<Value> values;   ///< effective and computed values, in the order of the declaration
  Tensions tension;            ///< per port, in its unit: how far the proposals disagree with the effective value
  std::optional<Error> error;  ///< the error of the last evaluation, if it failed; the values are then the last good ones
  bool is_evaluated = false;   ///< the computed values follow from the settings beside them
};

struct NodeState {
  std::vector<TypeState> types;
  // What it comes to: made when the state is published.
  std::uint64_t hash = 0;    ///< of everything in it that the next tick depends on
  double residual = 0;       ///< the largest of its residual ports
  bool has_failure = false;  ///< one of its typifications fails
};

/// What a leaf of nodes comes to.
struct NodeDigest {
  std::uint64_t hash = 0;    ///< of the hashes of its nodes
  double residual = 0;       ///< the largest of all residual ports
  bool has_failure = false;  ///< a typification fails
};

/// What one link says about one port in this tick, all of its pairs together.
struct Voice {
  PortRef target;
  Value value;           ///< a change for `sum` ports, a wanted value for the others
  double magnitude = 0;  ///< for `sum` ports: the mean length of the changes that its pairs propose
  double strength = 1;
  bool operator==(const Voice&) const = default;
};

struct LinkState {
  std::vector<Voice> voices;         ///< ascending target
  std::optional<Error> error;        ///< why it did not run (last good value proposals are kept), or its remark on a rule
                                     ///< or on an unmet demand, although it ran
  std::optional<LinkRemark> remark;  ///< set where `error` is a remark: the voices are of this tick
  std::optional<Error> work;         ///< a rule that is not kept yet, but being worked on
  bool is_stuck = false;             ///< in vain: nothing changes any more, and `error` says so
  std::uint64_t hash = 0;            ///< of the voices that stay in force if it fails; made when the state is published

  bool has_failed() const { return error.has_value() && !remark; }
  /// Of what it says, whether its hash has been made or not.
  bool says_the_same(const LinkState& other) const {
    return voices == other.voices && error == other.error && remark == other.remark && work == other.work &&
           is_stuck == other.is_stuck;
  }
};

/// What a leaf of links comes to; links that do not count have no part in it.
struct LinkDigest {
  std::uint64_t hash = 0;    ///< of the hashes of its links
  bool has_failure = false;  ///< a link does not do what it should, for another reason than that somebody goes short
  bool is_at_work = false;   ///< a link is still bringing a rule about
  bool is_stuck = false;     ///< a link does so in vain
};

using NodeStates = SharedList<NodeState, NodeDigest>;
using LinkStates = SharedList<LinkState, LinkDigest>;

/// Calls visit(n) for each node that two lists of the same nodes do not share, in ascending order.
template <class Visit>
void each_difference(const NodeStates& before, const NodeStates& after, const Visit& visit) {
  for (std::uint32_t n = 0; n < after.size(); ++n) {
    if (n % NodeStates::kLeaf == 0 && before.shares_leaf(after, n / NodeStates::kLeaf)) n += NodeStates::kLeaf - 1;
    else if (before.item(n) != after.item(n)) visit(n);
  }
}

/// How far an analysis beside the loop has come.
struct AnalysisState {
  std::int64_t as_of = -1;            ///< the last tick whose data the outputs belong to; -1: no result yet
  std::int64_t taken = -1;            ///< the tick in which the last result was taken in
  std::uint64_t inputs = 0;           ///< hash of the data that the outputs follow from
  std::int64_t begun = -1, due = -1;  ///< ticks of the one that is running
  std::uint64_t running_inputs = 0;
  std::shared_ptr<Analysis> running;  ///< nullptr where none is
  /// Hash of the data as it was looked at last; nothing where it may have changed since. No part of the result.
  std::optional<std::uint64_t> seen;
};

/// A point before it changed.
struct PointBefore {
  PortRef port;
  Point3 at;
};

/// What the next tick has to look at because it may come out differently than in this one. It is no part of the result: with
/// everything due, the next state is the same.
struct DueWork {
  bool is_everything = true;
  std::vector<PortRef> changed;      ///< ports that differ from the state before: links that read them run. Ascending.
  std::vector<PointBefore> were;     ///< the points among them, as the links have read them last. Ascending.
  std::vector<PortRef> replied;      ///< ports that sets wrote, after the sets had read: those that read them run. Ascending.
  std::vector<std::uint32_t> nodes;  ///< whose ports are still on their way, or were set by people. Ascending.
  std::vector<std::uint32_t> links;  ///< that have to be asked again whatever they read. Ascending.
  bool was_at_rest = false;          ///< when proposals were resolved last

  bool is_nothing() const { return !is_everything && changed.empty() && replied.empty() && nodes.empty() && links.empty(); }
};

struct State {
  std::int64_t tick = 0;
  std::shared_ptr<const Plan> plan;
  NodeStates nodes;                     ///< as plan->nodes
  LinkStates links;                     ///< as plan->links
  std::vector<AnalysisState> analyses;  ///< as plan->analyses
  std::int64_t calm = 0;                ///< ticks in a row in which nothing much moved, and all demands and rules were met
  double largest_move = 0;              ///< [m] of this tick
  double largest_change = 0;            ///< of this tick, of any number that links choose, as a share of itself
  PortRef restless;                     ///< the port with that change
  double largest_residual = 0;          ///< over all residual ports
  std::uint64_t hash = 0;
  DueWork due;

  /// Calm for long enough, and every analysis has seen the calm state.
  bool is_settled() const;
  const Value& value(PortRef ref) const {
    return ref.type == PortRef::kNodeId ? plan->nodes[ref.node].id_value : nodes[ref.node].types[ref.type].values[ref.port];
  }
};

/// A state that is being made out of another one: nodes and links are edited in their drafts, all else in `state`.
struct StateDraft {
  explicit StateDraft(const State& base) : state(base), nodes(base.nodes), links(base.links) {}
  StateDraft(State&& rest, std::vector<NodeState>&& all_nodes, std::vector<LinkState>&& all_links)
      : state(std::move(rest)), nodes(std::move(all_nodes)), links(std::move(all_links)) {}

  State state;  ///< its lists are those that the drafts came from
  NodeStates::Draft nodes;
  LinkStates::Draft links;

  const Value& value(PortRef ref) const {
    return ref.type == PortRef::kNodeId ? state.plan->nodes[ref.node].id_value : nodes[ref.node].types[ref.type].values[ref.port];
  }
  Value& edit(PortRef ref) { return nodes.edit(ref.node).types[ref.type].values[ref.port]; }
  TypeState& edit(std::uint32_t node, std::uint32_t type) { return nodes.edit(node).types[type]; }
  /// The lists with what was edited; the hash is still that of the state before.
  State publish() &&;
};

/// The largest value of all ports that are residuals.
double largest_residual_of(const State& state);
/// Does anything prevent settling: a node that fails, a link that should run and does not, or a rule that cannot be kept? Links
/// of unknown kinds and remarks on unmet demands do not prevent it.
std::optional<Error> first_failure(const State& state);
bool has_failure(const State& state);
/// Is a link still working on a rule?
std::optional<Error> first_work(const State& state);
/// Does this link count, and is it still working on a rule?
bool is_at_work(const State& state, std::size_t link);
/// Has the state been calm for long enough? Remaining moves are then damped, and only a proposal above the limit of calm starts
/// the scene again.
bool is_at_rest(const State& state);

/// Would the proposal stay in force if its link failed in the next tick? A repeated change must not continue without its link.
bool is_lasting(const State& state, const Voice& voice);

/// How state hashes are made. Files that hold hashes name it: hashes of different schemes cannot be compared.
/// 1: all values one after the other. 2: a tree of fixed form, over nodes, over links, and leaves of 32 of them. 3: such a
/// tree with leaves of 16; exact solvers name the problem of their last step by a hash that is made site by site,
/// so that a state saved before begins its next step anew.
inline constexpr int kHashScheme = 3;
/// The hash of everything that the next tick depends on: values, failures, proposals in force, the calm count, the tick. It is
/// made of the hashes of the leaves.
std::uint64_t hash_of(const State& state);

/// An analysis as files keep it. A running analysis is finished first; its result depends on its input only.
struct SavedAnalysis {
  std::int64_t as_of = -1, taken = -1, begun = -1, due = -1;  ///< due is -1 where none was running
  std::uint64_t inputs = 0, running_inputs = 0;
  AnalysisResult result;  ///< of the one that was running
};

/// The proposal of a link for a port, with names.
struct SavedVoice {
  std::string node, path;  ///< "typification.port"
  Value value;
};

/// A running state as a scene file keeps it; ports are named "typification.port".
struct SavedState {
  std::int64_t tick = 0, calm = 0;
  std::map<std::string, std::map<std::string, Value>> nodes;              ///< by node and port; meshes are not among them
  std::map<std::string, std::vector<SavedVoice>> voices;                  ///< by link: proposals that would outlast a failure
  std::map<std::pair<std::string, std::string>, Error> errors;            ///< by node and typification; links read failures
  std::map<std::string, Error> link_errors;                               ///< by link, besides those of the plan
  std::map<std::pair<std::string, std::string>, SavedAnalysis> analyses;  ///< by node and typification
  /// By node and port: meshes of solvers that fail now. All other meshes follow from the values.
  std::map<std::pair<std::string, std::string>, MeshPointer> meshes;
};
SavedState save(const State& state);

/// A state for `plan` at tick 0: settings as set, computed values at their defaults.
State initial_state(std::shared_ptr<const Plan> plan);
/// A saved state put over the initial one. Values for nodes or ports that are not there are errors with a place.
Result<State> restore(const SavedState& saved, std::shared_ptr<const Plan> plan);

}  // namespace bl
