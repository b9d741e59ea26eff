// Reads volumes, uses, sites and totals from a state by their views.
#include "core/reading/report_model.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "core/base/hash.h"
#include "core/geometry/plan_ring.h"
#include "core/geometry/plates_table.h"
#include "core/reading/views/plot.h"
#include "core/reading/views/solver.h"
#include "core/reading/views/volume.h"

namespace bl::reading {

namespace {

// Which solver takes care of a node: the first set that it is a member of and that writes its mesh.
std::size_t group_of(const Plan& plan, std::uint32_t node) {
  for (std::size_t s = 0; s < plan.sets.size(); ++s) {
    const SetPlan& set = plan.sets[s];
    if (!set.writes.empty() && std::binary_search(set.members.begin(), set.members.end(), node)) return s + 1;
  }
  return 0;
}

constexpr double kPlaceChords = 0.02;  // [m] between arcs and their chords
constexpr double kSamePlace = 1e-6;    // [m]

// A volume whose cell lies to one side of its position stands there, and would be named at its edge.
Point3 place_of(const VolumeRow& row, const Point3& stands_at) {
  const Point3& position = row.figures.position;
  if (distance({position.x, position.y, 0}, {stands_at.x, stands_at.y, 0}) <= kSamePlace) return position;
  Point3 place = stands_at;
  if (!row.body.stacks.empty()) {
    const auto parts = geometry::faces_of(row.body.stacks.front(), row.body.centre, kPlaceChords);
    place = geometry::nearest_place(row.body, geometry::middle_of(parts), kPlaceChords);
  }
  return {place.x, place.y, position.z};
}

VolumeRow read_volume(const State& state, const VolumeAccount& account, bool with_shape) {
  VolumeRow row;
  static_cast<VolumeAccount&>(row) = account;
  row.id = state.plan->nodes[account.node].id;
  row.name = state.plan->nodes[account.node].name;
  if (const auto footprint = with_shape ? row_of<FootprintFigures>(state, account.node) : std::nullopt)
    row.body = geometry::read_body(footprint->plates);
  row.place = account.figures.position;
  if (const auto standing = row_of<PlotStanding>(state, account.node); standing && account.figures.footprint > 0)
    row.place = place_of(row, standing->stands_at);
  if (!with_shape) return row;
  row.mesh = account.figures.mesh;
  if (row.mesh && row.mesh->triangles.empty()) row.mesh = nullptr;
  if (row.mesh) row.exact = exact_shape(state, account.node, account.figures);
  row.group = group_of(*state.plan, account.node);
  return row;
}

SiteRow site_of(const State& state, const reading::Row<reading::BoundaryFigures>& row) {
  SiteRow site;
  site.name = state.plan->nodes[row.node].name;
  site.volume = row.figures.volume;
  site.ground_area = row.figures.ground_area;
  site.open_area = row.figures.open_area;
  site.shape = row.figures.shape;
  if (!site.shape || site.shape->triangles.empty()) {
    site.shape = nullptr;
    return site;
  }
  // A boundary that is not convex comes in pieces: where they meet there is no edge.
  site.shape = std::make_shared<const Mesh>(geometry::joined(*site.shape));
  const std::vector<Vector3> normals = geometry::unit_normals(*site.shape);
  site.ground = geometry::outline(*site.shape, [&](std::size_t t) { return normals[t].z < -1e-6; });
  site.plan = geometry::outline(*site.shape, [&](std::size_t t) { return normals[t].z > 1e-6; });
  site.bottom = site.shape->vertices.front().z;
  for (const Point3& vertex : site.shape->vertices) site.bottom = std::min(site.bottom, vertex.z);
  return site;
}

void read_volumes(const State& state, ReportModel& model, bool with_shape) {
  model.accounts = accounts_of(state);
  for (const VolumeAccount& account : model.accounts.volumes) {
    model.volumes.push_back(read_volume(state, account, with_shape));
    model.volumes.back().number = model.volumes.size();
  }
}

// Meshes are for the eye; who measures one has to know what it is.
std::string mesh_note_of(const State& state, const ReportModel& model) {
  if (std::none_of(model.volumes.begin(), model.volumes.end(), [](const VolumeRow& row) { return row.mesh != nullptr; }))
    return "";
  std::set<std::int64_t> depths;
  for (const auto& [node, solver] : reading::rows<reading::SolverFigures>(state)) depths.insert(solver.tessellation_depth);
  std::string said;
  for (const std::int64_t depth : depths) said += (said.empty() ? "" : " and ") + std::to_string(depth);
  return "Meshes are of tessellation depth " + said +
         ". A mesh lies within its shape and encloses less than it, most where a volume is round. The figures in volumes.csv are "
         "those of the shapes. Raise tessellation_depth of the solver (4 is the finest) to bring the meshes nearer to them.";
}

}  // namespace

std::size_t link_index(const Plan& plan, std::string_view id) {
  const auto found = std::lower_bound(plan.links.begin(), plan.links.end(), id,
                                      [](const LinkPlan& link, std::string_view key) { return link.id < key; });
  return static_cast<std::size_t>((found != plan.links.end() && found->id == id ? found : plan.links.end()) - plan.links.begin());
}

std::vector<std::string> ReportModel::use_names() const {
  std::vector<std::string> names;
  for (const UseAccount& row : accounts.uses) names.push_back(row.use);
  return names;
}

void add_totals(const State& state, ReportModel& model) {
  model.plan_area = model.site_volume = model.plots_area = 0;
  for (const auto& [node, plot] : rows<PlotFigures>(state)) model.plots_area += std::abs(geometry::signed_area(plot.polygon));
  model.shapes = 0;
  model.worst = nullptr;
  for (const SiteRow& site : model.sites) {
    model.plan_area += site.ground_area + site.open_area;
    model.site_volume += site.volume;
  }
  for (const VolumeRow& volume : model.volumes) {
    if (volume.mesh) ++model.shapes;
    if (model.worst == nullptr || std::abs(volume.error()) > std::abs(model.worst->error())) model.worst = &volume;
  }
}

void read_figures(const State& state, ReportModel& model) {
  model.tolerance = state.plan->settings.tolerance;
  read_volumes(state, model, false);
  add_totals(state, model);
}

void read_model(const State& state, ReportModel& model) {
  const Settings& settings = state.plan->settings;
  model.title = settings.title;
  model.about = settings.about;
  model.tolerance = settings.tolerance;
  model.move_limit = settings.move_limit;
  model.true_north = settings.true_north;
  model.tick = state.tick;
  model.hash = hex_digits(state.hash);
  model.is_settled = state.is_settled();
  read_volumes(state, model, true);
  for (const auto& boundary : reading::rows<reading::BoundaryFigures>(state)) model.sites.push_back(site_of(state, boundary));
  model.surroundings = read_surroundings(state);
  add_totals(state, model);
  model.mesh_note = mesh_note_of(state, model);
  read_conflicts(state, model);
  read_problems(state, model);
}

}  // namespace bl::reading
