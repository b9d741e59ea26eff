// Runs the phases of a tick in their order.
#include "core/graph/simulation.h"

#include <algorithm>

#include "core/base/stop_check.h"
#include "core/graph/amend.h"
#include "core/graph/carry.h"

namespace bl {

namespace {

bool plays_role(const Plan& plan, const std::pair<std::string, std::string>& node_and_type) {
  const std::uint32_t node = plan.node_index(node_and_type.first);
  if (node == plan.nodes.size()) return false;
  const std::vector<TypePlan>& types = plan.nodes[node].types;
  return std::any_of(types.begin(), types.end(), [&](const TypePlan& t) { return t.definition->id == node_and_type.second; });
}

bool is_unchanged(const NodeState& a, const NodeState& b) {
  return std::equal(a.types.begin(), a.types.end(), b.types.begin(), b.types.end(), [](const TypeState& x, const TypeState& y) {
    return x.is_evaluated == y.is_evaluated && x.error == y.error && x.tension == y.tension && x.values == y.values;
  });
}

bool is_unchanged(const LinkState& a, const LinkState& b) { return a.says_the_same(b); }

// Looks at what is not shared alone: somebody who was asked may have said the same again.
template <class List>
bool is_unchanged_list(const List& a, const List& b) {
  if (a.size() != b.size()) return false;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (i % List::kLeaf == 0 && a.shares_leaf(b, i / List::kLeaf)) i += List::kLeaf - 1;
    else if (a.item(i) != b.item(i) && !is_unchanged(a[i], b[i])) return false;
  }
  return true;
}

// Does anything follow from the number of the tick?
bool reads_time(const Plan& plan) {
  const Dependents& dependents = *plan.dependents;
  const std::vector<SetGroup>& groups = dependents.sets->groups;
  return !dependents.links->timed.empty() || !dependents.sets->timed_nodes.empty() ||
         std::any_of(groups.begin(), groups.end(),
                     [&](const SetGroup& group) { return plan.nodes[group.node].types[group.type].definition->reads_time; });
}

// Has a tick changed nothing, and will the next one change nothing, either? Whoever is asked in every tick says the same again
// where nothing that is read has changed. Calm that still counts may bring rest about, and rest may bring about that the scene
// counts as settled: both are news.
bool is_idle_after(const State& before, const State& next) {
  if (reads_time(*next.plan)) return false;
  if (!before.due.is_nothing() || !next.due.is_nothing() || next.due.was_at_rest != is_at_rest(next)) return false;
  if (next.calm == 0 ? before.calm != 0 : !next.is_settled()) return false;
  const bool is_waiting = std::any_of(next.analyses.begin(), next.analyses.end(), [&](const AnalysisState& analysis) {
    return analysis.running || (analysis.as_of >= 0 && analysis.as_of != next.tick);
  });
  return !is_waiting && is_unchanged_list(before.nodes, next.nodes) && is_unchanged_list(before.links, next.links);
}

}  // namespace

Simulation::Simulation(const Registry& registry, int threads, double (*now)()) : registry_(&registry), pool_(threads), now_(now) {
  set_scene({});
}

std::shared_ptr<const State> Simulation::with_scene(const Scene& scene,
                                                    const std::set<std::pair<std::string, std::string>>& placed) const {
  if (!state_) return std::make_shared<State>(initial_state(compile(scene, *registry_)));
  if (const auto amended = amend(*state_->plan, scene, *registry_))
    return std::make_shared<State>(carry_amended(*state_, *amended, placed));
  return std::make_shared<State>(carry(*state_, compile(scene, *registry_), placed));
}

void Simulation::set_scene(const Scene& scene, const std::set<std::pair<std::string, std::string>>& placed) {
  const double began = moment_of(measured_);
  take(with_scene(scene, placed));
  // What was kept for evaluations of nodes that are gone, or that play the role no more, is for nobody.
  std::erase_if(memos_, [&](const auto& memo) { return !plays_role(*state_->plan, memo.first); });
  if (measured_ != nullptr) measured_->add_commands(began);
}

Result<void> Simulation::restore_state(const SavedState& saved) {
  auto state = restore(saved, state_->plan);
  if (!state) return state.error();
  recall_meshes(*state, pool_, memos_);
  take(std::make_shared<State>(std::move(*state)));
  return {};
}

Result<void> Simulation::unpack(const PackedState& packed) {
  auto state = restore(packed.saved(), packed.plan());
  if (!state) return state.error();
  recall_meshes(*state, pool_, memos_);
  state->analyses = packed.analyses();
  state->hash = hash_of(*state);
  take(std::make_shared<State>(std::move(*state)));
  return {};
}

void Simulation::return_to(std::shared_ptr<const State> earlier) {
  if (earlier->plan == state_->plan) take(std::move(earlier));
  else take(std::make_shared<State>(carry(*earlier, state_->plan, {})));
}

std::shared_ptr<const State> Simulation::shown(std::shared_ptr<const State> state) {
  StateDraft seen(*state);
  if (!evaluate_unasked(seen)) return state;
  return std::make_shared<State>(std::move(seen).publish());
}

bool Simulation::step() {
  double last = now_ ? now_() : 0;
  auto lap = [&](double& share, TickPart part) {
    if (measured_ != nullptr) measured_->end_part(part);
    if (!now_) return;
    const double time = now_();
    share += time - last;
    last = time;
  };
  if (measured_ != nullptr) measured_->begin_tick(state_->plan);
  State everything_due;
  if (evaluates_everything_) {
    // Also what evaluations keep of their own, or both ways would follow the same mistake.
    memos_.clear();
    everything_due = *state_;
    everything_due.due.is_everything = true;
  }
  TickWork work(evaluates_everything_ ? everything_due : *state_);
  work.times = measured_;
  work.asks_all = evaluates_everything_;
  ++work.next.state.tick;
  evaluate_links(work, pool_, evaluates_everything_ ? nullptr : &link_memos_);
  lap(times_.links, TickPart::links);
  // A phase that was stopped has left gaps, which the next one must not meet.
  if (is_stop_wished()) return false;
  evaluate_nodes(work, pool_);
  lap(times_.nodes, TickPart::roles);
  if (is_stop_wished()) return false;
  evaluate_sets(work, pool_, memos_, runner_);
  lap(times_.solve, TickPart::sets);
  if (is_stop_wished()) {
    // What evaluations keep for the next tick may have gaps as well.
    memos_.clear();
    return false;
  }
  counts_ += work.counts;
  auto next = std::make_shared<State>(commit(std::move(work)));
  is_idle_ = !evaluates_everything_ && is_idle_after(*state_, *next);
  state_ = std::move(next);
  lap(times_.commit, TickPart::publish);
  if (measured_ != nullptr) measured_->end_tick();
  return true;
}

void Simulation::pass(std::int64_t ticks) {
  if (ticks <= 0) return;
  auto next = std::make_shared<State>(*state_);
  next->tick += ticks;
  if (next->calm > 0) next->calm += ticks;
  // Data that is still the same is that of each tick.
  for (AnalysisState& analysis : next->analyses)
    if (analysis.as_of >= 0) analysis.as_of += ticks;
  next->hash = hash_of(*next);
  state_ = std::move(next);
}

}  // namespace bl
