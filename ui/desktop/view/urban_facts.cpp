// Reads the city's parts from a state by the views of them; what a scene lacks stays empty.
#include "ui/desktop/view/urban_facts.h"

#include <algorithm>
#include <cmath>

#include "core/reading/views/plot.h"
#include "core/reading/views/sun.h"
#include "core/reading/views/surroundings.h"
#include "core/reading/views/traffic.h"
#include "core/reading/views/volume.h"
#include "core/sun/solar_position.h"
#include "core/traffic/trip_flows.h"
#include "ui/desktop/view/scene_facts.h"

namespace bl::desktop {

namespace {

// Squares of a map lie so much above what they are measured on [m].
constexpr double kLift = 0.06;
// A data layer of more points than this is thinned for the eye.
constexpr std::size_t kMostPoints = 4000;

// The one node that a selection names, or the number of nodes.
std::uint32_t chosen_node(const State& state, const Selection& selection) {
  if (selection.ids.size() != 1) return static_cast<std::uint32_t>(state.plan->nodes.size());
  return state.plan->node_index(selection.ids.front());
}

void add_street(const State& state, std::uint32_t node, reading::StreetFigures&& read, UrbanFacts& urban) {
  StreetFacts street;
  street.node = node;
  street.id = state.plan->nodes[node].id;
  street.start = chosen_node(state, read.start);
  street.end = chosen_node(state, read.end);
  if (street.start >= state.plan->nodes.size() || street.end >= state.plan->nodes.size()) return;
  street.flow = read.flow_forth + read.flow_back;
  street.load = read.volume_over_capacity;
  street.is_open = read.open > 0;
  street.is_for_cars = read.for_cars;
  street.course = std::move(read.course);
  urban.most_flow = std::max(urban.most_flow, street.flow);
  urban.streets.push_back(std::move(street));
}

void add_routes(const State& state, const traffic::TripFlows& trips, UrbanFacts& urban) {
  std::vector<std::uint32_t> street_of;  // by link; the number of nodes where it is no street
  for (const std::string& place : trips.places) street_of.push_back(state.plan->node_index(place));
  for (const traffic::TripFlows::Zone& zone : trips.zones) {
    const std::uint32_t from = state.plan->node_index(zone.id);
    if (from == state.plan->nodes.size()) continue;
    for (std::size_t k = 0; k < std::min(zone.links->size(), zone.flows->size()); ++k)
      if (const std::uint32_t link = (*zone.links)[k]; link < street_of.size() && street_of[link] < state.plan->nodes.size())
        urban.routes[from][street_of[link]] += (*zone.flows)[k];
  }
}

void add_body(const State& state, std::uint32_t node, const reading::BuildingFigures& read, const UrbanFacts* last,
              UrbanFacts& urban) {
  const MeshPointer& mesh = read.mesh;
  if (!mesh || mesh->triangles.empty() || mesh->vertices.size() >= 60000) return;
  BodyFacts body;
  if (last != nullptr)
    for (const BodyFacts& earlier : last->bodies)
      if (earlier.mesh == mesh) body = earlier;
  body.node = node;
  body.id = state.plan->nodes[node].id;
  body.name = state.plan->nodes[node].name;
  body.is_assumed = read.is_assumed;
  if (!body.mesh) {
    body.mesh = mesh;
    body.cell = as_cell(*mesh);
    body.edges = sharp_edges(*mesh);
  }
  urban.bodies.push_back(std::move(body));
}

// Half the way to the next point of a row or column; where there is only one, half the rectangle.
Vector3 half_step(const Table& map, std::size_t step, std::size_t count, const Vector3& whole) {
  if (count < 2 || step >= map.rows.size()) return 0.5 * whole;
  const auto at = [&](std::size_t row) { return Point3{map.number(row, "x"), map.number(row, "y"), map.number(row, "z")}; };
  return 0.5 * (at(step) - at(0));
}

void add_sun_map(const State& state, std::uint32_t node, const reading::ReceiverFigures& read, const UrbanFacts* last,
                 UrbanFacts& urban) {
  const Shared<Table>& map = read.map;
  if (map->rows.empty()) return;
  SunMapFacts facts;
  facts.node = node;
  facts.id = state.plan->nodes[node].id;
  facts.source = &*map;
  facts.highest = read.sun_possible;
  for (std::size_t row = 0; row < map->rows.size(); ++row) facts.highest = std::max(facts.highest, map->number(row, "sun"));
  if (last != nullptr)
    for (const SunMapFacts& earlier : last->sun_maps)
      if (earlier.node == node && earlier.source == facts.source && earlier.highest == facts.highest) facts.steps = earlier.steps;
  if (facts.steps.empty()) {
    const auto columns = static_cast<std::size_t>(std::max<std::int64_t>(1, read.columns));
    const Vector3 across = half_step(*map, 1, columns, 2.0 * read.half_across);
    const Vector3 up = half_step(*map, columns, map->rows.size() / columns, 2.0 * read.half_up);
    const Vector3 normal = cross(across, up);
    const Vector3 lift = norm(normal) > 0 ? (kLift / norm(normal)) * normal : Vector3{0, 0, kLift};
    std::map<int, Mesh> meshes;
    for (std::size_t row = 0; row < map->rows.size(); ++row) {
      const double share = facts.highest > 0 ? map->number(row, "sun") / facts.highest : 0;
      Mesh& mesh = meshes[std::clamp(static_cast<int>(std::lround(share * kSunSteps)), 0, kSunSteps)];
      const Point3 at = Point3{map->number(row, "x"), map->number(row, "y"), map->number(row, "z")} + lift;
      const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
      for (const Vector3& corner : {-1.0 * across - up, across - up, across + up, up - across})
        mesh.vertices.push_back(at + corner);
      mesh.triangles.push_back({first, first + 1, first + 2});
      mesh.triangles.push_back({first, first + 2, first + 3});
    }
    for (auto& [step, mesh] : meshes) facts.steps[step] = std::make_shared<const Mesh>(std::move(mesh));
  }
  urban.sun_maps.push_back(std::move(facts));
}

void add_layer(const State& state, std::uint32_t node, const reading::DataLayerFigures& read, UrbanFacts& urban) {
  const Table& values = *read.values;
  if (values.rows.empty()) return;
  DataFacts layer;
  layer.node = node;
  layer.id = state.plan->nodes[node].id;
  layer.quantity = read.quantity.empty() ? state.plan->nodes[node].name : read.quantity;
  layer.unit = read.unit;
  layer.low = read.minimum;
  layer.high = read.maximum;
  const std::size_t stride = values.rows.size() / kMostPoints + 1;
  for (std::size_t row = 0; row < values.rows.size(); row += stride)
    layer.values.emplace_back(Point3{values.number(row, "x"), values.number(row, "y"), 0}, values.number(row, "value"));
  urban.layers.push_back(std::move(layer));
}

void add_ring(const State& state, std::uint32_t node, std::vector<Point3> ring, bool is_overshot, std::vector<RingFacts>& rings) {
  if (ring.size() >= 3) rings.push_back({node, state.plan->nodes[node].id, std::move(ring), is_overshot});
}

sun::DaylightSaving rule_of(const std::string& id) {
  if (id == "europe") return sun::DaylightSaving::europe;
  if (id == "north_america") return sun::DaylightSaving::north_america;
  return id == "australia" ? sun::DaylightSaving::australia : sun::DaylightSaving::none;
}

void add_sun(const State& state, std::uint32_t node, const reading::SunFigures& read, UrbanFacts& urban) {
  const auto date = sun::parse_date(read.date);
  if (!date) return;  // the node's own error says so
  SunFacts sun;
  sun.node = node;
  sun.id = state.plan->nodes[node].id;
  sun.place = {read.latitude, read.longitude,  read.elevation, read.true_north, read.utc_offset, rule_of(read.daylight_saving),
               read.delta_t,  read.refraction, read.pressure,  read.temperature};
  sun.added_days = std::floor(read.days);
  sun.clock = {*date + static_cast<sun::DayNumber>(sun.added_days), read.time};
  sun.toward = direction_to_sun(sun.place, sun.clock);
  sun.is_ahead = sun.toward != read.direction;
  urban.suns.push_back(std::move(sun));
}

void add_caster(const State& state, std::uint32_t node, UrbanFacts& urban) {
  const std::uint32_t study = keeper_of(*state.plan, node, reading::type_of<reading::SunStudyFigures>());
  const double ground = reading::read<&reading::SunStudyFigures::ground>(state, study);
  for (const MeshPointer& mesh :
       {reading::read<&reading::VolumeFigures::mesh>(state, node), reading::read<&reading::BuildingFigures::mesh>(state, node)})
    if (mesh) urban.casters.push_back({node, state.plan->nodes[node].id, mesh, ground});
}

std::int64_t age_of_sun(const State& state) {
  std::int64_t age = 0;
  for (std::size_t a = 0; a < state.analyses.size(); ++a) {
    const AnalysisPlan& plan = state.plan->analyses[a];
    if (!reading::is_a<reading::SunStudyFigures>(*state.plan->nodes[plan.node].types[plan.type].definition)) continue;
    if (state.analyses[a].as_of < 0) return -1;
    age = std::max(age, state.tick - state.analyses[a].as_of);
  }
  return age;
}

}  // namespace

Vector3 direction_to_sun(const sun::SunPlace& place, const SunClock& clock) {
  const sun::SunPosition sun = sun_position(place, moment_of(place, clock.day, clock.seconds));
  return scene_direction(place, sun.azimuth, sun.altitude);
}

std::uint32_t keeper_of(const Plan& plan, std::uint32_t node, std::string_view type) {
  for (const SetPlan& set : plan.sets)
    if (plan.nodes[set.node].types[set.type].definition->id == type &&
        std::binary_search(set.members.begin(), set.members.end(), node))
      return set.node;
  return static_cast<std::uint32_t>(plan.nodes.size());
}

UrbanFacts read_urban(const State& state, const UrbanFacts* last) {
  using namespace reading;
  UrbanFacts urban;
  for (auto& [node, street] : rows<reading::StreetFigures>(state)) add_street(state, node, std::move(street), urban);
  for (const auto& [node, network] : rows<reading::NetworkFigures>(state))
    if (network.trip_flows) add_routes(state, *network.trip_flows, urban);
  for (const auto& [node, building] : rows<reading::BuildingFigures>(state)) add_body(state, node, building, last, urban);
  for (const auto& [node, receiver] : rows<reading::ReceiverFigures>(state)) add_sun_map(state, node, receiver, last, urban);
  for (const auto& [node, layer] : rows<reading::DataLayerFigures>(state)) add_layer(state, node, layer, urban);
  for (auto& [node, caster] : rows<reading::CasterFigures>(state)) {
    add_ring(state, node, std::move(caster.outline), false, urban.shadows);
    if (caster.casts) add_caster(state, node, urban);
  }
  for (auto& [node, plot] : rows<reading::PlotFigures>(state)) {
    for (Point3& corner : plot.polygon) corner.z = plot.ground;
    add_ring(state, node, std::move(plot.polygon), plot.overshoot > 0, urban.plots);
  }
  for (const auto& [node, terrain] : rows<reading::TerrainFigures>(state))
    if (terrain.mesh && !terrain.mesh->triangles.empty()) urban.grounds.emplace_back(node, terrain.mesh);
  for (const auto& [node, sun] : rows<reading::SunFigures>(state)) add_sun(state, node, sun, urban);
  if (!urban.suns.empty() && urban.suns.front().toward.z > 0) urban.sun = urban.suns.front().toward;
  urban.sun_age = age_of_sun(state);
  return urban;
}

}  // namespace bl::desktop
