// Volumes and uses are read by the report, so that table, JSON and page cannot disagree; conflicts and faults are added for
// programs.
#include "ui/cli/survey.h"

#include <algorithm>
#include <map>

#include "core/geometry/fit_text.h"
#include "core/reading/place_problems.h"
#include "core/reading/report_model.h"

namespace bl::cli {

namespace {

constexpr const char *kVolume = "smart_volume", *kSolver = "smart_volumes_solver";

std::uint32_t count_of(const State& state) { return static_cast<std::uint32_t>(state.nodes.size()); }

// What the page says of the volume, and what only tables have room for.
VolumeRow volume_row(const State& state, const report::VolumeRow& read) {
  const auto number = [&](const char* port) { return report::number_at(state, read.node, kVolume, port); };
  VolumeRow row;
  row.id = read.id;
  row.name = state.plan->nodes[read.node].name;
  row.use = read.use;
  row.state = read.state;
  row.reason = read.reason;
  row.position = report::point_at(state, read.node, "node", "position");
  row.weight = number("weight");
  static_cast<report::Account&>(row) = read;
  row.demand = read.limited;
  row.cell_volume = number("cell_volume");
  row.error = number("error");
  row.surface_area = number("surface_area");
  row.footprint = number("footprint");
  row.spherical_area = number("spherical_area");
  row.storey_height = read.storey_height;
  row.height = number("height");
  row.bottom = number("bottom");
  return row;
}

void add_totals(const State& state, const report::ReportModel& model, Survey& survey) {
  std::map<std::string, UseRow> uses;
  for (const report::UseAccount& read : model.accounts.uses)
    uses[read.use] = {read, 0, report::why_short(state, model.accounts, read)};
  for (const VolumeRow& volume : survey.volumes) uses[volume.use].alive += volume.state == "alive" ? 1 : 0;
  survey.all.account = model.accounts.all;
  for (const auto& [name, use] : uses) {
    survey.all.alive += use.alive;
    survey.uses.push_back(use);
  }
  survey.tolerance = model.accounts.tolerance;
  survey.worst_short = model.accounts.worst_short;
  survey.worst_short_of = model.accounts.worst;
}

std::vector<VolumeRow> volume_rows(const State& state, const report::ReportModel& model) {
  std::vector<VolumeRow> rows;
  for (const report::VolumeRow& volume : model.volumes) rows.push_back(volume_row(state, volume));
  return rows;
}

std::vector<Pull> pulls_on(const State& state, PortRef target) {
  std::vector<Pull> pulls;
  for (std::size_t l = 0; l < state.links.size(); ++l) {
    if (state.plan->links[l].is_muted) continue;
    for (const Voice& voice : state.links[l].voices)
      if (voice.target == target) pulls.push_back({state.plan->links[l].id, voice.value, voice.strength, false});
  }
  const TypePlan& type = state.plan->nodes[target.node].types[target.type];
  const bool has_voice = type.is_set[target.port] && type.definition->ports[target.port].rule == CombineRule::blend;
  if (type.is_locked[target.port] || has_voice)
    pulls.push_back({"", type.set_values[target.port], 1, type.is_locked[target.port]});
  return pulls;
}

std::vector<TensionRow> tensions_of(const State& state) {
  std::vector<TensionRow> rows;
  for (std::uint32_t n = 0; n < count_of(state); ++n)
    for (std::uint16_t t = 0; t < state.nodes[n].types.size(); ++t)
      for (std::uint16_t p = 0; p < state.nodes[n].types[t].tension.size(); ++p) {
        const double tension = state.nodes[n].types[t].tension[p];
        if (!(tension > 1e-3)) continue;  // a millimetre, a litre: nothing that anybody feels
        const PortRef ref{n, t, p};
        const std::string unit(info(state.plan->port(ref).unit).pretty);
        rows.push_back({state.plan->nodes[n].id, state.plan->path_text(ref), unit, tension, pulls_on(state, ref)});
      }
  std::stable_sort(rows.begin(), rows.end(), [](const TensionRow& a, const TensionRow& b) { return a.tension > b.tension; });
  return rows;
}

bool takes_care_of(const Plan& plan, std::uint32_t solver, std::uint32_t volume) {
  return std::any_of(plan.sets.begin(), plan.sets.end(), [&](const SetPlan& set) {
    return set.node == solver && !set.writes.empty() && std::binary_search(set.members.begin(), set.members.end(), volume);
  });
}

// What a solver says, with the shortages of the table: two accounts of one thing would be one too many.
std::string told_by(const State& state, const report::ReportModel& model, std::uint32_t solver) {
  std::vector<DemandLoss> losses;
  std::vector<std::string> names;
  for (const report::VolumeRow& volume : model.volumes) {
    if (!takes_care_of(*state.plan, solver, volume.node)) continue;
    if (volume.limited - volume.volume > model.accounts.tolerance * volume.limited)
      losses.push_back({static_cast<std::uint32_t>(names.size()), volume.limited, volume.volume});
    names.push_back(volume.id);
  }
  return with_losses(report::text_at(state, solver, kSolver, "message"), losses, names);
}

}  // namespace

std::vector<VolumeRow> volumes_of(const State& state) {
  report::ReportModel model;
  report::read_figures(state, model);
  return volume_rows(state, model);
}

std::string solver_message(const State& state) {
  std::string message;
  report::ReportModel model;
  report::read_figures(state, model);
  for (std::uint32_t n = 0; n < count_of(state); ++n) {
    if (!report::has_type(state, n, kSolver)) continue;
    if (const std::string said = told_by(state, model, n); !said.empty()) message += (message.empty() ? "" : "; ") + said;
  }
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
  for (std::size_t l = 0; l < state.links.size(); ++l)
    if (const auto& error = state.links[l].error) {
      const std::string prefix = "links/" + state.plan->links[l].id;
      problems.push_back(error->place.starts_with(prefix) ? *error : error->within(prefix));
    }
  return problems;
}

Survey survey_of(const State& state) {
  Survey survey;
  report::ReportModel model;
  report::read_figures(state, model);
  survey.volumes = volume_rows(state, model);
  for (std::size_t k = 0; k < survey.volumes.size(); ++k)
    survey.volumes[k].why_short = report::why_short(state, model.accounts, model.volumes[k]);
  add_totals(state, model, survey);
  survey.tensions = tensions_of(state);
  report::read_conflicts(state, model);
  survey.pullers = std::move(model.pullers);
  survey.problems = problems_of(state);
  for (const report::PlaceProblem& problem : report::place_problems(state))
    survey.problems.push_back({ErrorCode::infeasible, "nodes/" + problem.nodes.front(), problem.sentence()});
  for (std::uint32_t n = 0; n < count_of(state); ++n)
    if (report::has_type(state, n, kSolver)) {
      const auto number = [&](const char* port) { return report::number_at(state, n, kSolver, port); };
      survey.solvers.push_back({state.plan->nodes[n].id, told_by(state, model, n), number("boundary_volume"),
                                number("total_demand"), number("total_volume")});
    }
  for (const VolumeRow& volume : survey.volumes)
    if (volume.error > survey.worst_error) {
      survey.worst_error = volume.error;
      survey.worst = volume.id;
    }
  return survey;
}

}  // namespace bl::cli
