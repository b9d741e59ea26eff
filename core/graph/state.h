// The running state S(t), which every view reads. Immutable once published.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/define/link_remark.h"
#include "core/graph/analysis.h"
#include "core/graph/plan.h"

namespace bl {

struct TypeState {
  std::vector<Value> values;    ///< effective and computed values, in the order of the declaration
  std::vector<double> tension;  ///< per port, in its unit: how far the proposals disagree with the effective value
  std::optional<Error> error;   ///< the error of the last evaluation, if it failed; the values are then the last good ones
  bool is_evaluated = false;    ///< the computed values follow from the settings beside them
};

struct NodeState {
  std::vector<TypeState> types;
};

/// The proposal of one link for one port in this tick, combined over all of its pairs.
struct Voice {
  PortRef target;
  Value value;           ///< a change for `sum` ports, a wanted value for the others
  double magnitude = 0;  ///< for `sum` ports: the mean length of the changes that its pairs propose
  double strength = 1;
};

struct LinkState {
  std::vector<Voice> voices;         ///< ascending target
  std::optional<Error> error;        ///< why it did not run (last good value proposals are kept), or its remark on a rule
                                     ///< or on an unmet demand, although it ran
  std::optional<LinkRemark> remark;  ///< set where `error` is a remark: the voices are of this tick
  std::optional<Error> work;         ///< a rule that is not kept yet, but being worked on

  bool has_failed() const { return error.has_value() && !remark; }
};

/// The progress of an analysis beside the loop.
struct AnalysisState {
  std::int64_t as_of = -1;            ///< the last tick whose data the outputs belong to; -1: no result yet
  std::int64_t taken = -1;            ///< the tick in which the last result was taken in
  std::uint64_t inputs = 0;           ///< hash of the data that the outputs follow from
  std::int64_t begun = -1, due = -1;  ///< ticks of the one that is running
  std::uint64_t running_inputs = 0;
  std::shared_ptr<Analysis> running;  ///< nullptr where none is
};

struct State {
  std::int64_t tick = 0;
  std::shared_ptr<const Plan> plan;
  std::vector<NodeState> nodes;         ///< as plan->nodes
  std::vector<LinkState> links;         ///< as plan->links
  std::vector<AnalysisState> analyses;  ///< as plan->analyses
  std::int64_t calm = 0;                ///< ticks in a row in which nothing much moved, and all demands and rules were met
  double largest_move = 0;              ///< [m] of this tick
  double largest_change = 0;            ///< of this tick, of any number that links choose, as a share of itself
  PortRef restless;                     ///< the port with that change
  double largest_residual = 0;          ///< over all residual ports
  std::uint64_t hash = 0;

  /// Calm for long enough, and every analysis has seen the calm state.
  bool is_settled() const;
  const Value& value(PortRef ref) const {
    return ref.type == PortRef::kNodeId ? plan->nodes[ref.node].id_value : nodes[ref.node].types[ref.type].values[ref.port];
  }
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

/// The hash of everything that the next tick depends on: values, failures, proposals, the calm count, the tick.
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
/// The parts of `old` that still fit a new plan; `placed` ports start again from their set values.
State carry(const State& old, std::shared_ptr<const Plan> plan, const std::set<std::pair<std::string, std::string>>& placed);
/// The initial state with the values of a saved one. Values for unknown nodes or ports are errors with a place.
Result<State> restore(const SavedState& saved, std::shared_ptr<const Plan> plan);

}  // namespace bl
