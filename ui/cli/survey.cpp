// Reads a state by the names of its ports; which types there are, only the registry knows.
#include "ui/cli/survey.h"

#include <algorithm>
#include <map>

#include "core/base/text.h"

namespace bl::cli {

namespace {

const Value* value_at(const State& state, std::uint32_t node, std::string_view path) {
  const auto parsed = parse_port_path(path);
  const auto ref = parsed ? state.plan->find(node, *parsed) : std::nullopt;
  return ref ? &state.value(*ref) : nullptr;
}

bool has_type(const State& state, std::uint32_t node, std::string_view id) {
  const auto& types = state.plan->nodes[node].types;
  return std::any_of(types.begin(), types.end(), [&](const TypePlan& type) { return type.definition->id == id; });
}

std::uint32_t count_of(const State& state) { return static_cast<std::uint32_t>(state.nodes.size()); }

VolumeRow volume_row(const State& state, std::uint32_t node) {
  const auto number = [&](const char* port) { return number_at(state, node, std::string("smart_volume.") + port); };
  const auto text = [&](const char* port) { return text_at(state, node, std::string("smart_volume.") + port); };
  VolumeRow row;
  row.id = state.plan->nodes[node].id;
  row.name = state.plan->nodes[node].name;
  row.use = text("use");
  row.state = text("state");
  row.reason = text("reason");
  if (const Value* position = value_at(state, node, "node.position")) row.position = std::get<Vector3>(*position);
  row.weight = number("weight");
  // Before a solver has seen the volume it has no wanted volume yet; the demand is the next best word.
  row.demand = row.state == "idle" ? number("demand") : number("wanted");
  row.volume = number("volume");
  row.cell_volume = number("cell_volume");
  row.error = number("error");
  row.floor_area = number("floor_area");
  row.surface_area = number("surface_area");
  row.footprint = number("footprint");
  row.spherical_area = number("spherical_area");
  row.storey_height = number("storey_height");
  row.height = number("height");
  row.bottom = number("bottom");
  return row;
}

void add_programmes(const State& state, std::map<std::string, UseRow>& uses) {
  for (std::uint32_t n = 0; n < count_of(state); ++n) {
    const Value* value = value_at(state, n, "programme.rows");
    const auto* rows = value ? std::get_if<Shared<Table>>(value) : nullptr;
    if (rows == nullptr) continue;
    for (std::size_t r = 0; r < (*rows)->rows.size(); ++r) {
      UseRow& use = uses[(*rows)->text(r, "use")];
      const double area = (*rows)->number(r, "floor_area") * (*rows)->number(r, "count");
      use.is_in_programme = true;
      use.wanted_floor_area += area;
      use.wanted_volume += area * (*rows)->number(r, "storey_height");
    }
  }
}

void add_totals(const State& state, Survey& survey) {
  std::map<std::string, UseRow> uses;
  add_programmes(state, uses);
  for (const VolumeRow& volume : survey.volumes) {
    UseRow& use = uses[volume.use];
    ++use.volumes;
    use.alive += volume.state == "alive" ? 1 : 0;
    use.floor_area += volume.floor_area;
    use.demand += volume.demand;
    use.volume += volume.volume;
  }
  for (auto& [name, use] : uses) {
    use.use = name;
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

double number_at(const State& state, std::uint32_t node, std::string_view path) {
  const Value* value = value_at(state, node, path);
  return value ? as_number(*value) : 0;
}

std::string text_at(const State& state, std::uint32_t node, std::string_view path) {
  const Value* value = value_at(state, node, path);
  const std::string* text = value ? std::get_if<std::string>(value) : nullptr;
  return text ? *text : "";
}

std::vector<VolumeRow> volumes_of(const State& state) {
  std::vector<VolumeRow> rows;
  for (std::uint32_t n = 0; n < count_of(state); ++n)
    if (has_type(state, n, "smart_volume")) rows.push_back(volume_row(state, n));
  return rows;
}

std::string solver_message(const State& state) {
  std::string message;
  for (std::uint32_t n = 0; n < count_of(state); ++n)
    if (const std::string said = text_at(state, n, "smart_volumes_solver.message"); !said.empty())
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
  survey.volumes = volumes_of(state);
  add_totals(state, survey);
  survey.tensions = tensions_of(state);
  survey.problems = problems_of(state);
  for (std::uint32_t n = 0; n < count_of(state); ++n)
    if (has_type(state, n, "smart_volumes_solver"))
      survey.solvers.push_back({state.plan->nodes[n].id, text_at(state, n, "smart_volumes_solver.message"),
                                number_at(state, n, "smart_volumes_solver.boundary_volume"),
                                number_at(state, n, "smart_volumes_solver.total_demand"),
                                number_at(state, n, "smart_volumes_solver.total_volume")});
  for (const VolumeRow& volume : survey.volumes)
    if (volume.error > survey.worst_error) {
      survey.worst_error = volume.error;
      survey.worst = volume.id;
    }
  return survey;
}

}  // namespace bl::cli
