// `new`: from a plan boundary and a programme to a scene that can run.
#include <sys/stat.h>
#include <cmath>
#include <optional>

#include "core/base/text.h"
#include "core/file/file_io.h"
#include "core/session/session.h"
#include "ui/cli/commands.h"
#include "ui/cli/new_scene.h"
#include "ui/cli/scene_loading.h"
#include "ui/cli/terminal.h"

namespace bl::cli {

namespace {

constexpr double kLargestHeight = 10000;  // [m]
constexpr double kTightFill = 0.9;

bool refuse(const std::string& place, const std::string& sentence) {
  print_error("", {ErrorCode::out_of_range, place, sentence});
  return false;
}

bool is_sound(const NewOptions& o) {
  bool is_well = true;
  if (!(o.height > 0) || !(o.height <= kLargestHeight))
    is_well = refuse("--height", "must be a height in m, more than 0 and at most " + shortest(kLargestHeight) + ", found " +
                                     shortest(o.height));
  if (!(o.storey_height >= 1) || !(o.storey_height <= 50))
    is_well = refuse("--storey-height", "must be between 1 and 50 m, found " + shortest(o.storey_height));
  if (!(o.margin >= 0) || !std::isfinite(o.margin))
    is_well = refuse("--margin", "must be 0 m or more, found " + shortest(o.margin));
  struct stat status {};
  if (!o.is_forced && ::stat(o.out.c_str(), &status) == 0)
    is_well = refuse(o.out, "exists already; choose another name, or replace it with --force");
  return is_well;
}

std::optional<std::string> text_of(const std::string& file) {
  auto text = read_file(file);
  if (text) return std::move(*text);
  print_error(file, text.error());
  return std::nullopt;
}

std::optional<PlanBoundary> load_plan(const NewOptions& o) {
  const auto text = text_of(o.boundary);
  if (!text) return std::nullopt;
  PlanOptions options;
  options.feature = o.feature;
  options.crs = o.crs;
  auto plan = read_plan_boundary(*text, options);
  if (!plan) {
    print_error(o.boundary, plan.error());
    return std::nullopt;
  }
  for (const std::string& note : plan->notes) print_line("note: " + o.boundary + ": " + note);
  return std::move(*plan);
}

std::optional<ProgrammeImport> load_programme(const NewOptions& o) {
  const auto text = text_of(o.programme);
  if (!text) return std::nullopt;
  ProgrammeOptions options;
  options.storey_height = o.storey_height;
  for (const std::string& column : o.columns) {
    const std::size_t equals = column.find('=');
    if (equals == std::string::npos || equals == 0) {
      refuse("--column", "expects OURS=HEADER such as use=\"Room name\", found `" + column + "`");
      return std::nullopt;
    }
    options.columns[column.substr(0, equals)] = column.substr(equals + 1);
  }
  auto programme = read_programme_csv(*text, options);
  if (!programme) {
    print_error(o.programme, programme.error());
    return std::nullopt;
  }
  for (const std::string& note : programme->notes) print_line("note: " + o.programme + ": " + note);
  return std::move(*programme);
}

std::string file_stem(const std::string& path) {
  const std::string name = path.substr(path.rfind('/') == std::string::npos ? 0 : path.rfind('/') + 1);
  const std::size_t dot = name.rfind('.');
  return dot == std::string::npos || dot == 0 ? name : name.substr(0, dot);
}

void print_figures(const NewOptions& o, const PlanBoundary& plan, const SceneParts& parts, double plan_area) {
  double demand = 0;
  for (const NewVolume& volume : volumes_of(parts.programme)) demand += volume.demand;
  const double space = plan_area * parts.height, fill = demand / space;
  const std::string added = plan_area > plan.area ? ", of which the hull adds " + fixed(plan_area - plan.area, 1) + " m²" : "";
  const std::string holes = parts.holes.empty() ? "" : " and " + counted(parts.holes.size(), "hole");
  print_line("boundary:  " + counted(parts.plan.size(), "corner") + holes + ", " + fixed(plan_area, 1) + " m²" + added + ", " +
             shortest(parts.height) + " m high, " + fixed(space, 1) + " m³");
  print_line("place:     latitude " + fixed(plan.reference.latitude, 6) + "°, longitude " + fixed(plan.reference.longitude, 6) +
             "°, from " + plan.source_crs);
  print_line("programme: " + counted(parts.programme.rows.size(), "use") + ", " + counted(parts.programme.items, "volume") +
             ", " + fixed(parts.programme.floor_area, 1) + " m² floor area, " + fixed(demand, 1) + " m³");
  print_line("density:   floor space index " + fixed(parts.programme.floor_area / plan_area, 2) +
             " (floor area / plan area), fill " + fixed(100 * fill, 1) + " % (demanded volume / boundary volume)");
  if (fill > 1)
    print_error(o.out, {ErrorCode::infeasible, "",
                        "warning: the demands do not fit into the boundary; they need a height of at least " +
                            fixed(std::ceil(10 * demand / plan_area) / 10, 1) + " m"});
  else if (fill > kTightFill)
    print_error(o.out, {ErrorCode::infeasible, "", "warning: the boundary will be nearly full; little is left to negotiate"});
}

}  // namespace

int new_command(const NewOptions& options) {
  // All that can be said about the input is said at once.
  bool is_well = is_sound(options);
  auto plan = load_plan(options);
  auto programme = load_programme(options);
  if (!is_well || !plan || !programme) return kBadInput;
  const ConvexPlan hull = convex_hull_plan(*plan);
  const bool takes_hull = options.use_hull && !plan->is_convex;
  SceneParts parts;
  parts.title = options.title.empty() ? file_stem(options.programme) : options.title;
  parts.reference = plan->reference;
  parts.plan = takes_hull ? hull.ring : plan->outer;
  if (!takes_hull) parts.holes = plan->holes;
  parts.height = options.height;
  parts.margin = options.margin;
  parts.programme = std::move(*programme);
  parts.seed = options.seed;
  const Registry& registry = full_registry();
  const auto command = new_scene_command(parts, registry);
  if (!command) {
    print_error(options.out, command.error());
    return kBadInput;
  }
  auto session = Session::start(registry, Scene{}, nullptr, 1);
  if (!session) {
    print_error(options.out, session.error());
    return kBadInput;
  }
  if (auto done = (*session)->submit(*command, "new"); !done) {
    print_error(options.out, done.error());
    return kBadInput;
  }
  const Scene& scene = (*session)->scene();
  print_problems(options.out, check_scene(scene, registry));
  if (auto written = write_file(options.out, write_scene(scene, registry)); !written) {
    print_error(options.out, written.error());
    return kBadInput;
  }
  print_figures(options, *plan, parts, takes_hull ? hull.area : plan->area);
  print_line("wrote " + options.out + ": " + counted(scene.nodes.size(), "node") + ", " + counted(scene.links.size(), "link") +
             "; next: behaviourlinks run " + options.out);
  return kDone;
}

}  // namespace bl::cli
