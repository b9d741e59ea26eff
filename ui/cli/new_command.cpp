// `new`: makes a scene that can run from a plan boundary and a programme.
#include <sys/stat.h>
#include <algorithm>
#include <cmath>

#include "core/base/text.h"
#include "core/file/file_io.h"
#include "core/file/scene_file.h"
#include "ui/cli/commands.h"
#include "ui/cli/scene_loading.h"
#include "ui/cli/terminal.h"

namespace bl::cli {

namespace {

constexpr double kTightFill = 0.9;

void print_figures(const making::NewOptions& o, const making::MadeScene& made) {
  const importing::PlanBoundary& plan = *made.plan;
  const making::SceneParts& parts = made.parts;
  const double plan_area = made.plan_area, demand = made.demand, space = (plan_area - parts.open_area()) * parts.height,
               fill = made.fill();
  const std::string added = plan_area > plan.area ? ", of which the hull adds " + fixed(plan_area - plan.area, 1) + " m²" : "";
  const std::string holes = parts.holes.empty() ? "" : " and " + counted(parts.holes.size(), "hole");
  print_line("boundary:  " + counted(parts.plan.size(), "corner") + holes + ", " + fixed(plan_area, 1) + " m²" + added + ", " +
             shortest(parts.height) + " m high, " + fixed(space, 1) + " m³");
  print_line("place:     latitude " + fixed(plan.reference.latitude, 6) + "°, longitude " + fixed(plan.reference.longitude, 6) +
             "°, from " + plan.source_crs);
  print_line("programme: " + counted(parts.programme.rows.size(), "use") + ", " + counted(parts.programme.items, "volume") +
             ", " + fixed(parts.programme.floor_area, 1) + " m² floor area, " + fixed(demand, 1) + " m³");
  double asked = 0;
  for (const importing::ProgrammeRow& row : parts.programme.rows) asked += row.is_open ? row.floor_area * row.count : 0;
  if (asked > 0)
    print_line("open:      " + fixed(parts.open_area(), 1) + " m² of " + fixed(asked, 1) + " m² of open space asked for");
  print_line("density:   floor space index " + fixed(parts.programme.floor_area / plan_area, 2) +
             " (floor area / plan area), fill " + fixed(100 * fill, 1) + " % (demanded volume / boundary volume)");
  // Storeys that a brief gives are a wish that nothing raises: more height would not help then.
  const bool has_storeys = std::any_of(parts.programme.rows.begin(), parts.programme.rows.end(),
                                       [](const importing::ProgrammeRow& row) { return row.storeys > 0; });
  if (has_storeys && made.footprints > made.ground() * (1 + 1e-9))
    print_error(o.out, {ErrorCode::infeasible, "",
                        "warning: with the storeys that the brief gives, the buildings need " + fixed(made.footprints, 0) +
                            " m² of ground, and there are " + fixed(made.ground(), 0) + " m²: " +
                            (fill > 1 ? "give more storeys, and a height for them, or less floor area"
                                      : "give more storeys, for which the height leaves room, or less floor area")});
  else if (fill > 1)
    print_error(o.out, {ErrorCode::infeasible, "",
                        "warning: the demands do not fit into the boundary; they need a height of at least " +
                            fixed(std::ceil(10 * demand / (plan_area - parts.open_area())) / 10, 1) + " m"});
  else if (fill > kTightFill)
    print_error(o.out, {ErrorCode::infeasible, "", "warning: the boundary will be nearly full; little is left to negotiate"});
}

}  // namespace

int new_command(const making::NewOptions& options) {
  const Registry& registry = full_registry();
  struct stat status {};
  if (!options.is_forced && ::stat(options.out.c_str(), &status) == 0) {
    print_error(options.out, {ErrorCode::conflict, "", "exists already; choose another name, or replace it with --force"});
    return kBadInput;
  }
  const making::MadeScene made = making::make_scene(options, registry);
  for (const std::string& note : made.notes) print_line("note: " + note);
  for (const auto& [file, warning] : made.warnings)
    print_error(file, {warning.code, warning.place, "warning: " + warning.message});
  for (const auto& [file, error] : made.errors) print_error(file, error);
  if (!made.scene) return kBadInput;
  print_problems(options.out, check_scene(*made.scene, registry));
  if (auto written = write_file(options.out, write_scene(*made.scene, registry)); !written) {
    print_error(options.out, written.error());
    return kBadInput;
  }
  print_figures(options, made);
  print_line("wrote " + options.out + ": " + counted(made.scene->nodes.size(), "node") + ", " +
             counted(made.scene->links.size(), "link") + "; next: behaviourlinks run " + options.out);
  return kDone;
}

}  // namespace bl::cli
