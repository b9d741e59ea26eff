// The rule for giving up, and the sentence that gives the reason.
#include "ui/cli/settle_watch.h"

#include <algorithm>

#include "core/base/text.h"
#include "core/reading/place_problems.h"
#include "core/reading/survey.h"
#include "core/reading/views/node.h"

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
  for (std::uint32_t n = 0; n < state.nodes.size(); ++n) {
    using reading::NodePlace;
    const double moved = distance(reading::read<&reading::NodePlace::position>(*before, n),
                                  reading::read<&reading::NodePlace::position>(state, n));
    if (moved > mover.distance) mover = {state.plan->nodes[n].id, moved};
  }
  return mover;
}

std::string of_worst(const State& state, const reading::VolumeAccount& worst) {
  const reading::VolumeFigures& figures = worst.figures;
  std::string text =
      "`" + state.plan->nodes[worst.node].id + "` has " + fixed(worst.volume, 1) + " of " + fixed(worst.limited, 1) + " m³";
  // A percentage of nothing says nothing.
  if (worst.limited > 1e-3) text += " (" + fixed(100 * figures.error, 2) + " %)";
  if (!worst.is_alive) text += ", it is " + figures.state;
  if (!figures.reason.empty()) text += ": " + figures.reason;
  return text;
}

// A demand that no boundary could hold, even where a cap hides it from the solver.
std::string of_greedy(const State& state) {
  double room = 0;
  for (const auto& [node, boundary] : reading::rows<reading::BoundaryFigures>(state)) room += boundary.volume;
  for (const auto& [node, volume] : reading::rows<reading::VolumeFigures>(state))
    if (volume.demand > room)
      return "; `" + state.plan->nodes[node].id + "` alone asks for " + fixed(volume.demand, 1) + " m³, more than the " +
             fixed(room, 1) + " m³ inside the boundary";
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
  if (!is_calm || is_better || state.calm > 0) {
    idle_ = 0;
    unkept_.clear();
    heights_.clear();
  } else {
    ++idle_;
    note(state);
  }
  if (idle_ >= kLongPatience) return true;
  return idle_ >= kPatience && (!reading::solver_message(state).empty() || has_failure(state));
}

void SettleWatch::note(const State& state) {
  for (std::uint32_t l = 0; l < state.links.size(); ++l)
    if (is_at_work(state, l)) unkept_[l] = state.links[l].work->message;
  for (const auto& [node, footprint] : reading::rows<reading::StoreyFigures>(state)) {
    const auto [found, is_new] = heights_.try_emplace(node, footprint.storeys_built, footprint.storeys_built);
    found->second = {std::min(found->second.first, footprint.storeys_built),
                     std::max(found->second.second, footprint.storeys_built)};
  }
}

std::string SettleWatch::to_and_fro(const State& state) const {
  if (idle_ < kLongPatience || unkept_.empty()) return "";
  constexpr std::size_t kMostNamed = 3;
  std::string text = "nothing has become better for " + std::to_string(idle_) + " ticks, in which ";
  std::size_t named = 0;
  for (const auto& [node, storeys] : heights_)
    if (storeys.first != storeys.second && named++ < kMostNamed)
      text += (named == 1 ? "`" : "; `") + state.plan->nodes[node].id + "` had now " + std::to_string(storeys.first) + ", now " +
              std::to_string(storeys.second) + " storeys";
  if (named > kMostNamed) text += " and " + std::to_string(named - kMostNamed) + " more likewise";
  text += std::string(named > 0 ? ", and " : "") + "the rules of these links were not kept at once: ";
  named = 0;
  for (const auto& [link, what] : unkept_)
    if (named++ < kMostNamed) text += (named == 1 ? "`" : "; `") + state.plan->links[link].id + "` (" + what + ")";
  if (named > kMostNamed) text += " and " + std::to_string(named - kMostNamed) + " more";
  return text + (named > 1 ? "; loosen one of them" : "; loosen it");
}

std::string why_not_settled(const State& state, const State* before, const SettleWatch& watch) {
  // A collapse comes before what follows from it.
  if (const auto collapsed = reading::collapsed_volumes(state); !collapsed.empty()) return collapsed.front().sentence();
  if (const std::string message = reading::solver_message(state); !message.empty())
    return "the demands cannot be met: " + message;
  const std::vector<reading::VolumeAccount> volumes = reading::accounts_of(state).volumes;
  const auto worst = std::max_element(volumes.begin(), volumes.end(),
                                      [](const auto& a, const auto& b) { return a.figures.error < b.figures.error; });
  const Settings& settings = state.plan->settings;
  const bool has_worst = worst != volumes.end() && worst->figures.error > settings.tolerance;
  if (const auto problem = first_failure(state)) return problem->text() + (has_worst ? "; " + of_worst(state, *worst) : "");
  if (has_worst) return of_worst(state, *worst) + of_greedy(state);
  if (const std::string turns = watch.to_and_fro(state); !turns.empty()) return turns;
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
