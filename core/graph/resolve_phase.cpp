// Phase 4: the proposals on one port become its effective value and its tension.
#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>

#include "core/graph/phases.h"

namespace bl {

namespace {

using Voices = std::span<const Voice* const>;

double clamped(const PortDefinition& port, double value) { return std::clamp(value, port.hard_minimum, port.hard_maximum); }

// Changes add up: next = now + sum of strength · change, no longer than the step limit.
void resolve_sum(const PortDefinition& port, bool is_locked, const RestLimits& rest, Voices proposals, Value& value,
                 double& tension, double& move) {
  Vector3 sum;
  double number = 0, loudness = 0;
  for (const Voice* h : proposals) {
    loudness += h->strength * h->magnitude;
    if (const auto* v = std::get_if<Vector3>(&h->value)) sum += *v * h->strength;
    else number += as_number(h->value) * h->strength;
  }
  const double length = port.kind == ValueKind::point ? norm(sum) : std::abs(number);
  const bool is_resting = rest.is_on && port.unit == Unit::metre && length <= rest.wakes_at;
  const double most = is_resting ? std::min(port.step_limit, rest.move) : port.step_limit;
  const bool is_too_short = port.unit == Unit::metre && std::min(length, most) < rest.least_move;
  const double share = is_locked || is_too_short ? 0 : (length > most ? most / length : 1);
  if (auto* position = std::get_if<Vector3>(&value)) *position += sum * share;
  else value = clamped(port, as_number(value) + number * share);
  move = length * share;
  tension = std::max(0.0, loudness - move);
}

// Wanted values: a weighted mean in which the set value is one voice, the smallest or largest of all, or their sum.
double combined(const PortDefinition& port, const Value& set, bool is_set, Voices proposals) {
  const double base = as_number(set);
  if (port.rule == CombineRule::blend) {
    double sum = is_set ? base : 0, weight = is_set ? 1 : 0;
    for (const Voice* h : proposals) {
      sum += h->strength * as_number(h->value);
      weight += h->strength;
    }
    return weight > 0 ? sum / weight : base;
  }
  double result = base;
  if (port.rule == CombineRule::total) {
    for (const Voice* h : proposals) result += h->strength * as_number(h->value);
    return result;
  }
  for (const Voice* h : proposals)
    if (h->strength > 0) {
      const double wanted = as_number(h->value);
      result = port.rule == CombineRule::min ? std::min(result, wanted) : std::max(result, wanted);
    }
  return result;
}

Vector3 blended(const Value& set, bool is_set, Voices proposals) {
  const Vector3 base = std::get<Vector3>(set);
  Vector3 sum = is_set ? base : Vector3{};
  double weight = is_set ? 1 : 0;
  for (const Voice* h : proposals) {
    sum += std::get<Vector3>(h->value) * h->strength;
    weight += h->strength;
  }
  return weight > 0 ? sum / weight : base;
}

// By what share of itself a number has changed; 1 for a list of texts that changed, 0 for what is neither.
double relative_change(const Value& before, const Value& after) {
  if (before == after) return 0;
  if (std::holds_alternative<Shared<std::vector<std::string>>>(after)) return 1;
  if (!std::holds_alternative<double>(after)) return 0;
  const double a = as_number(before), b = as_number(after);
  return std::abs(b - a) / std::max(std::abs(a), std::abs(b));
}

void resolve_value(const PortDefinition& port, const TypePlan& type, std::size_t p, const Value& before, const RestLimits& rest,
                   Voices proposals, Value& value, double& tension) {
  const bool is_set = type.is_set[p];
  if (port.kind == ValueKind::point) {
    const Vector3 old = std::get<Vector3>(before);
    Vector3 step = blended(type.set_values[p], is_set, proposals) - old;
    if (const double length = norm(step); length > port.step_limit) step *= port.step_limit / length;
    value = type.is_locked[p] ? type.set_values[p] : Value(old + step);
    for (const Voice* h : proposals) tension += h->strength * distance(std::get<Vector3>(h->value), std::get<Vector3>(value));
    return;
  }
  const double old = as_number(before);
  const double asked = combined(port, type.set_values[p], is_set, proposals);
  const double wanted = std::clamp(asked, old - port.step_limit, old + port.step_limit);
  value = type.is_locked[p] ? type.set_values[p] : Value(clamped(port, wanted));
  if (rest.is_on && !type.is_locked[p] && !proposals.empty() && relative_change(before, value) <= rest.held_back) value = before;
  // Amounts that are added up do not contradict each other: only what a lock or the range keeps out does.
  if (port.rule == CombineRule::total) {
    const double allowed = type.is_locked[p] ? as_number(value) : clamped(port, asked);
    if (std::isfinite(asked)) tension += std::abs(asked - allowed);
    return;
  }
  for (const Voice* h : proposals) tension += h->strength * std::abs(as_number(h->value) - as_number(value));
  if (is_set && port.rule == CombineRule::blend) tension += std::abs(as_number(type.set_values[p]) - as_number(value));
}

// Texts of all voices beside those that people set, sorted, each once. A lock leaves the set ones; what it keeps out is tension.
void resolve_texts(const Value& set, bool is_locked, Voices proposals, Value& value, double& tension) {
  using Texts = Shared<std::vector<std::string>>;
  // The rule: people have set none, one link speaks, and its list is as it has to be.
  if (std::get<Texts>(set)->empty() && !is_locked && proposals.size() == 1 && proposals.front()->strength > 0) {
    const auto& only = std::get<Texts>(proposals.front()->value);
    const bool is_tidy = std::adjacent_find(only->begin(), only->end(), std::greater_equal<>()) == only->end();
    if (is_tidy && (only->empty() || !only->front().empty())) {
      value = only;
      return;
    }
  }
  std::vector<std::string> own = *std::get<Texts>(set), all = own;
  for (const Voice* h : proposals)
    if (h->strength > 0)
      for (const std::string& text : *std::get<Texts>(h->value))
        if (!text.empty()) all.push_back(text);
  auto tidy = [](std::vector<std::string>& texts) {
    std::sort(texts.begin(), texts.end());
    texts.erase(std::unique(texts.begin(), texts.end()), texts.end());
  };
  tidy(all);
  tidy(own);
  if (is_locked) tension = static_cast<double>(all.size() - own.size());
  // Without a proposal the list stands as people wrote it.
  value = is_locked || proposals.empty() ? set : Value(Texts(std::move(all)));
}

// Links that may have spoken to the node, ascending: what a link that cannot run said last may stand, too.
std::vector<std::uint32_t> links_to(const Plan& plan, std::uint32_t n) {
  const LinkDependents& dependents = *plan.dependents->links;
  const auto able = dependents.at[{n, 0, 0}];
  std::vector<std::uint32_t> links;
  std::set_union(able.begin(), able.end(), dependents.broken.begin(), dependents.broken.end(), std::back_inserter(links));
  return links;
}

// What huge voices add up to may lie beyond all numbers: then the port stays as it is, and whoever spoke is told.
void keep_finite(const Value& before, PortRef port, Value& value, NodeChange& node_change) {
  if (make_storable(value)) return;
  value = before;
  node_change.unsound.push_back(port);
}

}  // namespace

RestLimits rest_limits_of(const State& frozen) {
  // A city that comes to its place by shares of what is missing has to arrive, and one that swings has to stop: after some
  // hundred ticks the moves are too short for anybody, and end.
  constexpr double kDyingAway = 0.99, kShortestMove = 1e-9, kHeldShare = 0.5;
  const Settings& settings = frozen.plan->settings;
  if (!is_at_rest(frozen)) return {.is_on = false, .wakes_at = 0, .move = 0, .least_move = settings.least_move, .held_back = 0};
  const double shortest = std::max(settings.least_move, kShortestMove);
  double move = settings.move_limit;
  for (std::int64_t k = settings.calm_ticks; k < frozen.calm && move > shortest; ++k) move *= kDyingAway;
  return {true, kWakingPush * settings.move_limit, move > shortest ? move : 0, settings.least_move,
          kHeldShare * settings.change_limit};
}

std::vector<const Voice*> voices_at(const StateDraft& draft, std::uint32_t n) {
  const Plan& plan = *draft.state.plan;
  std::vector<const Voice*> voices;
  for (const std::uint32_t l : links_to(plan, n)) {
    if (plan.links[l].is_muted) continue;
    const std::vector<Voice>& said = draft.links[l].voices;
    auto voice =
        std::lower_bound(said.begin(), said.end(), n, [](const Voice& v, std::uint32_t node) { return v.target.node < node; });
    for (; voice != said.end() && voice->target.node == n; ++voice) voices.push_back(&*voice);
  }
  std::stable_sort(voices.begin(), voices.end(), [](const Voice* a, const Voice* b) { return a->target < b->target; });
  return voices;
}

NodeChange resolve_node(const State& frozen, std::uint32_t n, const RestLimits& rest, Voices voices, NodeState& node) {
  NodeChange node_change;
  std::size_t at = 0;
  for (std::uint16_t t = 0; t < node.types.size(); ++t) {
    const TypePlan& type = frozen.plan->nodes[n].types[t];
    TypeState& state = node.types[t];
    for (std::uint16_t p = 0; p < type.definition->ports.size(); ++p) {
      const PortDefinition& port = type.definition->ports[p];
      if (port.is_computed) continue;
      const std::size_t first = at;
      while (at < voices.size() && voices[at]->target == PortRef{n, t, p}) ++at;
      const Voices said = voices.subspan(first, at - first);
      double tension = 0, move = 0;
      const Value& before = frozen.nodes[n].types[t].values[p];
      if (port.rule == CombineRule::none) {
        state.values[p] = type.set_values[p];
        state.tension.set(p, tension);
        continue;
      }
      if (port.rule == CombineRule::sum) {
        if (!said.empty()) resolve_sum(port, type.is_locked[p], rest, said, state.values[p], tension, move);
      } else if (port.rule == CombineRule::collect) {
        resolve_texts(type.set_values[p], type.is_locked[p], said, state.values[p], tension);
      } else {
        resolve_value(port, type, p, before, rest, said, state.values[p], tension);
      }
      keep_finite(before, {n, t, p}, state.values[p], node_change);
      node_change.is_on_its_way |= move > 0 || !(state.values[p] == before);
      if (port.rule == CombineRule::sum) {
        if (port.unit == Unit::metre) node_change.move = std::max(node_change.move, move);
      } else if (const double change = relative_change(before, state.values[p]); change > node_change.change) {
        node_change.change = change;
        node_change.restless = {n, t, p};
      }
      state.tension.set(p, tension);
    }
    state.tension.tidy();
  }
  return node_change;
}

void report_overflow(TickWork& work, PortRef port) {
  const Plan& plan = *work.frozen.plan;
  for (const std::uint32_t l : links_to(plan, port.node)) {
    const LinkState& link = work.next.links[l];
    const bool has_spoken = std::any_of(link.voices.begin(), link.voices.end(), [&](const Voice& v) { return v.target == port; });
    if (!has_spoken || plan.links[l].is_muted || link.has_failed()) continue;
    LinkState& told = work.next.links.edit(l);
    told.error = Error{ErrorCode::not_finite, "links/" + plan.links[l].id,
                       "together with other links it proposes more than any number for `" + plan.path_text(port) + "` of `" +
                           plan.nodes[port.node].id + "`, which stays as it is"};
    told.remark.reset();
    work.next.state.due.links.push_back(l);
  }
}

}  // namespace bl
