// Who pulls at what: ports under tension with the voices behind it, and everything that failed or cannot be had.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/base/text.h"
#include "ui/cli/report/figures.h"
#include "ui/cli/report/report_model.h"

namespace bl::report {

namespace {

// Less than this share of what is pulled at is no conflict that anybody would want to read about.
constexpr double kMinorSeverity = 0.002;

// "north-east and up", by true north.
std::string direction_of(const Vector3& pull, double true_north) {
  constexpr std::array kNames = {"north", "north-east", "east", "south-east", "south", "south-west", "west", "north-west"};
  const double across = std::hypot(pull.x, pull.y), length = norm(pull);
  std::string text;
  if (across > 0.38 * length) {
    const double angle = std::atan2(pull.x, pull.y) * 180 / std::numbers::pi - true_north;
    const double eighth = std::round(angle / 45);
    text = kNames[static_cast<std::size_t>(eighth - 8 * std::floor(eighth / 8)) % 8];
  }
  if (std::abs(pull.z) <= 0.38 * length) return text;
  return text + (text.empty() ? "" : " and ") + (pull.z > 0 ? "up" : "down");
}

std::string pull_text(const State& state, const LinkPlan& link, const Voice& voice) {
  const PortDefinition& port = state.plan->port(voice.target);
  const std::string who = link.id + " (" + (link.definition ? link.definition->label : "unknown kind") + ") ";
  const std::string loudness = voice.strength == 1 ? "" : ", strength " + shortest(voice.strength);
  if (port.rule != CombineRule::sum) {
    if (std::holds_alternative<Vector3>(voice.value)) return who + "wants another place" + loudness;
    return who + "wants " + quantity(as_number(voice.value), port.unit) + loudness;
  }
  const auto* move = std::get_if<Vector3>(&voice.value);
  if (move == nullptr) return who + "pulls by " + quantity(as_number(voice.value), port.unit) + loudness;
  if (norm(*move) < 1e-3 * voice.magnitude || norm(*move) == 0)
    return who + "pulls both ways, " + quantity(voice.magnitude, port.unit) + " in all" + loudness;
  return who + "pulls " + quantity(norm(*move), port.unit) + " " + direction_of(*move, state.plan->settings.true_north) +
         loudness;
}

double size_of(const State& state, PortRef ref) {
  const Value& value = state.value(ref);
  // Places have no size of their own: a pull counts against the radius of what it moves.
  if (std::holds_alternative<Vector3>(value)) return std::max(1.0, number_at(state, ref.node, "smart_volume", "radius"));
  return std::max(std::abs(as_number(value)), 1e-9);
}

ConflictRow row_of(const State& state, PortRef ref, double tension) {
  const PortDefinition& port = state.plan->port(ref);
  const TypePlan& type = state.plan->nodes[ref.node].types[ref.type];
  ConflictRow row{
      name_at(state, ref.node), state.plan->path_text(ref), quantity(tension, port.unit), {}, tension / size_of(state, ref)};
  for (std::size_t l = 0; l < state.links.size(); ++l) {
    const LinkPlan& link = state.plan->links[l];
    if (!link.is_enabled || link.is_muted) continue;
    for (const Voice& voice : state.links[l].voices) {
      const bool says_something = voice.magnitude > 0 || port.rule != CombineRule::sum;
      if (voice.target == ref && voice.strength > 0 && says_something) row.pulls.push_back(pull_text(state, link, voice));
    }
  }
  if (type.is_locked[ref.port]) row.pulls.push_back("locked by hand");
  else if (type.is_set[ref.port] && port.rule == CombineRule::blend &&
           !std::holds_alternative<Vector3>(type.set_values[ref.port]))
    row.pulls.push_back("set by hand to " + quantity(as_number(type.set_values[ref.port]), port.unit));
  return row;
}

}  // namespace

void read_conflicts(const State& state, ReportModel& model) {
  std::vector<std::pair<PortRef, double>> tense;
  for (std::uint32_t n = 0; n < state.nodes.size(); ++n)
    for (std::uint16_t t = 0; t < state.nodes[n].types.size(); ++t) {
      const std::vector<double>& tension = state.nodes[n].types[t].tension;
      for (std::uint16_t p = 0; p < tension.size(); ++p)
        if (const PortRef ref{n, t, p}; tension[p] > 0) {
          if (tension[p] < kMinorSeverity * size_of(state, ref)) ++model.minor_conflicts;
          else tense.emplace_back(ref, tension[p]);
        }
    }
  for (const auto& [ref, tension] : tense) model.conflicts.push_back(row_of(state, ref, tension));
  std::stable_sort(model.conflicts.begin(), model.conflicts.end(),
                   [](const ConflictRow& a, const ConflictRow& b) { return a.severity > b.severity; });
}

void read_problems(const State& state, ReportModel& model) {
  const Plan& plan = *state.plan;
  const auto add = [&](std::string place, std::string message) {
    model.problems.push_back({std::move(place), std::move(message)});
  };
  for (std::uint32_t n = 0; n < state.nodes.size(); ++n) {
    for (std::size_t t = 0; t < state.nodes[n].types.size(); ++t)
      if (const auto& error = state.nodes[n].types[t].error)
        add("node " + name_at(state, n) + ", " + plan.nodes[n].types[t].definition->label, error->text());
    if (const std::string message = text_at(state, n, "smart_volumes_solver", "message"); !message.empty())
      add("node " + name_at(state, n), message);
  }
  for (std::size_t l = 0; l < state.links.size(); ++l) {
    const auto& error = state.links[l].error ? state.links[l].error : plan.links[l].error;
    if (error) add("link " + plan.links[l].id, error->text());
  }
  for (const SetPlan& set : plan.sets)
    if (set.error) add("node " + name_at(state, set.node), set.error->text());
  std::vector<ProblemRow> distinct;
  for (ProblemRow& row : model.problems) {
    const auto is_same = [&](const ProblemRow& other) { return other.place == row.place && other.message == row.message; };
    if (std::none_of(distinct.begin(), distinct.end(), is_same)) distinct.push_back(std::move(row));
  }
  model.problems = std::move(distinct);
}

}  // namespace bl::report
