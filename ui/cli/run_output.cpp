// Tables and JSON of a run.
#include "ui/cli/run_output.h"

#include <algorithm>

#include <nlohmann/json.hpp>

#include "core/base/text.h"
#include "core/define/codec.h"
#include "core/geometry/plates_table.h"
#include "core/reading/storeys.h"
#include "core/reading/views/building.h"
#include "core/reading/views/solver.h"
#include "core/reading/views/volume.h"
#include "core/report/figure_tables.h"
#include "ui/cli/scene_loading.h"
#include "ui/cli/terminal.h"

namespace bl::cli {

namespace {

constexpr std::size_t kShownTensions = 10, kShownPulls = 4;

std::string hundredths(double share, int decimals = 2) { return fixed(100 * share, decimals); }

// A percentage of nothing says nothing; who is not short has no figure.
std::string short_text(const reading::Account& account, double tolerance) {
  return account.is_short(tolerance) ? hundredths(account.short_share(), 1) : "";
}

void print_volumes(const reading::Survey& survey, double tolerance) {
  if (survey.volumes.empty()) return print_line("There are no SmartVolumes in this scene.");
  TextTable table({{"volume"},
                   {"use"},
                   {"asked m³", true},
                   {"limited to m³", true},
                   {"volume m³", true},
                   {"error %", true},
                   {"short %", true},
                   {"floor m²", true},
                   {"surface m²", true},
                   {"state"}});
  for (const reading::VolumeRow& row : survey.volumes) {
    const std::string name = row.name.empty() || row.name == row.id ? row.id : row.id + " (" + row.name + ")";
    const std::string state = row.figures.reason.empty() ? row.figures.state : row.figures.state + ": " + row.figures.reason;
    const Colour colour = !row.is_alive                                                     ? Colour::red
                          : row.figures.error > tolerance || row.is_short(survey.tolerance) ? Colour::yellow
                                                                                            : Colour::plain;
    table.add({name, row.use, fixed(row.asked, 1), fixed(row.limited, 1), fixed(row.volume, 1),
               row.limited > 1e-3 ? hundredths(row.figures.error) : "", short_text(row, survey.tolerance),
               fixed(row.floor_area, 1), fixed(row.figures.surface_area, 1), state},
              colour);
  }
  table.print();
}

void print_totals(const reading::Survey& survey) {
  if (survey.volumes.empty() && survey.uses.empty()) return;
  print_line();
  TextTable table({{"use"},
                   {"volumes", true},
                   {"asked floor m²", true},
                   {"floor m²", true},
                   {"asked m³", true},
                   {"limited to m³", true},
                   {"volume m³", true},
                   {"short %", true},
                   {"why"}});
  const auto add = [&](const reading::UseRow& row) {
    const reading::UseAccount& use = row.account;
    table.add({use.use.empty() ? "(none)" : use.use, std::to_string(use.volumes),
               use.is_in_programme ? fixed(use.asked_area, 1) : "no row", fixed(use.floor_area, 1), fixed(use.asked, 1),
               fixed(use.limited, 1), fixed(use.volume, 1), short_text(use, survey.tolerance), row.why_short},
              use.is_short(survey.tolerance) ? Colour::yellow : Colour::plain);
  };
  for (const reading::UseRow& use : survey.uses) add(use);
  if (survey.uses.size() > 1) {
    table.rule();
    add(survey.all);
  }
  table.print();
  for (const reading::SolverRow& solver : survey.solvers)
    if (solver.figures.boundary_volume > 0)
      print_line(solver.id + ": " + fixed(solver.figures.total_volume, 1) + " of " + fixed(solver.figures.total_demand, 1) +
                 " m³ in a boundary of " + fixed(solver.figures.boundary_volume, 1) + " m³ (" +
                 hundredths(solver.figures.total_volume / solver.figures.boundary_volume, 1) + " % full)");
  for (const reading::SolverRow& solver : survey.solvers)
    if (!solver.message.empty()) print_line(solver.id + ": " + solver.message, Colour::red);
}

// Ground is no floor area: it has a table of its own.
void print_open_space(const reading::Survey& survey) {
  if (survey.open.empty()) return;
  TextTable table({{"open space"}, {"asked m²", true}, {"open m²", true}, {"short %", true}, {"why"}});
  for (const reading::OpenRow& row : survey.open) {
    const reading::OpenAccount& open = row.account;
    const bool is_short = open.is_short(survey.tolerance);
    table.add({open.use, open.is_in_programme ? fixed(open.asked, 1) : "no row", fixed(open.area, 1),
               is_short ? hundredths(open.missing_share(), 1) : "", row.why_short},
              is_short ? Colour::yellow : Colour::plain);
  }
  print_line();
  table.print();
}

void print_storeys(const reading::Survey& survey, const State& state) {
  for (const reading::VolumeRow& volume : survey.volumes)
    if (const std::string why = reading::why_lower(state, volume.node); !why.empty())
      print_line(volume.id + " has " + why, Colour::yellow);
}

std::string amount(const Value& value, const std::string& unit) {
  const std::string suffix = unit.empty() ? "" : " " + unit;
  if (const auto* v = std::get_if<Vector3>(&value))
    return "(" + fixed(v->x, 3) + ", " + fixed(v->y, 3) + ", " + fixed(v->z, 3) + ")" + suffix;
  return fixed(as_number(value), 3) + suffix;
}

void print_tensions(const reading::Survey& survey) {
  const auto minor =
      std::find_if(survey.tensions.begin(), survey.tensions.end(), [](const reading::TensionRow& row) { return row.is_minor; });
  const auto listed = static_cast<std::size_t>(minor - survey.tensions.begin());
  if (listed == 0) return;
  print_line();
  TextTable table({{"conflict at"}, {"port"}, {"tension", true}, {"share", true}, {"links that pull"}});
  for (std::size_t i = 0; i < std::min(kShownTensions, listed); ++i) {
    const reading::TensionRow& row = survey.tensions[i];
    std::string pulls;
    for (std::size_t p = 0; p < std::min(kShownPulls, row.pulls.size()); ++p)
      pulls += (p > 0 ? ", " : "") +
               (row.pulls[p].link.empty() ? (row.pulls[p].is_locked ? "locked by hand" : "set by hand") : row.pulls[p].link) +
               " " + amount(row.pulls[p].value, row.unit);
    if (row.pulls.size() > kShownPulls) pulls += " and " + std::to_string(row.pulls.size() - kShownPulls) + " more";
    table.add({row.node, row.port, fixed(row.tension, 3) + (row.unit.empty() ? "" : " " + row.unit),
               fixed(100 * row.severity, 1) + " %", pulls.empty() ? "the value that is set" : pulls});
  }
  table.print();
  if (listed > kShownTensions)
    print_line("... and " + counted(listed - kShownTensions, "smaller conflict") + "; --json has all.");
}

}  // namespace

void print_survey(const reading::Survey& survey, const State& state) {
  // What volumes have before a solver has seen them is nobody's result, and no reason for anything.
  if (state.tick == 0) return;
  print_volumes(survey, state.plan->settings.tolerance);
  print_totals(survey);
  print_open_space(survey);
  print_storeys(survey, state);
  print_tensions(survey);
  if (!survey.problems.empty()) print_line();
  for (const Error& problem : survey.problems) print_line("problem: " + problem.text(), Colour::red);
  print_line();
}

namespace {

Json point_json(const Vector3& v) { return Json::array({v.x, v.y, v.z}); }

Json volume_json(const reading::VolumeRow& row, const std::string& why_short) {
  return {{"id", row.id},
          {"name", row.name},
          {"use", row.use},
          {"position", point_json(row.figures.position)},
          {"weight", row.figures.weight},
          {"asked", row.asked},
          {"demand", row.limited},
          {"volume", row.volume},
          {"short", row.missing()},
          {"short_share", row.short_share()},
          {"why_short", why_short},
          {"error", row.figures.error},
          {"cell_volume", row.figures.cell_volume},
          {"asked_floor_area", row.asked_area},
          {"floor_area", row.floor_area},
          {"short_floor_area", row.missing_area()},
          {"surface_area", row.figures.surface_area},
          {"spherical_area", row.figures.spherical_area},
          {"footprint", row.figures.footprint},
          {"storey_height", row.figures.storey_height},
          {"height", row.figures.height},
          {"bottom", row.figures.bottom},
          {"state", row.figures.state},
          {"reason", row.figures.reason}};
}

// How it stands; nothing of a volume that does not.
void add_footprint(const State& state, Json& volume) {
  const std::uint32_t node = state.plan->node_index(volume["id"].get<std::string>());
  const auto found = reading::row_of<reading::FootprintFigures>(state, node);
  volume["form"] = found ? found->form : "rounded";
  if (!found) return;
  volume["storeys"] = found->storeys_built;
  volume["storeys_wished"] = found->storeys;
  volume["why_lower"] = reading::why_lower(state, node);
  Json plates = Json::array();
  const geometry::StandingBody body = geometry::read_body(found->plates);
  // From the ground up; those below it first, from the lowest up, which are no part of the floor area.
  const auto cellars = reading::row_of<reading::CellarFigures>(state, node);
  for (std::int64_t storey = cellars->storeys; storey > 0 && !body.stacks.empty(); --storey)
    plates.push_back({{"bottom", body.stacks.front().bottom - static_cast<double>(storey) * cellars->storey_height},
                      {"area", cellars->area / static_cast<double>(cellars->storeys)},
                      {"use", volume["use"]},
                      {"is_cellar", true}});
  volume["cellar_area"] = cellars->area;
  for (const geometry::PlateStack& stack : body.stacks)
    for (int storey = 0; storey < stack.storeys; ++storey)
      plates.push_back({{"bottom", stack.bottom + storey * stack.storey_height}, {"area", stack.area}, {"use", volume["use"]}});
  if (const auto sharing = reading::row_of<reading::SharingFigures>(state, node); !sharing->shares.empty())
    volume["shares"] = sharing->shares.front();
  volume["plates"] = std::move(plates);
}

// The ground of each solver of standing volumes, under the id of the solver.
Json plots_json(const State& state) {
  Json plots = Json::array();
  for (const auto& [node, figures] : reading::rows<reading::StandingFigures>(state))
    plots.push_back({{"id", state.plan->nodes[node].id},
                     {"land_is", "net"},
                     {"fsi", figures.fsi},
                     {"gsi", figures.gsi},
                     {"osr", figures.osr},
                     {"storeys", figures.mean_storeys},
                     {"land", figures.plot_area},
                     {"open_space", figures.open_area}});
  return plots;
}

Json use_json(const reading::UseRow& row) {
  const reading::UseAccount& use = row.account;
  return {{"use", use.use},
          {"in_programme", use.is_in_programme},
          {"volumes", use.volumes},
          {"alive", row.alive},
          {"short_volumes", use.short_volumes},
          {"wanted_floor_area", use.asked_area},
          {"limited_floor_area", use.limited_area},
          {"floor_area", use.floor_area},
          {"wanted_volume", use.brief_volume},
          {"asked", use.asked},
          {"demand", use.limited},
          {"volume", use.volume},
          {"short", use.missing()},
          {"short_floor_area", use.missing_area()},
          {"short_share", use.short_share()},
          {"why_short", row.why_short}};
}

Json open_json(const reading::OpenRow& row) {
  const reading::OpenAccount& open = row.account;
  return {{"use", open.use},
          {"in_programme", open.is_in_programme},
          {"wanted_area", open.asked},
          {"area", open.area},
          {"drawn_area", open.drawn},
          {"short_area", open.missing()},
          {"short_share", open.missing_share()},
          {"why_short", row.why_short}};
}

Json tension_json(const reading::TensionRow& row, const State& state) {
  Json pulls = Json::array();
  const auto path = parse_port_path(row.port);
  const auto ref = state.plan->find(state.plan->node_index(row.node), *path);
  for (const reading::Pull& pull : row.pulls) {
    Json voice = Json::object();
    if (pull.link.empty()) voice["by_hand"] = pull.is_locked ? "locked" : "set";
    else voice["link"] = pull.link;
    voice["value"] = value_to_json(pull.value, state.plan->port(*ref));
    voice["strength"] = pull.strength;
    pulls.push_back(std::move(voice));
  }
  return {{"node", row.node},      {"port", row.port},         {"tension", row.tension},   {"unit", row.unit},
          {"share", row.severity}, {"is_minor", row.is_minor}, {"links", std::move(pulls)}};
}

}  // namespace

Json survey_json(const reading::Survey& survey, const State& state, const std::string& outcome) {
  Json json = Json::object();
  json["ticks"] = state.tick;
  json["settled"] = state.is_settled();
  json["hash"] = hex_digits(state.hash);
  json["outcome"] = outcome;
  // Volumes, totals and figures are what was computed: before the first tick there is nothing of the kind.
  if (state.tick == 0) {
    for (const char* list : {"volumes", "tensions", "conflicts_by", "problems"}) json[list] = Json::array();
    return json;
  }
  json["worst_error"] = survey.worst_error;
  json["worst"] = survey.worst;
  json["worst_short_share"] = survey.worst_short;
  json["worst_short"] = survey.worst_short_of;
  json["largest_move"] = state.largest_move;
  json["volumes"] = Json::array();
  for (std::size_t k = 0; k < survey.volumes.size(); ++k)
    add_footprint(state, json["volumes"].emplace_back(volume_json(survey.volumes[k], survey.why_volumes_short[k])));
  Json& totals = json["totals"] = use_json(survey.all);
  totals.erase("use");
  totals["uses"] = Json::array();
  for (const reading::UseRow& use : survey.uses) totals["uses"].push_back(use_json(use));
  totals["open_space"] = Json::array();
  for (const reading::OpenRow& open : survey.open) totals["open_space"].push_back(open_json(open));
  totals["solvers"] = Json::array();
  for (const reading::SolverRow& solver : survey.solvers)
    totals["solvers"].push_back({{"id", solver.id},
                                 {"message", solver.message},
                                 {"boundary_volume", solver.figures.boundary_volume},
                                 {"total_demand", solver.figures.total_demand},
                                 {"total_volume", solver.figures.total_volume}});
  json["tensions"] = Json::array();
  for (const reading::TensionRow& row : survey.tensions) json["tensions"].push_back(tension_json(row, state));
  json["conflicts_by"] = Json::array();
  for (const reading::PullerRow& row : survey.pullers)
    json["conflicts_by"].push_back({{"link", row.link}, {"kind", row.kind}, {"conflicts", row.conflicts}, {"share", row.share}});
  // Streets, sun, plots, surroundings: whatever the scene has of them.
  const Json figures = report::figure_json(state);
  for (const auto& [name, rows] : figures.items()) json[name] = rows;
  // Plots with rules are measured on all of their land.
  if (json.contains("plots"))
    for (Json& plot : json["plots"]) plot["land_is"] = "gross";
  // Ground that volumes stand on has figures of a plot, whether or not a plot with rules lies there.
  for (Json& plot : plots_json(state)) json["plots"].push_back(std::move(plot));
  json["problems"] = Json::array();
  for (const Error& problem : survey.problems)
    json["problems"].push_back(
        {{"code", std::string(name_of(problem.code))}, {"place", problem.place}, {"message", problem.message}});
  return json;
}

}  // namespace bl::cli
