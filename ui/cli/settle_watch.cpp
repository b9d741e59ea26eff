// When to give up, and the sentence that says why.
#include "ui/cli/settle_watch.h"

#include <algorithm>

#include "core/base/text.h"
#include "core/reading/place_problems.h"
#include "ui/cli/survey.h"

namespace bl::cli {

namespace {

constexpr long long kPatience = 40, kLongPatience = 400;

struct Mover {
  std::string id;
  double distance = 0;  // [m] in the last tick
};

Mover fastest(const State& state, const State* before) {
  Mover mover;
  if (before == nullptr || before->plan != state.plan) return mover;
  const auto path = parse_port_path("node.position");
  for (std::uint32_t n = 0; n < state.nodes.size(); ++n)
    if (const auto ref = state.plan->find(n, *path)) {
      const double moved = distance(std::get<Vector3>(before->value(*ref)), std::get<Vector3>(state.value(*ref)));
      if (moved > mover.distance) mover = {state.plan->nodes[n].id, moved};
    }
  return mover;
}

std::string of_worst(const VolumeRow& worst) {
  std::string text = "`" + worst.id + "` has " + fixed(worst.volume, 1) + " of " + fixed(worst.demand, 1) + " m³";
  // A percentage of nothing says nothing.
  if (worst.demand > 1e-3) text += " (" + fixed(100 * worst.error, 2) + " %)";
  if (worst.state != "alive") text += ", it is " + worst.state;
  if (!worst.reason.empty()) text += ": " + worst.reason;
  return text;
}

// A demand that no boundary could hold, even where a cap hides it from the solver.
std::string of_greedy(const State& state) {
  double room = 0;
  for (std::uint32_t n = 0; n < state.nodes.size(); ++n)
    if (const auto ref = state.plan->find(n, PortPath{"boundary", "volume", ""})) room += as_number(state.value(*ref));
  for (std::uint32_t n = 0; n < state.nodes.size(); ++n)
    if (const auto ref = state.plan->find(n, PortPath{"smart_volume", "demand", ""}))
      if (const double demand = as_number(state.value(*ref)); demand > room)
        return "; `" + state.plan->nodes[n].id + "` alone asks for " + fixed(demand, 1) + " m³, more than the " + fixed(room, 1) +
               " m³ inside the boundary";
  return "";
}

}  // namespace

bool has_node_error(const State& state) {
  for (const NodeState& node : state.nodes)
    for (const TypeState& type : node.types)
      if (type.error) return true;
  return false;
}

bool SettleWatch::is_hopeless(const State& state) {
  const bool is_calm = state.largest_move <= state.plan->settings.move_limit;
  const bool is_better = best_error_ < 0 || state.largest_residual < 0.99 * best_error_;
  if (is_better) best_error_ = state.largest_residual;
  // Errors within the tolerance need no progress: the calm ticks are being counted.
  if (!is_calm || is_better || state.calm > 0) idle_ = 0;
  else ++idle_;
  if (idle_ >= kLongPatience) return true;
  return idle_ >= kPatience && (!solver_message(state).empty() || has_failure(state));
}

std::string why_not_settled(const State& state, const State* before) {
  // A collapse comes before what follows from it.
  if (const auto collapsed = report::collapsed_volumes(state); !collapsed.empty()) return collapsed.front().sentence();
  if (const std::string message = solver_message(state); !message.empty()) return "the demands cannot be met: " + message;
  const std::vector<VolumeRow> volumes = volumes_of(state);
  const auto worst =
      std::max_element(volumes.begin(), volumes.end(), [](const VolumeRow& a, const VolumeRow& b) { return a.error < b.error; });
  const Settings& settings = state.plan->settings;
  if (const auto problem = first_failure(state)) {
    return problem->text() + (worst != volumes.end() && worst->error > settings.tolerance ? "; " + of_worst(*worst) : "");
  }
  if (worst != volumes.end() && worst->error > settings.tolerance) return of_worst(*worst) + of_greedy(state);
  if (const auto work = first_work(state)) return work->text() + "; this is still being worked on";
  if (state.largest_residual > settings.tolerance) return "an error of " + fixed(100 * state.largest_residual, 2) + " % is left";
  if (state.largest_move > settings.move_limit) {
    const Mover mover = fastest(state, before);
    const std::string who = mover.id.empty() ? "a node" : "`" + mover.id + "`";
    return who + " still moves by " + fixed(state.largest_move, 3) + " m per tick, the limit is " +
           shortest(settings.move_limit) + " m";
  }
  if (state.largest_change > settings.change_limit)
    return "`" + state.plan->nodes[state.restless.node].id + "`: `" + state.plan->path_text(state.restless) +
           "` still changes by " + fixed(100 * state.largest_change, 2) + " % per tick, the limit is " +
           shortest(100 * settings.change_limit) + " %" + of_greedy(state);
  for (std::size_t a = 0; a < state.analyses.size(); ++a)
    if (const AnalysisPlan& plan = state.plan->analyses[a];
        state.analyses[a].as_of <= state.tick - state.calm || state.calm >= settings.calm_ticks)
      return "`" + state.plan->nodes[plan.node].id + "`: the " + state.plan->nodes[plan.node].types[plan.type].definition->label +
             " has not seen the calm state yet";
  return "all demands are met, and " + std::to_string(state.calm) + " of " + std::to_string(settings.calm_ticks) +
         " calm ticks have passed";
}

}  // namespace bl::cli
