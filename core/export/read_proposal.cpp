// Reads buildings, plots, surroundings and sums through the views that reports read.
#include "core/export/read_proposal.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "core/base/hash.h"
#include "core/base/text.h"
#include "core/drawing/use_colours.h"
#include "core/geometry/cellar.h"
#include "core/geometry/domain_table.h"
#include "core/geometry/mesh_lines.h"
#include "core/reading/report_model.h"
#include "core/reading/views/building.h"
#include "core/reading/views/people.h"
#include "core/reading/views/plot.h"
#include "core/reading/views/solver.h"
#include "core/reading/views/sun.h"
#include "core/reading/views/surroundings.h"

namespace bl::exporting {

namespace {

using geometry::PlateFace;
using geometry::Ring;

std::vector<Ring> rings_of(const std::vector<geometry::Polyline>& lines) {
  std::vector<Ring> rings;
  for (const geometry::Polyline& line : lines)
    if (line.is_closed) rings.push_back(line.points);
  return rings;
}

// Rounded volumes are convex, or of convex parts where the boundary is not: each is seen as its hull.
std::vector<PlateFace> seen_from_above(const reading::VolumeRow& volume) {
  std::vector<Ring> rings;
  if (volume.exact.radius > 0) rings.push_back(geometry::hull_of_plan(reading::outline_of(volume.exact, {0, 0, -1})));
  else
    for (const Mesh& body : geometry::bodies_of(*volume.mesh)) rings.push_back(geometry::hull_of_plan(body.vertices));
  std::vector<PlateFace> faces;
  for (Ring& ring : rings)
    if (ring.size() >= 3) faces.push_back({std::move(ring), {}});
  return faces;
}

// A rounded volume at one height.
std::vector<PlateFace> section_at(const reading::VolumeRow& volume, double z) {
  if (volume.exact.radius > 0) return faces_of_rings({reading::section_of(volume.exact, z)});
  return faces_of_rings(rings_of(geometry::section(*volume.mesh, z, [](std::size_t) { return true; })));
}

// A rounded volume, where its solver measures it.
void cut(const reading::VolumeRow& volume, Building& building) {
  double drawn = 0;
  int number = 0;
  for (const reading::FloorCut& cut : reading::floor_cuts(building.bottom, volume.figures.height, building.storey_height)) {
    Storey made{number, 0, cut.bottom, cut.top, 0, section_at(volume, cut.at), {}, {}};
    number += cut.is_drawn ? 1 : 0;
    made.floor_area = cut.share * area_of(made.faces);
    drawn += made.floor_area;
    if (!cut.is_drawn && !building.storeys.empty()) building.storeys.back().floor_area += made.floor_area;
    else if (!made.faces.empty()) building.storeys.push_back(std::move(made));
  }
  // Arcs are drawn as chords, so the drawing has a little less than the figure: each storey gets its share of the figure.
  for (Storey& made : building.storeys) made.floor_area *= building.floor_area / drawn;
  building.mesh = std::make_shared<const Mesh>(*volume.mesh);
  building.shape = volume.mesh;
  building.outline = seen_from_above(volume);
}

void add_cellars(const State& state, const reading::VolumeRow& volume, Building& building) {
  const auto figures = reading::row_of<reading::CellarFigures>(state, volume.node);
  if (!figures || figures->storeys <= 0) return;
  const geometry::PlateStack cellar =
      geometry::cellar_of(volume.body, static_cast<int>(figures->storeys), figures->storey_height);
  const std::vector<PlateFace> faces = geometry::faces_of(cellar, volume.body.centre, kChordTolerance);
  for (int k = 1; k <= cellar.storeys; ++k) {
    const double bottom = building.bottom - k * cellar.storey_height;
    building.cellars.push_back({-k, -k, bottom, bottom + cellar.storey_height, cellar.area, faces, cellar.outlines, {}});
  }
}

void add_building(const State& state, const reading::VolumeRow& volume, const drawing::Palette& palette, Proposal& all) {
  Building building;
  building.id = volume.id;
  building.label = volume.name;
  building.use = volume.use;
  building.colour = palette.colour(volume.use);
  building.position = volume.figures.position;
  building.place = volume.place;
  building.asked_area = volume.asked_area;
  building.floor_area = volume.floor_area;
  building.asked_volume = volume.asked;
  building.volume = volume.volume;
  building.footprint = volume.figures.footprint;
  building.storey_height = std::max(0.1, volume.figures.storey_height);
  building.bottom = volume.figures.bottom;
  building.top = volume.figures.bottom + volume.figures.height;
  if (!volume.body.stacks.empty()) stand(volume.body, building), add_cellars(state, volume, building);
  else if (volume.mesh) cut(volume, building);
  if (building.mesh != nullptr && !building.mesh->triangles.empty() && !building.storeys.empty())
    return all.buildings.push_back(std::move(building));
  building.why_shapeless = building.mesh != nullptr        ? "its shape is too flat to be cut"
                           : volume.figures.reason.empty() ? "it has no shape"
                                                           : volume.figures.reason;
  building.storeys.clear();
  building.mesh = nullptr;
  all.shapeless.push_back(std::move(building));
}

// A limit at the end of its port's range forbids nothing, and is no rule.
std::optional<double> rule_of(const State& state, std::uint32_t node, const char* port, double limit) {
  const auto ref = state.plan->find(node, {reading::type_of<reading::PlotFigures>(), port, {}});
  return ref && limit >= state.plan->port(*ref).hard_maximum ? std::nullopt : std::optional(limit);
}

void add_lands(const State& state, const reading::ReportModel& model, Proposal& all) {
  for (const reading::SiteRow& site : model.sites) {
    if (!site.shape) continue;
    Land land;
    land.id = land.name = site.name;
    land.is_boundary = true;
    land.faces = faces_of_rings(rings_of(site.ground));
    land.area = site.ground_area;
    land.open_area = site.open_area;
    land.ground = site.bottom;
    if (!land.faces.empty()) all.lands.push_back(std::move(land));
  }
  for (const auto& [node, plot] : reading::rows<reading::PlotFigures>(state)) {
    Land land{state.plan->nodes[node].id,
              state.plan->nodes[node].name,
              false,
              faces_of_rings({plot.polygon}),
              0,
              0,
              plot.ground,
              plot.fsi,
              plot.gsi,
              rule_of(state, node, "fsi_max", plot.fsi_max),
              rule_of(state, node, "gsi_max", plot.gsi_max),
              rule_of(state, node, "height_max", plot.height_max),
              plot.osr,
              plot.storeys,
              plot.top};
    land.area = area_of(land.faces);
    if (!land.faces.empty()) all.lands.push_back(std::move(land));
  }
}

void add_grounds(const State& state, Proposal& all) {
  for (const auto& [node, ground] : reading::rows<reading::StandingFigures>(state))
    all.grounds.push_back({state.plan->nodes[node].id, state.plan->nodes[node].name, ground.plot_area, ground.open_area,
                           ground.fsi, ground.gsi, ground.osr, ground.mean_storeys});
}

// Receivers that lie flat and have been measured.
void add_suns(const State& state, Proposal& all) {
  constexpr double kHour = 3600;  // [s]
  for (const auto& [node, sun] : reading::rows<reading::ReceiverFigures>(state))
    if (!sun.upright && !sun.map->rows.empty())
      all.suns.push_back({state.plan->nodes[node].id, state.plan->nodes[node].name, sun.required_sun / kHour, sun.share_met,
                          sun.required_share, sun.sun_mean / kHour});
}

void add_neighbours(const State& state, Proposal& all) {
  for (const auto& [node, read] : reading::rows<reading::BuildingFigures>(state)) {
    std::vector<Ring> rings{read.outline};
    std::map<std::string, Ring> courts;
    for (std::size_t row = 0; row < read.holes->rows.size(); ++row)
      courts[read.holes->text(row, "name")].push_back({read.holes->number(row, "x"), read.holes->number(row, "y"), 0});
    for (auto& [name, ring] : courts) rings.push_back(std::move(ring));
    std::vector<PlateFace> faces = faces_of_rings(std::move(rings));
    if (faces.empty()) continue;
    Neighbour neighbour{state.plan->nodes[node].id,
                        state.plan->nodes[node].name,
                        read.use,
                        std::move(faces.front()),
                        read.base,
                        read.top,
                        nullptr};
    if (read.mesh && !read.mesh->triangles.empty()) neighbour.mesh = std::make_shared<const Mesh>(*read.mesh);
    all.neighbours.push_back(std::move(neighbour));
  }
}

void add_story(const State& state, const reading::ReportModel& model, Proposal& all) {
  for (const auto& [node, figures] : reading::rows<reading::IndicatorFigures>(state))
    all.indicators.push_back({state.plan->nodes[node].id, state.plan->nodes[node].name, figures.value, figures.target,
                              figures.unit, figures.direction, figures.status, figures.score});
  for (const reading::ConflictRow& row : model.conflicts) all.conflicts.push_back({row.node, row.port, row.tension, row.pulls});
  all.minor_conflicts = model.minor_conflicts;
  for (const reading::ProblemRow& row : model.problems) all.troubles.push_back({row.place, row.message});
}

UseRow row_of(const reading::Account& account) {
  UseRow row;
  row.asked_area = account.asked_area;
  row.floor_area = account.floor_area;
  row.asked_volume = account.asked;
  row.volume = account.volume;
  return row;
}

void add_uses(const reading::ReportModel& model, const drawing::Palette& palette, Proposal& all) {
  for (const reading::UseAccount& account : model.accounts.uses) {
    UseRow row = row_of(account);
    row.use = account.use;
    row.letter = palette.letter(account.use);
    row.colour = palette.colour(account.use);
    row.buildings = account.volumes;
    all.uses.push_back(std::move(row));
  }
  all.all = row_of(model.accounts.all);
  all.all.buildings = model.volumes.size();
}

// What imports keep clear has its kind as the first word of its name. Other exclusions without a use are existing buildings and
// what people have drawn, which the boundary shows as its holes.
std::string kind_of_kept(const std::string& name) {
  const std::string kind = name.substr(0, name.find(' '));
  const bool is_kind = kind == "street" || kind == "rail" || kind == "water" || kind == "green";
  return is_kind && kind.size() < name.size() ? kind : "";
}

// Exclusions with a use are open space.
void add_open_spaces(const State& state, const reading::ReportModel& model, Proposal& all) {
  std::map<std::string, std::vector<PlateFace>> faces;
  std::map<std::string, std::vector<PlateFace>> kept;
  for (const auto& [node, ground] : reading::rows<reading::OpenGround>(state))
    for (geometry::NamedRing& ring : geometry::read_rings(*ground.exclusions)) {
      const std::string& use = ground.exclusions->text(ring.first_row, "use");
      const std::string kind = use.empty() ? kind_of_kept(ring.name) : "";
      if (use.empty() && kind.empty()) continue;
      std::vector<PlateFace>& list = use.empty() ? kept[kind] : faces[lower_case(use)];
      for (PlateFace& face : faces_of_rings({std::move(ring.corners)})) list.push_back(std::move(face));
    }
  for (const reading::OpenAccount& open : model.accounts.open)
    all.open_spaces.push_back({open.use, drawing::use_colour(open.use).colour, open.asked, open.area,
                               why_short(open, model.accounts.tolerance), std::move(faces[lower_case(open.use)])});
  for (auto& [kind, ground] : kept) all.kept.push_back({kind, std::move(ground)});
}

}  // namespace

// No floor lies closer above another one of its building than a level is high, so that no two of them fall on one level. In a
// building of shops and flats the storey that both have is as high as those of the shops, whichever it is called by.
void number_levels(Proposal& all) {
  all.level_height = std::numeric_limits<double>::infinity();
  all.levels = 0;
  all.ground = std::numeric_limits<double>::infinity();
  for (const Building& building : all.buildings) {
    all.ground = std::min(all.ground, building.storeys.front().bottom);
    all.level_height = std::min(all.level_height, building.storey_height);
    for (std::size_t k = 1; k < building.storeys.size(); ++k)
      all.level_height = std::min(all.level_height, building.storeys[k].bottom - building.storeys[k - 1].bottom);
  }
  for (Building& building : all.buildings)
    for (Storey& storey : building.storeys) {
      // What stands belongs where its floor is: high halls are on the plan of the ground floor. A rounded volume is cut in the
      // middle of its storeys; that of the last one, which may be lower, is taken as that of a whole one.
      const double height = storey.bottom + (building.is_standing ? 0 : building.storey_height / 2);
      storey.level = static_cast<int>(std::floor((height - all.ground) / all.level_height + 1e-9));
      all.levels = std::max(all.levels, storey.level + 1);
    }
}

void stand(const geometry::StandingBody& body, Building& building) {
  building.is_standing = true;
  building.arc_centre = body.centre;
  for (const geometry::PlateStack& stack : body.stacks) {
    const std::vector<PlateFace> faces = geometry::faces_of(stack, body.centre, kChordTolerance);
    for (int k = 0; k < stack.storeys; ++k) {
      const double bottom = stack.bottom + k * stack.storey_height;
      building.storeys.push_back({static_cast<int>(building.storeys.size()), 0, bottom, bottom + stack.storey_height, stack.area,
                                  faces, stack.outlines, stack.courtyards});
    }
  }
  if (!body.stacks.empty()) building.storey_height = body.stacks.front().storey_height;
  building.mesh = std::make_shared<const Mesh>(geometry::mesh_of(body, kChordTolerance));
  building.light_mesh = std::make_shared<const Mesh>(geometry::mesh_of(body, kLightTolerance));
  if (!building.storeys.empty()) building.outline = building.storeys.front().faces;
}

std::vector<PlateFace> faces_of_rings(std::vector<Ring> rings) {
  std::erase_if(rings, [](const Ring& ring) { return ring.size() < 3 || geometry::signed_area(ring) == 0; });
  for (Ring& ring : rings)
    for (Point3& corner : ring) corner.z = 0;
  const auto size_of = [](const Ring& ring) { return std::abs(geometry::signed_area(ring)); };
  std::stable_sort(rings.begin(), rings.end(), [&](const Ring& a, const Ring& b) { return size_of(a) > size_of(b); });
  // Most sides decide, since rings that touch share corners.
  const auto is_within = [](const Ring& ring, const Ring& other) {
    std::size_t inside = 0;
    for (std::size_t k = 0; k < ring.size(); ++k)
      inside += geometry::ring_contains(other, 0.5 * (ring[k] + ring[(k + 1) % ring.size()])) ? 1u : 0u;
    return 2 * inside > ring.size();
  };
  std::vector<PlateFace> faces;
  std::vector<std::size_t> depth(rings.size(), 0), face_of(rings.size(), 0);
  for (std::size_t k = 0; k < rings.size(); ++k) {
    std::size_t around = rings.size();
    for (std::size_t other = 0; other < k; ++other)
      if (is_within(rings[k], rings[other])) ++depth[k], around = other;
    const bool is_hole = depth[k] % 2 == 1;
    if ((geometry::signed_area(rings[k]) > 0) == is_hole) std::reverse(rings[k].begin(), rings[k].end());
    face_of[k] = is_hole ? face_of[around] : faces.size();
    if (is_hole) faces[face_of[k]].holes.push_back(rings[k]);
    else faces.push_back({rings[k], {}});
  }
  return faces;
}

Result<Proposal> read_proposal(const State& state, const std::string& file) {
  if (state.tick == 0)
    return Error{ErrorCode::missing, "", "nothing has been computed yet, so that there is no proposal to hand on; use --settle"};
  reading::ReportModel model;
  reading::read_model(state, model);
  const drawing::Palette palette(model.use_names());
  Proposal all;
  all.title = model.title;
  all.about = model.about;
  all.file = file;
  all.hash = model.hash;
  all.tick = model.tick;
  all.is_settled = model.is_settled;
  const Settings& settings = state.plan->settings;
  all.reference = {settings.coordinate_system, settings.origin_x,  settings.origin_y,
                   settings.latitude,          settings.longitude, settings.true_north};
  for (const reading::VolumeRow& volume : model.volumes) add_building(state, volume, palette, all);
  if (all.buildings.empty())
    return Error{ErrorCode::missing, "",
                 model.volumes.empty() ? "the scene has no volumes, so that there is no proposal to hand on"
                                       : "no volume has a shape (" + all.shapeless.front().label + ": " +
                                             all.shapeless.front().why_shapeless + ")"};
  number_levels(all);
  add_lands(state, model, all);
  add_grounds(state, all);
  add_suns(state, all);
  add_neighbours(state, all);
  for (const reading::StreetLine& street : model.surroundings.streets) all.streets.push_back({street.name, street.line});
  for (const MeshPointer& ground : model.surroundings.grounds)
    if (ground && !ground->triangles.empty()) all.terrains.push_back(std::make_shared<const Mesh>(*ground));
  add_story(state, model, all);
  add_uses(model, palette, all);
  add_open_spaces(state, model, all);
  return all;
}

}  // namespace bl::exporting
