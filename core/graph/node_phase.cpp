// Phases 5 and 7: typifications, and the commit.
#include <algorithm>
#include <atomic>
#include <cmath>

#include "core/graph/phases.h"

namespace bl {

namespace {

bool same_inputs(const TypificationDefinition& definition, const std::vector<Value>& a, const std::vector<Value>& b) {
  for (std::size_t p = 0; p < definition.ports.size(); ++p)
    if (!definition.ports[p].is_computed && a[p] != b[p]) return false;
  return true;
}

}  // namespace

bool keeps_memory(const TypificationDefinition& definition) {
  return std::any_of(definition.ports.begin(), definition.ports.end(), [](const PortDefinition& port) { return !!port.recall; });
}

std::string place_of(const State& state, std::size_t n, std::size_t t) {
  return "nodes/" + state.plan->nodes[n].id + "/" + state.plan->nodes[n].types[t].definition->id;
}

void accept_values(const TypificationDefinition& definition, TypeState& state, std::vector<Value>&& values, Result<void> done,
                   const std::string& place) {
  for (std::size_t p = 0; done && p < values.size(); ++p)
    if (definition.ports[p].is_computed && !make_storable(values[p]))
      done = Error{ErrorCode::not_finite, definition.ports[p].id,
                   "was computed as a number that is not finite; the last good values are kept"};
  if (!done) {
    state.error = done.error().within(place);
    state.is_evaluated = false;
    return;
  }
  make_objects(definition, values, state.values);
  state.error.reset();
  state.values = std::move(values);
  state.is_evaluated = true;
}

namespace {

// Asks the typifications without sets for which `is_due` holds, by their definition and their place in the state.
template <class IsDue>
void ask_nodes(State& next, ThreadPool& pool, const IsDue& is_due) {
  pool.for_each_chunk(next.nodes.size(), 16, [&](std::size_t begin, std::size_t end) {
    for (std::size_t n = begin; n < end; ++n)
      for (std::size_t t = 0; t < next.nodes[n].types.size(); ++t) {
        const TypificationDefinition& definition = *next.plan->nodes[n].types[t].definition;
        TypeState& state = next.nodes[n].types[t];
        if (!definition.evaluate || !definition.sets.empty() || !is_due(definition, n, t)) continue;
        std::vector<Value> values = state.values;
        auto done = definition.evaluate(values, {}, Tick{.index = next.tick});
        accept_values(definition, state, std::move(values), std::move(done), place_of(next, n, t));
      }
  });
}

// Nothing changes any more by a thousandth of what counts as calm.
bool stands_still(const State& state) {
  constexpr double kStandstill = 1e-3;
  const Settings& settings = state.plan->settings;
  return state.largest_residual <= settings.tolerance && state.largest_move <= kStandstill * settings.move_limit &&
         state.largest_change <= kStandstill * settings.change_limit;
}

// Whoever is bringing a rule about while nothing changes does so in vain. That wakes what rests, too: the links may answer in
// full.
void name_stuck_rules(State& state) {
  for (std::size_t l = 0; l < state.links.size(); ++l) {
    if (!is_at_work(state, l)) continue;
    LinkState& link = state.links[l];
    link.error = std::move(link.work);
    link.error->message =
        "cannot be met: " + link.error->message +
        ", and nothing changes any more; loosen the rule, or remove what holds it up: a lock, another link, or a `gain` of 0";
    link.remark = LinkRemark::unmet;
    link.work.reset();
  }
}

}  // namespace

void evaluate_nodes(const State& frozen, State& next, ThreadPool& pool) {
  ask_nodes(next, pool, [&](const TypificationDefinition& definition, std::size_t n, std::size_t t) {
    const TypeState& state = next.nodes[n].types[t];
    return !state.is_evaluated || keeps_memory(definition) ||
           !same_inputs(definition, state.values, frozen.nodes[n].types[t].values);
  });
}

bool evaluate_unasked(State& state, ThreadPool& pool) {
  std::atomic<bool> has_any = false;
  ask_nodes(state, pool, [&](const TypificationDefinition& definition, std::size_t n, std::size_t t) {
    // For what remembers, a tick would pass by being asked.
    const bool is_due = !state.nodes[n].types[t].is_evaluated && !keeps_memory(definition);
    if (is_due) has_any = true;
    return is_due;
  });
  return has_any;
}

void commit(State& next) {
  const Settings& settings = next.plan->settings;
  next.largest_residual = largest_residual_of(next);
  if (stands_still(next)) name_stuck_rules(next);
  // Whoever rests needs more to be woken than to come to rest: volumes that follow by steps of their tolerance are no news, nor
  // is what links answer to these.
  const bool rests = is_at_rest(next);
  const double change_limit = rests ? std::max(settings.change_limit, settings.tolerance) : settings.change_limit;
  const double move_limit = rests ? kWakingPush * settings.move_limit : settings.move_limit;
  const bool is_calm = !has_failure(next) && (rests || !first_work(next)) && next.largest_residual <= settings.tolerance &&
                       next.largest_move <= move_limit && next.largest_change <= change_limit;
  next.calm = is_calm ? next.calm + 1 : 0;
  next.hash = hash_of(next);
}

}  // namespace bl
