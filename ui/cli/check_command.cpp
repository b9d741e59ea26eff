// `check`: says everything that is wrong with scene files, and rewrites them in the one canonical form on request.
#include <algorithm>

#include <nlohmann/json.hpp>

#include "core/file/file_io.h"
#include "core/live/unusable_sensors.h"
#include "core/making/script_file.h"
#include "core/reading/survey.h"
#include "core/reading/views/stream.h"
#include "core/script/link_script.h"
#include "core/session/session.h"
#include "ui/cli/commands.h"
#include "ui/cli/scene_loading.h"
#include "ui/cli/script_trial.h"
#include "ui/cli/terminal.h"

namespace bl::cli {

namespace {

// Ticks after which every node and link has seen the others: what fails then is wrong with the scene, not with its start.
constexpr int kTrialTicks = 3;

struct Checked {
  std::vector<Problem> problems;
  std::size_t nodes = 0, links = 0;
  bool is_rewritten = false;
  std::size_t errors() const {
    return static_cast<std::size_t>(std::count_if(problems.begin(), problems.end(), [](const Problem& p) { return p.is_error; }));
  }
};

// Kinds of scripts that no link uses fail at nobody's tick.
void try_scripts(const Scene& scene, std::vector<Problem>& problems) {
  const Registry& types = scene.scripts.types(full_registry());
  for (const auto& [name, kind] : scene.scripts.kinds()) {
    const LinkDefinition* definition = types.link(kind);
    const bool is_used = std::any_of(scene.links.begin(), scene.links.end(), [&id = kind](const auto& entry) {
      return entry.second.kind == id && entry.second.is_enabled;
    });
    if (definition == nullptr || is_used) continue;
    if (const auto fault = fault_of_kind(*definition, types))
      problems.push_back({fault->is_certain, fault->error.within("scripts/" + name)});
  }
}

// A check has no devices: that a sensor has brought nothing yet is no fault of the scene, and neither is it one of what waits for
// it.
bool waits_for_sensor(const State& state, const Scene& scene, const Error& error) {
  constexpr std::string_view kLinks = "links/";
  if (error.code != ErrorCode::missing || !error.place.starts_with(kLinks)) return false;
  const std::string id = error.place.substr(kLinks.size(), error.place.find('/', kLinks.size()) - kLinks.size());
  const auto link = scene.links.find(id);
  if (link == scene.links.end()) return false;
  const auto is_silent = [&state](const std::string& node) {
    const std::uint32_t index = state.plan->node_index(node);
    const std::string quality = reading::read<&reading::SensorFigures::quality>(state, index);
    return quality == "never" || quality == "stale";
  };
  const std::vector<std::string> from = resolve(scene, full_registry(), link->second.from);
  return std::any_of(from.begin(), from.end(), is_silent);
}

// That somebody goes without is no fault of the scene, and after so few ticks mostly only not reached yet.
bool is_wish(const State& state, const Error& error) {
  for (std::size_t l = 0; l < state.links.size(); ++l)
    if (state.links[l].remark == LinkRemark::short_of && state.links[l].error == error) return true;
  return false;
}

// What only shows when the scene runs: a boundary that crosses itself, a volume outside, demands that cannot be met.
void try_out(const SceneReading& reading, std::vector<Problem>& problems) {
  auto session = Session::start(full_registry(), reading.scene, reading.state ? &*reading.state : nullptr, 1);
  if (!session) return problems.push_back({true, session.error()});
  for (int i = 0; i < kTrialTicks; ++i) (*session)->tick();
  const State& state = *(*session)->state();
  for (Error& error : reading::problems_of(state)) {
    const bool is_known = std::any_of(problems.begin(), problems.end(), [&](const Problem& p) { return p.error == error; });
    if (is_known) continue;
    const bool is_error = !waits_for_sensor(state, reading.scene, error) && !is_wish(state, error);
    problems.push_back({is_error, std::move(error)});
  }
  for (Error& error : live::unusable_sensors(reading.scene)) problems.push_back({true, std::move(error)});
  try_scripts(reading.scene, problems);
  for (const auto& [node, volume] : reading::rows<reading::VolumeFigures>(state))
    if (volume.state == "coincident" || volume.state == "outside" || volume.state == "idle")
      problems.push_back({false,
                          {ErrorCode::geometry, "nodes/" + state.plan->nodes[node].id,
                           "is " + volume.state + (volume.reason.empty() ? "" : ": " + volume.reason)}});
  if (const std::string message = reading::solver_message(state); !message.empty())
    problems.push_back({false, {ErrorCode::infeasible, "", message}});
}

Checked check_file(const std::string& file, bool is_writing) {
  Checked checked;
  const auto text = read_file(file);
  if (!text) {
    checked.problems.push_back({true, text.error()});
    return checked;
  }
  if (file.ends_with(".lua")) {
    auto kind = script::read_link_script(making::script_name(file), *text, full_registry());
    if (!kind) checked.problems.push_back({true, kind.error()});
    else if (auto fault = fault_of_kind(*kind, full_registry())) checked.problems.push_back({fault->is_certain, fault->error});
    return checked;
  }
  SceneReading reading = read_scene(*text, full_registry());
  checked.problems = reading.problems;
  checked.nodes = reading.scene.nodes.size();
  checked.links = reading.scene.links.size();
  if (!reading.is_usable()) return checked;
  try_out(reading, checked.problems);
  if (!is_writing || checked.errors() > 0) return checked;
  const std::string canonical = write_scene(reading.scene, full_registry(), reading.state ? &*reading.state : nullptr);
  if (canonical == *text) return checked;
  if (auto written = write_file(file, canonical); !written) checked.problems.push_back({true, written.error()});
  else checked.is_rewritten = true;
  return checked;
}

Json checked_json(const std::string& file, const Checked& checked) {
  Json problems = Json::array();
  for (const bool is_error : {true, false})
    for (const Problem& problem : checked.problems) {
      if (problem.is_error != is_error) continue;
      const Error error = bounded(problem.error);
      problems.push_back({{"severity", is_error ? "error" : "warning"},
                          {"code", std::string(name_of(error.code))},
                          {"place", error.place},
                          {"message", error.message}});
    }
  return {{"file", file},
          {"ok", checked.errors() == 0},
          {"nodes", checked.nodes},
          {"links", checked.links},
          {"problems", std::move(problems)}};
}

}  // namespace

int check_command(const CheckOptions& options) {
  bool is_all_well = true;
  Json list = Json::array();
  for (const std::string& file : options.scenes) {
    const Checked checked = check_file(file, options.is_writing);
    print_problems(file, checked.problems);
    list.push_back(checked_json(file, checked));
    const std::size_t errors = checked.errors(), warnings = checked.problems.size() - errors;
    const std::string prefix = options.scenes.size() > 1 ? file + ": " : "";
    is_all_well &= errors == 0;
    if (errors > 0) {
      print_line(prefix + "not ok: " + counted(errors, "error") + (warnings > 0 ? ", " + counted(warnings, "warning") : "") +
                     (options.is_writing ? "; not rewritten" : ""),
                 Colour::red);
      continue;
    }
    print_line(prefix + "ok: " +
                   (file.ends_with(".lua") ? std::string("a link script")
                                           : counted(checked.nodes, "node") + ", " + counted(checked.links, "link")) +
                   (warnings > 0 ? ", " + counted(warnings, "warning") : "") + (checked.is_rewritten ? "; rewritten" : ""),
               Colour::green);
  }
  if (!options.json.empty())
    if (auto written = write_file(options.json, write_json(Json{{"scenes", std::move(list)}}) + "\n"); !written) {
      print_error(options.json, written.error());
      return kBadInput;
    }
  return is_all_well ? kDone : kBadInput;
}

}  // namespace bl::cli
