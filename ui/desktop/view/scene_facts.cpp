// Reads volumes, marks, boundaries and links from a state, by the views of them.
#include "ui/desktop/view/scene_facts.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <iterator>
#include <map>
#include <set>

#include "core/reading/changed_nodes.h"
#include "core/reading/views/building.h"
#include "core/reading/views/facade.h"
#include "core/reading/views/node.h"
#include "core/reading/views/solver.h"
#include "core/reading/views/surroundings.h"
#include "core/reading/views/traffic.h"
#include "core/traffic/street_line.h"
#include "ui/desktop/document/media_place.h"

namespace bl::desktop {

namespace {

// Links over sets with more pairs than this would hide what they join.
constexpr std::size_t kMostPairs = 80;

// What its style makes of the façade, where one dresses it.
void read_facade(const State& state, std::uint32_t node, VolumeFacts& facts) {
  const auto facade = reading::row_of<reading::FacadeFigures>(state, node);
  if (!facade || facade->by_orientation->rows.size() != facts.facade.sides.size()) return;
  facts.is_dressed = true;
  facts.facade.north = static_cast<float>(facade->true_north);
  for (std::size_t k = 0; k < facts.facade.sides.size(); ++k) {
    const auto number = [&](const char* column) { return static_cast<float>(facade->by_orientation->number(k, column)); };
    facts.facade.sides[k] = {number("width"), number("module"), number("sill"), number("head")};
  }
}

// The first who looks has it made. Where memory does not suffice for that, the volume is drawn as one without a shape is.
std::shared_ptr<const Mesh> coarse_of(const MeshPointer& mesh) try { return mesh.coarse(); } catch (const std::exception&) {
  return nullptr;
}

// Of the shapes that nobody has made, those of the next volumes in turn are made, at most so many; the others are awaited. Each
// has its turn, also where all of them change in every tick.
void choose_shapes(const std::vector<reading::VolumeAccount>& accounts, const SceneFacts* last, std::size_t most,
                   SceneFacts& facts) {
  std::vector<std::uint32_t>& waiting = facts.awaited;
  for (const reading::VolumeAccount& account : accounts)
    if (const MeshPointer& mesh = account.figures.mesh; mesh && !mesh.is_coarse_made()) waiting.push_back(account.node);
  facts.next_shape = last != nullptr ? last->next_shape : 0;
  if (waiting.size() <= most) return waiting.clear();
  std::rotate(waiting.begin(), std::lower_bound(waiting.begin(), waiting.end(), facts.next_shape), waiting.end());
  waiting.erase(waiting.begin(), waiting.begin() + static_cast<std::ptrdiff_t>(most));
  facts.next_shape = waiting.front();
  std::sort(waiting.begin(), waiting.end());
}

// `before`: the volume in the picture before, if it was there.
VolumeFacts read_volume(const State& state, reading::VolumeAccount&& account, const VolumeFacts* before, bool is_awaited) {
  const std::uint32_t node = account.node;
  VolumeFacts facts;
  static_cast<reading::Account&>(facts) = account;
  facts.node = node;
  facts.id = state.plan->nodes[node].id;
  facts.name = state.plan->nodes[node].name;
  facts.figures = std::move(account.figures);
  read_facade(state, node, facts);
  const bool has_last = before != nullptr && before->cell && !before->is_ball && before->id == facts.id;
  if (!is_awaited) facts.cell = coarse_of(facts.figures.mesh);
  else if (has_last) facts.cell = before->cell;
  // A body that comes without a wrapped cell, such as one that stands, is drawn as it is. One that is still to be made is not:
  // where its cell found no memory, it would find none either.
  const MeshPointer& mesh = facts.figures.mesh;
  if (!is_awaited && !facts.cell && mesh && !mesh.has_recipe() && !mesh->triangles.empty())
    facts.cell = has_last && before->figures.mesh == mesh ? before->cell : as_cell(*mesh);
  const bool is_usable =
      facts.cell && facts.cell->wrap && !facts.cell->triangles.empty() && facts.cell->vertices.size() < 60000 && facts.volume > 0;
  if (is_usable) return facts;
  facts.cell = nullptr;
  if (!(facts.volume > 0) || !(facts.figures.radius > 0)) return facts;
  facts.is_ball = true;
  facts.cell = ball_cell(facts.figures.position, facts.figures.radius);
  return facts;
}

// In its place among the others; nothing of a volume without one.
void read_cellar(const State& state, const VolumeFacts& volume, std::vector<CellarFacts>& cellars) {
  const auto at = std::lower_bound(cellars.begin(), cellars.end(), volume.node,
                                   [](const CellarFacts& cellar, std::uint32_t node) { return cellar.node < node; });
  const bool is_there = at != cellars.end() && at->node == volume.node;
  const auto figures = reading::row_of<reading::CellarFigures>(state, volume.node);
  if (!figures || figures->storeys <= 0) {
    if (is_there) cellars.erase(at);
    return;
  }
  const auto storeys = static_cast<int>(figures->storeys);
  const CellarFacts cellar{volume.node,
                           storeys,
                           volume.figures.bottom - storeys * figures->storey_height,
                           figures->storey_height,
                           figures->area / storeys,
                           nullptr};
  if (is_there) *at = cellar;
  else cellars.insert(at, cellar);
}

// What is drawn as itself needs no mark.
bool has_own_picture(const State& state, std::uint32_t node) {
  return reading::is_a<reading::StreetFigures>(state, node) || reading::is_a<reading::BuildingFigures>(state, node) ||
         reading::is_a<reading::BoundaryFigures>(state, node);
}

// Streets and buildings have their places where they are drawn, whatever their nodes' positions say.
void read_surroundings(const State& state, const SceneFacts* last, SceneFacts& facts) {
  facts.urban = read_urban(state, last == nullptr ? nullptr : &last->urban);
  facts.reach = facts.radius;
  const auto reach_to = [&](const Point3& p) {
    if (is_finite(p)) facts.reach = std::clamp(distance(p, facts.centre), facts.reach, 1e6);
  };
  for (StreetFacts& street : facts.urban.streets) {
    street.line = traffic::street_line(facts.places[street.start], street.course, facts.places[street.end]);
    facts.places[street.node] = traffic::point_on_line(street.line, 0.5);
    for (const Point3& point : street.line) reach_to(point);
  }
  for (const BodyFacts& body : facts.urban.bodies) {
    facts.places[body.node] = body.cell->wrap->ball_centre;
    for (const Point3& vertex : body.mesh->vertices) reach_to(vertex);
  }
}

// That of the first role that is more than being a node.
Icon icon_of(const NodePlan& node) {
  for (const TypePlan& type : node.types)
    if (type.definition->id != kBaseNode) return type.definition->icon;
  return Icon::link;
}

void read_links(const Plan& plan, SceneFacts& facts) {
  for (std::size_t l = 0; l < plan.links.size(); ++l) {
    const LinkPlan& link = plan.links[l];
    const auto& from = link.nodes[0];
    const auto& to = link.nodes[1];
    if (from.size() * to.size() > (link.is_symmetric ? 2 : 1) * kMostPairs) continue;
    for (const std::uint32_t a : from)
      for (const std::uint32_t b : to)
        if (a != b && (!link.is_symmetric || a < b)) facts.links.push_back({l, link.id, a, b});
  }
}

void read_pulls(const State& state, SceneFacts& facts) {
  for (std::size_t l = 0; l < state.links.size(); ++l)
    for (const Voice& voice : state.links[l].voices) {
      const auto* change = std::get_if<Vector3>(&voice.value);
      if (change == nullptr || !is_finite(*change) || voice.target.type == PortRef::kNodeId) continue;
      if (reading::port_of<&reading::NodePlace::position>(*state.plan, voice.target.node) == voice.target)
        facts.pulls.push_back({l, voice.target.node, voice.strength * *change});
    }
}

void read_boundary(const State& state, std::uint32_t node, MeshPointer shape, const SceneFacts* last, SceneFacts& facts) {
  BoundaryFacts boundary{node, state.plan->nodes[node].id, std::move(shape), {}};
  if (!boundary.shape || boundary.shape->triangles.empty()) return;
  if (last != nullptr)
    for (const BoundaryFacts& earlier : last->boundaries)
      if (earlier.shape == boundary.shape) boundary.edges = earlier.edges;
  if (boundary.edges.empty()) boundary.edges = sharp_edges(*boundary.shape);
  Point3 middle;
  double low = boundary.shape->vertices.front().z;
  for (const Point3& vertex : boundary.shape->vertices) {
    middle += vertex / static_cast<double>(boundary.shape->vertices.size());
    low = std::min(low, vertex.z);
  }
  facts.places[node] = {middle.x, middle.y, low};
  facts.boundaries.push_back(std::move(boundary));
}

void read_media(const State& state, std::uint32_t node, const reading::MediaFigures& read, SceneFacts& facts) {
  MediaFacts media{node, state.plan->nodes[node].id, state.plan->nodes[node].name, read.message, read.file, {}};
  if (media.file.empty()) return;
  facts.has_sequence |= read.kind == "sequence";
  if (read.kind == "sequence") media.file = frame_file(media.file, state.tick, read.rate, read.frames);
  const MediaPlace place =
      place_of({read.placement, read.position, read.azimuth, read.tilt, read.width, read.height, read.distance});
  media.picture.corner = place.corner;
  media.picture.across = place.across;
  media.picture.up = place.up;
  media.picture.opacity = static_cast<float>(read.opacity);
  media.picture.orientation = static_cast<int>(read.orientation);
  media.picture.is_veiled = !read.is_free;
  facts.media.push_back(std::move(media));
}

// The ball around boundaries, or volumes where there are none; it stays as it was while it still fits.
void read_extent(const SceneFacts* last, SceneFacts& facts) {
  Vector3 low{1e300, 1e300, 1e300}, high = -low;
  const auto take = [&](const Point3& p, double around) {
    if (!is_finite(p)) return;
    low = {std::min(low.x, p.x - around), std::min(low.y, p.y - around), std::min(low.z, p.z - around)};
    high = {std::max(high.x, p.x + around), std::max(high.y, p.y + around), std::max(high.z, p.z + around)};
  };
  for (const BoundaryFacts& boundary : facts.boundaries)
    for (const Point3& vertex : boundary.shape->vertices) take(vertex, 0);
  const bool has_boundary = low.x <= high.x;
  if (has_boundary) facts.ground = low.z;
  if (!has_boundary)
    for (std::size_t row = 0; row < facts.columns.node.size(); ++row)
      take(facts.columns.position[row], facts.columns.radius[row]);
  if (!(low.x <= high.x))
    for (const Point3& place : facts.places) take(place, 5);
  if (!(low.x <= high.x)) return;
  const Point3 centre = 0.5 * (low + high);
  const double radius = std::clamp(0.5 * distance(low, high), 1.0, 1e6);
  const bool still_fits =
      last != nullptr && distance(centre, last->centre) < 0.05 * radius && std::abs(radius - last->radius) < 0.05 * radius;
  facts.centre = still_fits ? last->centre : centre;
  facts.radius = still_fits ? last->radius : radius;
  if (!has_boundary) facts.ground = still_fits ? last->ground : low.z;
}

}  // namespace

std::size_t SceneFacts::row_of(std::uint32_t node) const {
  std::size_t low = 0;
  for (std::size_t rest = volumes.size(); rest > 0;) {
    const std::size_t half = rest / 2;
    if (volumes[low + half].node < node) low += half + 1, rest -= half + 1;
    else rest = half;
  }
  return low < volumes.size() && volumes[low].node == node ? low : volumes.size();
}

const VolumeFacts* SceneFacts::volume_of(std::uint32_t node) const {
  const std::size_t row = row_of(node);
  return row < volumes.size() ? &volumes[row] : nullptr;
}

std::vector<std::pair<std::uint32_t, std::uint32_t>> neighbours_of(const SceneFacts& facts) {
  std::set<std::pair<std::uint32_t, std::uint32_t>> pairs;
  for (const VolumeFacts& volume : facts.volumes) {
    const Table& table = *volume.figures.neighbours;
    for (std::size_t row = 0; row < table.rows.size(); ++row) {
      const std::uint32_t other = facts.state->plan->node_index(table.text(row, "node"));
      if (facts.volume_of(other) != nullptr) pairs.insert(std::minmax(volume.node, other));
    }
  }
  return {pairs.begin(), pairs.end()};
}

namespace {

// A ball is remade only where it is another one: what is drawn of it is known by its mesh.
void keep_ball(VolumeFacts& volume, const VolumeFacts* before) {
  if (before != nullptr && volume.is_ball && before->is_ball && before->figures.position == volume.figures.position &&
      before->figures.radius == volume.figures.radius)
    volume.cell = before->cell;
}

VolumeList published(VolumeList::Draft&& draft) {
  return std::move(draft).publish([](const VolumeFacts&, std::size_t) {}, [](const auto&, std::size_t) { return NoDigest{}; });
}

void set_columns(SceneFacts& facts, std::size_t row, const VolumeFacts& volume) {
  facts.balls.set(row, volume.cell);
  facts.columns.node[row] = volume.node;
  facts.columns.radius[row] = volume.figures.radius;
  facts.columns.position[row] = volume.figures.position;
}

void make_columns(SceneFacts& facts, const std::vector<VolumeFacts>& volumes) {
  facts.balls.resize(volumes.size());
  facts.columns.resize(volumes.size());
  for (std::size_t row = 0; row < volumes.size(); ++row) set_columns(facts, row, volumes[row]);
  facts.balls.group();
}

void read_uses(SceneFacts& facts) {
  std::set<std::string> uses;
  for (const VolumeFacts& volume : facts.volumes) uses.insert(volume.figures.use);
  facts.uses.assign(uses.begin(), uses.end());
}

void read_all_nodes(const State& state, const SceneFacts* last, std::size_t most_shapes, SceneFacts& facts) {
  for (std::uint32_t n = 0; n < state.plan->nodes.size(); ++n)
    facts.places.push_back(reading::read<&reading::NodePlace::position>(state, n));
  std::vector<VolumeFacts> volumes;
  reading::Accounts accounts = reading::accounts_of(state);
  choose_shapes(accounts.volumes, last, most_shapes, facts);
  for (reading::VolumeAccount& account : accounts.volumes) {
    const VolumeFacts* before = last != nullptr ? last->volume_of(account.node) : nullptr;
    const bool is_awaited = std::binary_search(facts.awaited.begin(), facts.awaited.end(), account.node);
    keep_ball(volumes.emplace_back(read_volume(state, std::move(account), before, is_awaited)), before);
    read_cellar(state, volumes.back(), facts.cellars);
  }
  make_columns(facts, volumes);
  facts.volumes = published(VolumeList::Draft(std::move(volumes)));
  for (std::uint32_t n = 0; n < state.plan->nodes.size(); ++n)
    if (const NodePlan& node = state.plan->nodes[n]; facts.volume_of(n) == nullptr && !has_own_picture(state, n))
      facts.marks.push_back({n, node.id, node.name, icon_of(node), facts.places[n]});
  read_uses(facts);
  read_links(*state.plan, facts);
}

// Of nodes that have changed alone, and of volumes that await their shapes; who is a volume and who is a mark is as before.
void read_changed_nodes(const State& state, const SceneFacts& last, const std::vector<std::uint32_t>& moved,
                        std::size_t most_shapes, SceneFacts& facts) {
  std::vector<std::uint32_t> changed;
  std::set_union(moved.begin(), moved.end(), last.awaited.begin(), last.awaited.end(), std::back_inserter(changed));
  facts.places = last.places;
  facts.marks = last.marks;
  facts.links = last.links;
  facts.balls = last.balls;
  facts.columns = last.columns;
  facts.cellars = last.cellars;
  facts.uses = last.uses;
  for (const std::uint32_t n : changed) {
    facts.places[n] = reading::read<&reading::NodePlace::position>(state, n);
    const auto mark = std::lower_bound(facts.marks.begin(), facts.marks.end(), n,
                                       [](const MarkFacts& m, std::uint32_t node) { return m.node < node; });
    if (mark != facts.marks.end() && mark->node == n) mark->position = facts.places[n];
  }
  VolumeList::Draft draft(last.volumes);
  bool has_other_use = false;
  std::vector<std::size_t> rows;
  std::vector<reading::VolumeAccount> accounts = reading::accounts_of_volumes(state, changed, *facts.targets, facts.brief);
  choose_shapes(accounts, &last, most_shapes, facts);
  for (reading::VolumeAccount& account : accounts) {
    const VolumeFacts* before = last.volume_of(account.node);
    const bool is_awaited = std::binary_search(facts.awaited.begin(), facts.awaited.end(), account.node);
    VolumeFacts volume = read_volume(state, std::move(account), before, is_awaited);
    const auto row = last.row_of(volume.node);
    keep_ball(volume, before);
    read_cellar(state, volume, facts.cellars);
    has_other_use |= before->figures.use != volume.figures.use;
    set_columns(facts, row, volume);
    rows.push_back(row);
    draft.put(row, std::move(volume));
  }
  facts.volumes = published(std::move(draft));
  facts.balls.refit(rows);
  if (has_other_use) read_uses(facts);
}

}  // namespace

std::shared_ptr<const SceneFacts> read_facts(std::shared_ptr<const State> given, const SceneFacts* last,
                                             std::size_t most_shapes) {
  auto facts = std::make_shared<SceneFacts>();
  const State& state = *given;
  facts->tolerance = reading::account_tolerance(state);
  facts->brief = reading::brief_of(state);
  const auto changed = last != nullptr ? reading::changed_nodes(*last->state, state) : std::nullopt;
  facts->targets = changed ? last->targets : std::make_shared<const reading::BriefTargets>(reading::brief_targets(*state.plan));
  // Whether a volume is asked for floor area depends on which uses briefs name.
  if (changed && reading::has_same_uses(last->brief, facts->brief))
    read_changed_nodes(state, *last, *changed, most_shapes, *facts);
  else read_all_nodes(state, last, most_shapes, *facts);
  for (auto& [node, boundary] : reading::rows<reading::BoundaryFigures>(state))
    read_boundary(state, node, std::move(boundary.shape), last, *facts);
  for (const auto& [node, media] : reading::rows<reading::MediaFigures>(state)) read_media(state, node, media, *facts);
  read_pulls(state, *facts);
  read_extent(last, *facts);
  read_surroundings(state, last, *facts);
  facts->state = std::move(given);
  return facts;
}

std::shared_ptr<const SceneFacts> facts_without(const SceneFacts& facts, const std::set<std::string>& hidden) {
  auto rest = std::make_shared<SceneFacts>(facts);
  const auto is_hidden = [&](std::uint32_t node) { return hidden.contains(facts.state->plan->nodes[node].id); };
  const auto is_gone = [&](const auto& item) { return is_hidden(item.node); };
  std::vector<VolumeFacts> shown;
  std::copy_if(facts.volumes.begin(), facts.volumes.end(), std::back_inserter(shown), [&](const auto& v) { return !is_gone(v); });
  make_columns(*rest, shown);
  rest->volumes = published(VolumeList::Draft(std::move(shown)));
  std::erase_if(rest->cellars, is_gone);
  std::erase_if(rest->marks, is_gone);
  std::erase_if(rest->boundaries, is_gone);
  std::erase_if(rest->media, is_gone);
  std::erase_if(rest->pulls, is_gone);
  std::erase_if(rest->urban.streets, is_gone);
  std::erase_if(rest->urban.bodies, is_gone);
  std::erase_if(rest->urban.sun_maps, is_gone);
  std::erase_if(rest->urban.layers, is_gone);
  std::erase_if(rest->urban.plots, is_gone);
  std::erase_if(rest->urban.shadows, is_gone);
  std::erase_if(rest->urban.casters, is_gone);
  std::erase_if(rest->urban.grounds, [&](const auto& ground) { return is_hidden(ground.first); });
  std::erase_if(rest->links, [&](const LinkFacts& link) { return is_hidden(link.from) || is_hidden(link.to); });
  return rest;
}

std::vector<Point3> line_of(const StreetFacts& street, const std::map<std::uint32_t, Point3>& held) {
  const auto start = held.find(street.start), end = held.find(street.end);
  if (street.line.empty() || (start == held.end() && end == held.end())) return street.line;
  return traffic::street_line(start == held.end() ? street.line.front() : start->second, street.course,
                              end == held.end() ? street.line.back() : end->second);
}

std::shared_ptr<SceneFacts> facts_with(const SceneFacts& facts, std::vector<VolumeFacts> volumes) {
  auto other = std::make_shared<SceneFacts>(facts);
  make_columns(*other, volumes);
  other->volumes = published(VolumeList::Draft(std::move(volumes)));
  return other;
}

}  // namespace bl::desktop
