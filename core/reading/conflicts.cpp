// Collects ports under tension with their proposals, and everything that failed or cannot be met.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "core/base/mathematics.h"
#include "core/base/text.h"
#include "core/reading/figures.h"
#include "core/reading/place_problems.h"
#include "core/reading/plot_problems.h"
#include "core/reading/report_model.h"
#include "core/reading/storeys.h"
#include "core/reading/sun_problems.h"
#include "core/reading/views/plot.h"
#include "core/reading/views/solver.h"

namespace bl::reading {

namespace {

// "north-east and up", by true north.
std::string direction_of(const Vector3& pull, double true_north) {
  constexpr std::array kNames = {"north", "north-east", "east", "south-east", "south", "south-west", "west", "north-west"};
  const double across = mathematics::hypotenuse(pull.x, pull.y), length = norm(pull);
  std::string text;
  if (across > 0.38 * length) {
    const double angle = mathematics::arc_tangent(pull.x, pull.y) * 180 / std::numbers::pi - true_north;
    const double eighth = std::round(angle / 45);
    text = kNames[static_cast<std::size_t>(eighth - 8 * std::floor(eighth / 8)) % 8];
  }
  if (std::abs(pull.z) <= 0.38 * length) return text;
  return text + (text.empty() ? "" : " and ") + (pull.z > 0 ? "up" : "down");
}

double size_of(const State& state, PortRef ref) {
  const Value& value = state.value(ref);
  // Places have no size of their own: a pull counts against the radius of what it moves.
  if (std::holds_alternative<Vector3>(value))
    return std::max(1.0, reading::read<&reading::VolumeFigures::radius>(state, ref.node));
  return std::max(std::abs(as_number(value)), 1e-9);
}

std::string speaker(const LinkPlan& link) {
  return link.id + " (" + (link.definition ? link.definition->label : "unknown kind") + ") ";
}

// What people say themselves: a lock, a wish that the port withholds, or a value that has a voice among the others.
std::string own_word(const TypePlan& type, std::uint16_t p, const std::string& wish) {
  const PortDefinition& port = type.definition->ports[p];
  if (type.is_locked[p]) return "locked by hand";
  if (!wish.empty()) return wish;
  if (type.is_set[p] && port.rule == CombineRule::blend && !std::holds_alternative<Vector3>(type.set_values[p]))
    return "set by hand to " + quantity(as_number(type.set_values[p]), port.unit);
  return "";
}

// The storeys that are wished, at the limit that withholds some of them.
std::string wish_at(const State& state, PortRef ref) {
  const auto withheld = withheld_height(state, ref.node);
  if (!withheld || withheld->limit != ref) return "";
  return quantity(static_cast<double>(withheld->wished), Unit::none) + " storeys are wished";
}

}  // namespace

std::string voice_text(const State& state, const Voice& voice) {
  const PortDefinition& port = state.plan->port(voice.target);
  const std::string loudness = voice.strength == 1 ? "" : ", strength " + shortest(voice.strength);
  if (const auto* texts = std::get_if<Shared<std::vector<std::string>>>(&voice.value)) {
    std::string list;
    for (const std::string& text : **texts) list += (list.empty() ? "`" : ", `") + text + "`";
    return list.empty() ? "adds nothing" : "adds " + list;
  }
  if (port.rule != CombineRule::sum) {
    if (std::holds_alternative<Vector3>(voice.value)) return "wants another place" + loudness;
    const std::string verb = port.rule == CombineRule::total ? "adds " : "wants ";
    return verb + quantity(as_number(voice.value), port.unit) + loudness;
  }
  const auto* move = std::get_if<Vector3>(&voice.value);
  if (move == nullptr) return "pulls by " + quantity(as_number(voice.value), port.unit) + loudness;
  if (norm(*move) < 1e-3 * voice.magnitude || norm(*move) == 0)
    return "pulls both ways, " + quantity(voice.magnitude, port.unit) + " in all" + loudness;
  return "pulls " + quantity(norm(*move), port.unit) + " " + direction_of(*move, state.plan->settings.true_north) + loudness;
}

double severity_of(const State& state, PortRef ref, double tension) { return tension / size_of(state, ref); }

namespace {

bool is_limit(const PortDefinition& port) { return port.rule == CombineRule::min || port.rule == CombineRule::max; }

bool is_minor(const State& state, PortRef ref, double severity) {
  const Value& value = state.value(ref);
  if (std::holds_alternative<Vector3>(value)) return severity < kMinorPull;
  return severity < std::max(kMinorSeverity, state.plan->settings.tolerance) || !has_effect(state, ref);
}

}  // namespace

bool takes_part(const State& state, const Voice& voice) {
  const PortDefinition& port = state.plan->port(voice.target);
  if (!is_limit(port) || !std::holds_alternative<double>(voice.value)) return true;
  constexpr double kRounding = 1e-9;
  const double wants = as_number(voice.value), is = as_number(state.value(voice.target)), hair = kRounding * std::abs(is);
  return port.rule == CombineRule::min ? wants <= is + hair : wants >= is - hair;
}

void add_tense_ports(const State& state, std::uint32_t node, std::vector<TensePort>& tense) {
  for (std::uint16_t t = 0; t < state.nodes[node].types.size(); ++t) {
    const Tensions& tension = state.nodes[node].types[t].tension;
    for (std::uint16_t p = 0; p < tension.size(); ++p) {
      if (!(tension[p] > 0)) continue;
      const PortRef ref{node, t, p};
      // The tightest limit is in force: who leaves more contradicts nobody. Only a lock keeps a tighter one out.
      if (is_limit(state.plan->port(ref)) && !state.plan->nodes[node].types[t].is_locked[p]) continue;
      const double severity = severity_of(state, ref, tension[p]);
      tense.push_back({ref, tension[p], severity, is_minor(state, ref, severity)});
    }
  }
  // A limit alone contradicts no other limit; it contradicts the storeys that are wished.
  if (const auto withheld = withheld_height(state, node))
    tense.push_back({withheld->limit, withheld->height, withheld->share, false});
}

std::vector<TensePort> tense_ports(const State& state) {
  std::vector<TensePort> tense;
  for (std::uint32_t n = 0; n < state.nodes.size(); ++n) add_tense_ports(state, n, tense);
  return tense;
}

ConflictRow conflict_row(const State& state, const TensePort& tense) {
  const PortRef ref = tense.ref;
  const PortDefinition& port = state.plan->port(ref);
  ConflictRow row;
  row.node = state.plan->nodes[ref.node].name;
  row.node_id = state.plan->nodes[ref.node].id;
  row.port = state.plan->path_text(ref);
  row.tension = quantity(tense.tension, port.unit);
  row.amount = tense.tension;
  row.severity = tense.severity;
  row.ref = ref;
  for (std::size_t l = 0; l < state.links.size(); ++l) {
    const LinkPlan& link = state.plan->links[l];
    if (!link.is_enabled || link.is_muted) continue;
    const std::vector<Voice>& voices = state.links[l].voices;
    auto voice = std::lower_bound(voices.begin(), voices.end(), ref, [](const Voice& v, PortRef r) { return v.target < r; });
    for (; voice != voices.end() && voice->target == ref; ++voice) {
      const bool says_something = voice->magnitude > 0 || port.rule != CombineRule::sum;
      if (!(voice->strength > 0) || !says_something || !takes_part(state, *voice)) continue;
      row.pulls.push_back(speaker(link) + voice_text(state, *voice));
      row.links.push_back(link.id);
    }
  }
  if (std::string own = own_word(state.plan->nodes[ref.node].types[ref.type], ref.port, wish_at(state, ref)); !own.empty()) {
    row.pulls.push_back(std::move(own));
    row.links.emplace_back();
  }
  return row;
}

void read_conflicts(const State& state, ReportModel& model) {
  for (const TensePort& tense : tense_ports(state)) {
    if (tense.is_minor) ++model.minor_conflicts;
    else model.conflicts.push_back(conflict_row(state, tense));
  }
  std::stable_sort(model.conflicts.begin(), model.conflicts.end(),
                   [](const ConflictRow& a, const ConflictRow& b) { return a.severity > b.severity; });
  model.pullers = pullers_of(state, model.conflicts);
}

std::vector<PullerRow> pullers_of(const State& state, const std::vector<ConflictRow>& conflicts) {
  std::map<std::string, PullerRow> by_link;
  double all = 0;
  for (const ConflictRow& conflict : conflicts) {
    const std::set<std::string> who(conflict.links.begin(), conflict.links.end());
    for (const std::string& link : who) {
      PullerRow& row = by_link[link];
      row.link = link;
      ++row.conflicts;
      row.share += conflict.severity / static_cast<double>(who.size());
      all += conflict.severity / static_cast<double>(who.size());
    }
  }
  std::vector<PullerRow> rows;
  for (auto& [link, row] : by_link) {
    const std::size_t index = link_index(*state.plan, link);
    if (link.empty()) row.kind = "set or locked by hand";
    else if (index < state.plan->links.size() && state.plan->links[index].definition != nullptr)
      row.kind = state.plan->links[index].definition->label;
    if (all > 0) row.share /= all;
    rows.push_back(std::move(row));
  }
  std::stable_sort(rows.begin(), rows.end(), [](const PullerRow& a, const PullerRow& b) { return a.share > b.share; });
  return rows;
}

bool has_error(const State& state, std::size_t link) { return state.links[link].error || state.plan->links[link].error; }

std::vector<std::uint32_t> links_with_errors(const State& state) {
  std::vector<std::uint32_t> links;
  for (std::uint32_t l = 0; l < state.links.size(); ++l)
    if (has_error(state, l)) links.push_back(l);
  return links;
}

namespace {

// Nodes that may have something to say: those that fail, and solvers.
std::set<std::uint32_t> nodes_to_ask(const State& state, const std::vector<Row<SolverFigures>>& solvers) {
  std::set<std::uint32_t> nodes;
  for (const auto& solver : solvers) nodes.insert(solver.node);
  for (std::size_t leaf = 0; leaf < state.nodes.leaf_count(); ++leaf) {
    if (!state.nodes.digest(leaf).has_failure) continue;
    const std::size_t end = std::min(state.nodes.size(), (leaf + 1) * NodeStates::kLeaf);
    for (std::size_t n = leaf * NodeStates::kLeaf; n < end; ++n)
      if (state.nodes[n].has_failure) nodes.insert(static_cast<std::uint32_t>(n));
  }
  return nodes;
}

}  // namespace

std::vector<ProblemRow> rule_problems(const State& state) {
  std::vector<ProblemRow> rows;
  if (state.tick == 0) return rows;
  const auto add = [&](std::uint32_t plot, const std::string& text, std::vector<std::string> others) {
    const NodePlan& node = state.plan->nodes[plot];
    rows.push_back({"node " + node.name, text, node.id, "", false, false, true, std::move(others)});
  };
  for (BrokenRule& rule : broken_rules(state)) add(rule.plot, rule.text, std::move(rule.volumes));
  for (const auto& [node, figures] : reading::rows<PlotFigures>(state))
    if (!figures.message.empty()) add(node, figures.message, {});
  return rows;
}

std::vector<ProblemRow> failures_of(const State& state, const std::vector<std::uint32_t>& links) {
  const Plan& plan = *state.plan;
  std::vector<ProblemRow> rows;
  std::set<std::pair<std::string, std::string>> said;
  const auto add = [&](ProblemRow row) {
    if (said.emplace(row.place, row.message).second) rows.push_back(std::move(row));
  };
  const std::vector<Row<SolverFigures>> solvers = reading::rows<SolverFigures>(state);
  auto solver = solvers.begin();
  for (const std::uint32_t n : nodes_to_ask(state, solvers)) {
    const std::string& id = plan.nodes[n].id;
    for (std::size_t t = 0; t < state.nodes[n].types.size(); ++t)
      if (const auto& error = state.nodes[n].types[t].error)
        add({"node " + plan.nodes[n].name + ", " + plan.nodes[n].types[t].definition->label, error->text(), id, "", false});
    if (solver == solvers.end() || solver->node != n) continue;
    if (!solver->figures.message.empty()) add({"node " + plan.nodes[n].name, solver->figures.message, id, "", true});
    ++solver;
  }
  for (const auto& [node, figures] : reading::rows<StandingFigures>(state))
    if (!figures.message.empty()) add({"node " + plan.nodes[node].name, figures.message, plan.nodes[node].id, "", true});
  for (ProblemRow& row : rule_problems(state)) add(std::move(row));
  for (SunShortage& shortage : sun_shortages(state)) {
    const NodePlan& node = plan.nodes[shortage.receiver];
    add({"node " + node.name, std::move(shortage.text), node.id, "", true});
  }
  for (const std::uint32_t l : links) {
    const auto& error = state.links[l].error ? state.links[l].error : plan.links[l].error;
    add({"link " + plan.links[l].id, error->text(), "", plan.links[l].id, false});
  }
  // What has kept a node from running is its own error already.
  for (const SetPlan& set : plan.sets)
    if (set.error && !state.nodes[set.node].types[set.type].error)
      add({"node " + plan.nodes[set.node].name, set.error->text(), plan.nodes[set.node].id, "", false});
  return rows;
}

void read_problems(const State& state, ReportModel& model) {
  const Plan& plan = *state.plan;
  model.problems = failures_of(state, links_with_errors(state));
  std::set<std::pair<std::string, std::string>> said;
  for (const ProblemRow& row : model.problems) said.emplace(row.place, row.message);
  for (const PlaceProblem& problem : place_problems(state)) {
    const std::string& first = problem.nodes.front();
    ProblemRow row{"node " + plan.nodes[plan.node_index(first)].name, problem.sentence(), first, "", false, true};
    if (said.emplace(row.place, row.message).second) model.problems.push_back(std::move(row));
  }
  if (state.tick == 0) return;
  for (const OpenAccount& open : open_accounts(state))
    if (std::string text = shortage_of(open, account_tolerance(state)); !text.empty())
      model.problems.push_back({"open space " + open.use, std::move(text), "", "", true});
}

}  // namespace bl::reading
