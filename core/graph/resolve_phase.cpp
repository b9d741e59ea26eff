// Phase 4: the proposals on one port become its effective value and its tension.
#include <algorithm>
#include <cmath>
#include <functional>

#include "core/graph/phases.h"

namespace bl {

namespace {

struct Proposal {
  PortRef target;
  const Voice* voice;
};

double clamped(const PortDefinition& port, double value) { return std::clamp(value, port.hard_minimum, port.hard_maximum); }

// The hysteresis of a scene at rest: what is left of moves dies away, and values do not follow the last little. Whoever wants
// much more than what counts as calm wakes it, and so does whoever edits it.
struct RestLimits {
  bool is_on = false;
  double wakes_at = 0;   // a push [m] beyond which rest is over
  double move = 0;       // how far a push moves at most while it is not [m]
  double held_back = 0;  // a change, as a share of a value, that is not made
};

RestLimits rest_limits_of(const State& frozen) {
  // A city that comes to its place by shares of what is missing has to arrive, and one that swings has to stop: after some
  // hundred ticks the moves are too short for anybody, and end.
  constexpr double kDyingAway = 0.99, kShortestMove = 1e-6, kHeldShare = 0.5;
  const Settings& settings = frozen.plan->settings;
  if (!is_at_rest(frozen)) return {};
  double move = settings.move_limit;
  for (std::int64_t k = settings.calm_ticks; k < frozen.calm && move > kShortestMove; ++k) move *= kDyingAway;
  return {true, kWakingPush * settings.move_limit, move > kShortestMove ? move : 0, kHeldShare * settings.change_limit};
}

// Changes add up: next = now + sum of strength · change, no longer than the step limit.
void resolve_sum(const PortDefinition& port, bool is_locked, const RestLimits& rest, std::span<const Proposal> proposals,
                 Value& value, double& tension, double& move) {
  Vector3 sum;
  double number = 0, loudness = 0;
  for (const Proposal& h : proposals) {
    loudness += h.voice->strength * h.voice->magnitude;
    if (const auto* v = std::get_if<Vector3>(&h.voice->value)) sum += *v * h.voice->strength;
    else number += as_number(h.voice->value) * h.voice->strength;
  }
  const double length = port.kind == ValueKind::point ? norm(sum) : std::abs(number);
  const bool is_resting = rest.is_on && port.unit == Unit::metre && length <= rest.wakes_at;
  const double most = is_resting ? std::min(port.step_limit, rest.move) : port.step_limit;
  const double share = is_locked ? 0 : (length > most ? most / length : 1);
  if (auto* position = std::get_if<Vector3>(&value)) *position += sum * share;
  else value = clamped(port, as_number(value) + number * share);
  move = length * share;
  tension = std::max(0.0, loudness - move);
}

// Wanted values: a weighted mean in which the set value is one voice, or the smallest or largest of all.
double combined(const PortDefinition& port, const Value& set, bool is_set, std::span<const Proposal> proposals) {
  const double base = as_number(set);
  if (port.rule == CombineRule::blend) {
    double sum = is_set ? base : 0, weight = is_set ? 1 : 0;
    for (const Proposal& h : proposals) {
      sum += h.voice->strength * as_number(h.voice->value);
      weight += h.voice->strength;
    }
    return weight > 0 ? sum / weight : base;
  }
  double result = base;
  for (const Proposal& h : proposals)
    if (h.voice->strength > 0) {
      const double wanted = as_number(h.voice->value);
      result = port.rule == CombineRule::min ? std::min(result, wanted) : std::max(result, wanted);
    }
  return result;
}

Vector3 blended(const Value& set, bool is_set, std::span<const Proposal> proposals) {
  const Vector3 base = std::get<Vector3>(set);
  Vector3 sum = is_set ? base : Vector3{};
  double weight = is_set ? 1 : 0;
  for (const Proposal& h : proposals) {
    sum += std::get<Vector3>(h.voice->value) * h.voice->strength;
    weight += h.voice->strength;
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
                   std::span<const Proposal> proposals, Value& value, double& tension) {
  const bool is_set = type.is_set[p];
  if (port.kind == ValueKind::point) {
    const Vector3 old = std::get<Vector3>(before);
    Vector3 step = blended(type.set_values[p], is_set, proposals) - old;
    if (const double length = norm(step); length > port.step_limit) step *= port.step_limit / length;
    value = type.is_locked[p] ? type.set_values[p] : Value(old + step);
    for (const Proposal& h : proposals)
      tension += h.voice->strength * distance(std::get<Vector3>(h.voice->value), std::get<Vector3>(value));
    return;
  }
  const double old = as_number(before);
  double wanted = combined(port, type.set_values[p], is_set, proposals);
  wanted = std::clamp(wanted, old - port.step_limit, old + port.step_limit);
  value = type.is_locked[p] ? type.set_values[p] : Value(clamped(port, wanted));
  if (rest.is_on && !type.is_locked[p] && !proposals.empty() && relative_change(before, value) <= rest.held_back) value = before;
  for (const Proposal& h : proposals) tension += h.voice->strength * std::abs(as_number(h.voice->value) - as_number(value));
  if (is_set && port.rule == CombineRule::blend) tension += std::abs(as_number(type.set_values[p]) - as_number(value));
}

// Texts of all voices beside those that people set, sorted, each once. A lock leaves the set ones; what it keeps out is tension.
void resolve_texts(const Value& set, bool is_locked, std::span<const Proposal> proposals, Value& value, double& tension) {
  using Texts = Shared<std::vector<std::string>>;
  // The rule: people have set none, one link speaks, and its list is as it has to be.
  if (std::get<Texts>(set)->empty() && !is_locked && proposals.size() == 1 && proposals.front().voice->strength > 0) {
    const auto& only = std::get<Texts>(proposals.front().voice->value);
    const bool is_tidy = std::adjacent_find(only->begin(), only->end(), std::greater_equal<>()) == only->end();
    if (is_tidy && (only->empty() || !only->front().empty())) {
      value = only;
      return;
    }
  }
  std::vector<std::string> own = *std::get<Texts>(set), all = own;
  for (const Proposal& h : proposals)
    if (h.voice->strength > 0)
      for (const std::string& text : *std::get<Texts>(h.voice->value))
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

// All voices that count, by port; within a port in ascending link id, because links are walked in that order.
std::vector<Proposal> gather(const State& next) {
  std::vector<Proposal> proposals;
  for (std::size_t l = 0; l < next.links.size(); ++l) {
    if (next.plan->links[l].is_muted) continue;
    for (const Voice& voice : next.links[l].voices) proposals.push_back({voice.target, &voice});
  }
  std::stable_sort(proposals.begin(), proposals.end(), [](const Proposal& a, const Proposal& b) { return a.target < b.target; });
  return proposals;
}

// What a tick changed at one node: what settling looks at.
struct NodeChange {
  double move = 0, change = 0;
  PortRef restless;
  std::vector<PortRef> unsound;  // ports that could not be followed
};

// What huge voices add up to may lie beyond all numbers: then the port stays as it is, and whoever spoke is told.
void keep_finite(const Value& before, PortRef port, Value& value, NodeChange& node_change) {
  if (make_storable(value)) return;
  value = before;
  node_change.unsound.push_back(port);
}

// Links that spoke to a port which could not be followed; each of them may be sound for itself.
void report_overflow(State& next, PortRef port) {
  for (std::size_t l = 0; l < next.links.size(); ++l) {
    LinkState& link = next.links[l];
    const bool has_spoken = std::any_of(link.voices.begin(), link.voices.end(), [&](const Voice& v) { return v.target == port; });
    if (!has_spoken || next.plan->links[l].is_muted || link.has_failed()) continue;
    link.error = Error{ErrorCode::not_finite, "links/" + next.plan->links[l].id,
                       "together with other links it proposes more than any number for `" + next.plan->path_text(port) +
                           "` of `" + next.plan->nodes[port.node].id + "`, which stays as it is"};
    link.remark.reset();
  }
}

void resolve_node(const State& frozen, State& next, std::uint32_t n, const RestLimits& rest, std::span<const Proposal> proposals,
                  NodeChange& node_change) {
  std::size_t at = 0;
  for (std::uint16_t t = 0; t < next.nodes[n].types.size(); ++t) {
    const TypePlan& type = next.plan->nodes[n].types[t];
    TypeState& state = next.nodes[n].types[t];
    for (std::uint16_t p = 0; p < type.definition->ports.size(); ++p) {
      const PortDefinition& port = type.definition->ports[p];
      if (port.is_computed) continue;
      const std::size_t first = at;
      while (at < proposals.size() && proposals[at].target == PortRef{n, t, p}) ++at;
      const auto voices = proposals.subspan(first, at - first);
      double tension = 0, move = 0;
      const Value& before = frozen.nodes[n].types[t].values[p];
      if (port.rule == CombineRule::sum) {
        if (!voices.empty()) resolve_sum(port, type.is_locked[p], rest, voices, state.values[p], tension, move);
        keep_finite(before, {n, t, p}, state.values[p], node_change);
        if (port.unit == Unit::metre) node_change.move = std::max(node_change.move, move);
      } else if (port.rule != CombineRule::none) {
        if (port.rule == CombineRule::collect)
          resolve_texts(type.set_values[p], type.is_locked[p], voices, state.values[p], tension);
        else resolve_value(port, type, p, before, rest, voices, state.values[p], tension);
        keep_finite(before, {n, t, p}, state.values[p], node_change);
        if (const double change = relative_change(before, state.values[p]); change > node_change.change) {
          node_change.change = change;
          node_change.restless = {n, t, p};
        }
      } else {
        state.values[p] = type.set_values[p];
      }
      state.tension[p] = tension;
    }
  }
}

}  // namespace

void resolve_proposals(const State& frozen, State& next, ThreadPool& pool) {
  const std::vector<Proposal> proposals = gather(next);
  std::vector<std::size_t> start(next.nodes.size() + 1, proposals.size());
  for (std::size_t i = proposals.size(); i-- > 0;) start[proposals[i].target.node] = i;
  for (std::size_t n = next.nodes.size(); n-- > 0;) start[n] = std::min(start[n], start[n + 1]);
  std::vector<NodeChange> node_change(next.nodes.size());
  const RestLimits rest = rest_limits_of(frozen);
  pool.for_each_chunk(next.nodes.size(), 64, [&](std::size_t begin, std::size_t end) {
    for (std::size_t n = begin; n < end; ++n)
      resolve_node(frozen, next, static_cast<std::uint32_t>(n), rest,
                   std::span(proposals).subspan(start[n], start[n + 1] - start[n]), node_change[n]);
  });
  next.largest_move = next.largest_change = 0;
  for (const NodeChange& node : node_change) {
    next.largest_move = std::max(next.largest_move, node.move);
    for (const PortRef port : node.unsound) report_overflow(next, port);
    if (node.change <= next.largest_change) continue;
    next.largest_change = node.change;
    next.restless = node.restless;
  }
}

}  // namespace bl
