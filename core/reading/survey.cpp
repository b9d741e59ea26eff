// Volumes and uses are read by the report, so that table, JSON and page cannot disagree; conflicts and faults are added for
// programs.
#include "core/reading/survey.h"

#include <algorithm>
#include <map>

#include "core/geometry/fit_text.h"
#include "core/reading/place_problems.h"
#include "core/reading/report_model.h"
#include "core/reading/sun_problems.h"

namespace bl::reading {

namespace {

std::uint32_t count_of(const State& state) { return static_cast<std::uint32_t>(state.nodes.size()); }

void add_totals(const State& state, const ReportModel& model, Survey& survey) {
  std::map<std::string, UseRow> uses;
  for (const UseAccount& read : model.accounts.uses) uses[read.use] = {read, 0, why_short(state, model.accounts, read)};
  for (const VolumeRow& volume : survey.volumes) uses[volume.use].alive += volume.is_alive ? 1 : 0;
  survey.all.account = model.accounts.all;
  for (const auto& [name, use] : uses) {
    survey.all.alive += use.alive;
    survey.uses.push_back(use);
  }
  for (const OpenAccount& open : model.accounts.open) survey.open.push_back({open, why_short(open, model.accounts.tolerance)});
  survey.tolerance = model.accounts.tolerance;
  survey.worst_short = model.accounts.worst_short;
  survey.worst_short_of = model.accounts.worst;
}

std::vector<Pull> pulls_on(const State& state, PortRef target) {
  std::vector<Pull> pulls;
  for (std::size_t l = 0; l < state.links.size(); ++l) {
    if (state.plan->links[l].is_muted) continue;
    for (const Voice& voice : state.links[l].voices)
      if (voice.target == target && takes_part(state, voice))
        pulls.push_back({state.plan->links[l].id, voice.value, voice.strength, false});
  }
  const TypePlan& type = state.plan->nodes[target.node].types[target.type];
  const bool has_voice = type.is_set[target.port] && type.definition->ports[target.port].rule == CombineRule::blend;
  if (type.is_locked[target.port] || has_voice)
    pulls.push_back({"", type.set_values[target.port], 1, type.is_locked[target.port]});
  return pulls;
}

std::vector<TensionRow> tensions_of(const State& state) {
  std::vector<TensionRow> rows;
  for (const TensePort& tense : tense_ports(state)) {
    // A millimetre, a litre: nothing that anybody feels.
    if (!(tense.tension > 1e-3)) continue;
    const std::string unit(info(state.plan->port(tense.ref).unit).pretty);
    rows.push_back({state.plan->nodes[tense.ref.node].id, state.plan->path_text(tense.ref), unit, tense.tension, tense.severity,
                    tense.is_minor, pulls_on(state, tense.ref)});
  }
  std::stable_sort(rows.begin(), rows.end(), [](const TensionRow& a, const TensionRow& b) {
    return a.is_minor != b.is_minor ? b.is_minor : a.severity > b.severity;
  });
  return rows;
}

bool takes_care_of(const Plan& plan, std::uint32_t solver, std::uint32_t volume) {
  return std::any_of(plan.sets.begin(), plan.sets.end(), [&](const SetPlan& set) {
    return set.node == solver && !set.writes.empty() && std::binary_search(set.members.begin(), set.members.end(), volume);
  });
}

// What a solver says, with the shortages of the table: two accounts of one thing would be one too many.
std::string told_by(const State& state, const ReportModel& model, const reading::Row<reading::SolverFigures>& solver) {
  std::vector<geometry::DemandLoss> losses;
  std::vector<std::string> names;
  for (const VolumeRow& volume : model.volumes) {
    if (!takes_care_of(*state.plan, solver.node, volume.node)) continue;
    if (volume.limited - volume.volume > model.accounts.tolerance * volume.limited)
      losses.push_back({static_cast<std::uint32_t>(names.size()), volume.limited, volume.volume});
    names.push_back(volume.id);
  }
  return with_losses(solver.figures.message, losses, names);
}

}  // namespace

std::string solver_message(const State& state) {
  std::string message;
  ReportModel model;
  read_figures(state, model);
  for (const auto& solver : reading::rows<reading::SolverFigures>(state))
    if (const std::string said = told_by(state, model, solver); !said.empty()) message += (message.empty() ? "" : "; ") + said;
  return message;
}

std::vector<Error> problems_of(const State& state) {
  std::vector<Error> problems;
  for (std::uint32_t n = 0; n < count_of(state); ++n)
    for (std::size_t t = 0; t < state.nodes[n].types.size(); ++t)
      if (const auto& error = state.nodes[n].types[t].error) {
        const std::string& id = state.plan->nodes[n].id;
        const std::string prefix = "nodes/" + id + "/" + state.plan->nodes[n].types[t].definition->id;
        problems.push_back(error->place.starts_with("nodes/" + id) ? *error : error->within(prefix));
      }
  for (const auto& [node, figures] : reading::rows<StandingFigures>(state))
    if (!figures.message.empty())
      problems.push_back({ErrorCode::infeasible, "nodes/" + state.plan->nodes[node].id, figures.message});
  for (std::size_t l = 0; l < state.links.size(); ++l)
    if (const auto& error = state.links[l].error) {
      const std::string prefix = "links/" + state.plan->links[l].id;
      problems.push_back(error->place.starts_with(prefix) ? *error : error->within(prefix));
    }
  return problems;
}

std::vector<Error> rule_errors(const State& state) {
  std::vector<Error> errors;
  for (const ProblemRow& row : rule_problems(state)) errors.push_back({ErrorCode::infeasible, "nodes/" + row.node, row.message});
  for (SunShortage& shortage : sun_shortages(state))
    errors.push_back({ErrorCode::infeasible, "nodes/" + state.plan->nodes[shortage.receiver].id, std::move(shortage.text)});
  return errors;
}

Survey survey_of(const State& state) {
  Survey survey;
  ReportModel model;
  read_figures(state, model);
  for (const VolumeRow& volume : model.volumes) survey.why_volumes_short.push_back(why_short(state, model.accounts, volume));
  survey.volumes = model.volumes;
  add_totals(state, model, survey);
  survey.tensions = tensions_of(state);
  read_conflicts(state, model);
  survey.pullers = std::move(model.pullers);
  survey.problems = problems_of(state);
  for (Error& rule : rule_errors(state)) survey.problems.push_back(std::move(rule));
  for (const PlaceProblem& problem : place_problems(state))
    survey.problems.push_back({ErrorCode::infeasible, "nodes/" + problem.nodes.front(), problem.sentence()});
  for (const OpenRow& open : survey.open)
    if (!open.why_short.empty())
      survey.problems.push_back(
          {ErrorCode::infeasible, "open space " + open.account.use, shortage_of(open.account, survey.tolerance)});
  for (auto& solver : reading::rows<reading::SolverFigures>(state))
    survey.solvers.push_back({state.plan->nodes[solver.node].id, told_by(state, model, solver), std::move(solver.figures)});
  for (const VolumeRow& volume : survey.volumes)
    if (volume.figures.error > survey.worst_error) {
      survey.worst_error = volume.figures.error;
      survey.worst = volume.id;
    }
  return survey;
}

}  // namespace bl::reading
