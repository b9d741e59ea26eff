// Runs the phases of a tick in their order.
#include "core/graph/simulation.h"

#include <algorithm>

#include "core/base/stop_check.h"
#include "core/graph/amend.h"

namespace bl {

namespace {

bool plays_role(const Plan& plan, const std::pair<std::string, std::string>& node_and_type) {
  const std::uint32_t node = plan.node_index(node_and_type.first);
  if (node == plan.nodes.size()) return false;
  const std::vector<TypePlan>& types = plan.nodes[node].types;
  return std::any_of(types.begin(), types.end(), [&](const TypePlan& t) { return t.definition->id == node_and_type.second; });
}

}  // namespace

Simulation::Simulation(const Registry& registry, int threads, double (*now)()) : registry_(&registry), pool_(threads), now_(now) {
  set_scene({});
}

std::shared_ptr<const State> Simulation::with_scene(const Scene& scene,
                                                    const std::set<std::pair<std::string, std::string>>& placed) const {
  if (!state_) return std::make_shared<State>(initial_state(compile(scene, *registry_)));
  if (auto amended = amend(*state_->plan, scene))
    return std::make_shared<State>(carry_amended(*state_, std::move(amended->plan), amended->nodes, placed));
  return std::make_shared<State>(carry(*state_, compile(scene, *registry_), placed));
}

void Simulation::set_scene(const Scene& scene, const std::set<std::pair<std::string, std::string>>& placed) {
  state_ = with_scene(scene, placed);
  // What was kept for evaluations of nodes that are gone, or that play the role no more, is for nobody.
  std::erase_if(memos_, [&](const auto& memo) { return !plays_role(*state_->plan, memo.first); });
}

Result<void> Simulation::restore_state(const SavedState& saved) {
  auto state = restore(saved, state_->plan);
  if (!state) return state.error();
  recall_meshes(*state, pool_, memos_);
  state_ = std::make_shared<State>(std::move(*state));
  return {};
}

void Simulation::return_to(std::shared_ptr<const State> earlier) {
  if (earlier->plan == state_->plan) state_ = std::move(earlier);
  else state_ = std::make_shared<State>(carry(*earlier, state_->plan, {}));
}

std::shared_ptr<const State> Simulation::shown(std::shared_ptr<const State> state) {
  StateDraft seen(*state);
  if (!evaluate_unasked(seen)) return state;
  return std::make_shared<State>(std::move(seen).publish());
}

bool Simulation::step() {
  double last = now_ ? now_() : 0;
  auto lap = [&](double& share) {
    if (!now_) return;
    const double time = now_();
    share += time - last;
    last = time;
  };
  State everything_due;
  if (evaluates_everything_) {
    everything_due = *state_;
    everything_due.due.is_everything = true;
  }
  TickWork work(evaluates_everything_ ? everything_due : *state_);
  ++work.next.state.tick;
  evaluate_links(work, pool_);
  lap(times_.links);
  // A phase that was stopped has left gaps, which the next one must not meet.
  if (is_stop_wished()) return false;
  evaluate_nodes(work, pool_);
  lap(times_.nodes);
  if (is_stop_wished()) return false;
  evaluate_sets(work, pool_, memos_, runner_);
  lap(times_.solve);
  if (is_stop_wished()) {
    // What evaluations keep for the next tick may have gaps as well.
    memos_.clear();
    return false;
  }
  counts_ += work.counts;
  auto next = std::make_shared<State>(commit(std::move(work)));
  lap(times_.commit);
  state_ = std::move(next);
  return true;
}

}  // namespace bl
