// Volumes and uses are read by the report, so that table, JSON and page cannot disagree; conflicts and faults are added for programs.
#include "ui/cli/survey.h"

#include <algorithm>
#include <map>

#include "ui/cli/report/place_problems.h"
#include "ui/cli/report/report_model.h"

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
  // Before a solver has seen the volume it has no wanted volume yet; the demand is the next best word.
  row.demand = read.state == "idle" ? read.demand : read.wanted;
  row.volume = read.volume;
  row.cell_volume = number("cell_volume");
  row.error = number("error");
  row.floor_area = read.floor_area;
  row.surface_area = number("surface_area");
  row.footprint = number("footprint");
  row.spherical_area = number("spherical_area");
  row.storey_height = read.storey_height;
  row.height = number("height");
  row.bottom = number("bottom");
  return row;
}

std::map<std::string, double> wanted_volumes(const State& state) {
  std::map<std::string, double> wanted;
  for (std::uint32_t n = 0; n < count_of(state); ++n)
    if (const Table* rows = report::table_at(state, n, "programme", "rows"))
      for (std::size_t r = 0; r < rows->rows.size(); ++r)
        wanted[rows->text(r, "use")] += rows->number(r, "floor_area") * rows->number(r, "count") * rows->number(r, "storey_height");
  return wanted;
}

void add_totals(const State& state, const report::ReportModel& model, Survey& survey) {
  const std::map<std::string, double> wanted = wanted_volumes(state);
  std::map<std::string, UseRow> uses;
  for (const report::UseRow& read : model.uses) {
    UseRow& use = uses[read.use];
    use.use = read.use;
    use.is_in_programme = read.is_in_programme;
    use.volumes = read.count;
    use.floor_area = read.floor_area;
    use.volume = read.volume;
    if (!read.is_in_programme) continue;
    use.wanted_floor_area = read.wanted_floor_area;
    use.wanted_volume = wanted.at(read.use);
  }
  for (const VolumeRow& volume : survey.volumes) {
    uses[volume.use].alive += volume.state == "alive" ? 1 : 0;
    uses[volume.use].demand += volume.demand;
  }
  for (const auto& [name, use] : uses) {
    survey.all.is_in_programme |= use.is_in_programme;
    survey.all.volumes += use.volumes;
    survey.all.alive += use.alive;
    survey.all.wanted_floor_area += use.wanted_floor_area;
    survey.all.floor_area += use.floor_area;
    survey.all.wanted_volume += use.wanted_volume;
    survey.all.demand += use.demand;
    survey.all.volume += use.volume;
    survey.uses.push_back(use);
  }
  survey.all.use = "all";
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
      if (voice.target == target) pulls.push_back({state.plan->links[l].id, voice.value, voice.strength});
  }
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

}  // namespace

std::vector<VolumeRow> volumes_of(const State& state) {
  report::ReportModel model;
  report::read_figures(state, model);
  return volume_rows(state, model);
}

std::string solver_message(const State& state) {
  std::string message;
  for (std::uint32_t n = 0; n < count_of(state); ++n)
    if (const std::string said = report::text_at(state, n, kSolver, "message"); !said.empty())
      message += (message.empty() ? "" : "; ") + said;
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
  add_totals(state, model, survey);
  survey.tensions = tensions_of(state);
  survey.problems = problems_of(state);
  for (const report::PlaceProblem& problem : report::place_problems(state))
    survey.problems.push_back({ErrorCode::infeasible, "nodes/" + problem.nodes.front(), problem.sentence()});
  for (std::uint32_t n = 0; n < count_of(state); ++n)
    if (report::has_type(state, n, kSolver)) {
      const auto number = [&](const char* port) { return report::number_at(state, n, kSolver, port); };
      survey.solvers.push_back({state.plan->nodes[n].id, report::text_at(state, n, kSolver, "message"), number("boundary_volume"),
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
