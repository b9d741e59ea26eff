// Reads the city's parts from a state by the names of their ports; what a scene lacks stays empty.
#include "ui/desktop/view/urban_facts.h"

#include <algorithm>
#include <cmath>

#include "core/reading/report_model.h"
#include "core/sun/solar_position.h"
#include "core/traffic/trip_flows.h"
#include "ui/desktop/view/scene_facts.h"

namespace bl::desktop {

namespace {

// Squares of a map lie so much above what they are measured on [m].
constexpr double kLift = 0.06;
// A data layer of more points than this is thinned for the eye.
constexpr std::size_t kMostPoints = 4000;

const Value* value_at(const State& state, std::uint32_t node, const char* type, const char* port) {
  const auto ref = state.plan->find(node, PortPath{type, port, ""});
  return ref ? &state.value(*ref) : nullptr;
}

bool flag_at(const State& state, std::uint32_t node, const char* type, const char* port, bool fallback) {
  const Value* value = value_at(state, node, type, port);
  const bool* flag = value == nullptr ? nullptr : std::get_if<bool>(value);
  return flag == nullptr ? fallback : *flag;
}

std::vector<Point3> points_at(const State& state, std::uint32_t node, const char* type, const char* port) {
  const Value* value = value_at(state, node, type, port);
  const auto* points = value == nullptr ? nullptr : std::get_if<Shared<std::vector<Point3>>>(value);
  return points == nullptr ? std::vector<Point3>{} : **points;
}

// The one node that a selection names, or the number of nodes.
std::uint32_t chosen_at(const State& state, std::uint32_t node, const char* type, const char* port) {
  const Value* value = value_at(state, node, type, port);
  const auto* selection = value == nullptr ? nullptr : std::get_if<Shared<Selection>>(value);
  if (selection == nullptr || (*selection)->ids.size() != 1) return static_cast<std::uint32_t>(state.plan->nodes.size());
  return state.plan->node_index((*selection)->ids.front());
}

void read_street(const State& state, std::uint32_t node, UrbanFacts& urban) {
  StreetFacts street;
  street.node = node;
  street.id = state.plan->nodes[node].id;
  street.start = chosen_at(state, node, "street", "start");
  street.end = chosen_at(state, node, "street", "end");
  if (street.start >= state.plan->nodes.size() || street.end >= state.plan->nodes.size()) return;
  street.flow = report::number_at(state, node, "street", "flow_forth") + report::number_at(state, node, "street", "flow_back");
  street.load = report::number_at(state, node, "street", "volume_over_capacity");
  street.is_open = report::number_at(state, node, "street", "open", 1) > 0 || flag_at(state, node, "street", "open", false);
  street.is_for_cars = flag_at(state, node, "street", "for_cars", true);
  street.course = points_at(state, node, "street", "course");
  urban.most_flow = std::max(urban.most_flow, street.flow);
  urban.streets.push_back(std::move(street));
}

void read_routes(const State& state, std::uint32_t node, UrbanFacts& urban) {
  const Value* value = value_at(state, node, "traffic_network", "trip_flows");
  const Made* made = value == nullptr ? nullptr : std::get_if<Made>(value);
  const auto trips = made == nullptr ? nullptr : made->get<TripFlows>();
  if (!trips) return;
  std::vector<std::uint32_t> street_of;  // by link; the number of nodes where it is no street
  for (const std::string& place : trips->places) street_of.push_back(state.plan->node_index(place));
  for (const TripFlows::Zone& zone : trips->zones) {
    const std::uint32_t from = state.plan->node_index(zone.id);
    if (from == state.plan->nodes.size()) continue;
    for (std::size_t k = 0; k < std::min(zone.links->size(), zone.flows->size()); ++k)
      if (const std::uint32_t link = (*zone.links)[k]; link < street_of.size() && street_of[link] < state.plan->nodes.size())
        urban.routes[from][street_of[link]] += (*zone.flows)[k];
  }
}

// A body as the renderer takes volumes: one part, wrapped onto a ball that is too large to cut anything.
MeshPointer as_cell(const Mesh& mesh) {
  Mesh cell{mesh.vertices, mesh.triangles, {}, {}};
  Point3 low = cell.vertices.front(), high = low;
  for (const Point3& v : cell.vertices) {
    low = {std::min(low.x, v.x), std::min(low.y, v.y), std::min(low.z, v.z)};
    high = {std::max(high.x, v.x), std::max(high.y, v.y), std::max(high.z, v.z)};
  }
  const Point3 centre = 0.5 * (low + high);
  MeshWrap wrap{centre,
                distance(low, high) + 1,
                {{static_cast<std::uint32_t>(cell.triangles.size()), centre, {}}},
                std::vector<std::uint32_t>(cell.vertices.size(), 0)};
  cell.wrap = std::make_shared<const MeshWrap>(std::move(wrap));
  return std::make_shared<const Mesh>(std::move(cell));
}

void read_body(const State& state, std::uint32_t node, const UrbanFacts* last, UrbanFacts& urban) {
  const MeshPointer mesh = report::mesh_at(state, node, "existing_building", "mesh");
  if (!mesh || mesh->triangles.empty() || mesh->vertices.size() >= 60000) return;
  BodyFacts body;
  if (last != nullptr)
    for (const BodyFacts& earlier : last->bodies)
      if (earlier.mesh == mesh) body = earlier;
  body.node = node;
  body.id = state.plan->nodes[node].id;
  body.name = report::name_at(state, node);
  body.is_assumed = flag_at(state, node, "existing_building", "is_assumed", false);
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

void read_sun_map(const State& state, std::uint32_t node, const UrbanFacts* last, UrbanFacts& urban) {
  const Table* map = report::table_at(state, node, "shadow_receiver", "map");
  if (map == nullptr || map->rows.empty()) return;
  SunMapFacts facts;
  facts.node = node;
  facts.id = state.plan->nodes[node].id;
  facts.source = map;
  facts.highest = report::number_at(state, node, "shadow_receiver", "sun_possible");
  for (std::size_t row = 0; row < map->rows.size(); ++row) facts.highest = std::max(facts.highest, map->number(row, "sun"));
  if (last != nullptr)
    for (const SunMapFacts& earlier : last->sun_maps)
      if (earlier.node == node && earlier.source == map && earlier.highest == facts.highest) facts.steps = earlier.steps;
  if (facts.steps.empty()) {
    const auto columns = static_cast<std::size_t>(std::max(1.0, report::number_at(state, node, "shadow_receiver", "columns")));
    const Vector3 across = half_step(*map, 1, columns, 2.0 * report::point_at(state, node, "shadow_receiver", "half_across"));
    const Vector3 up =
        half_step(*map, columns, map->rows.size() / columns, 2.0 * report::point_at(state, node, "shadow_receiver", "half_up"));
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

void read_layer(const State& state, std::uint32_t node, UrbanFacts& urban) {
  const Table* values = report::table_at(state, node, "data_layer", "values");
  if (values == nullptr || values->rows.empty()) return;
  DataFacts layer;
  layer.node = node;
  layer.id = state.plan->nodes[node].id;
  layer.quantity = report::text_at(state, node, "data_layer", "quantity");
  if (layer.quantity.empty()) layer.quantity = report::name_at(state, node);
  layer.unit = report::text_at(state, node, "data_layer", "unit");
  layer.low = report::number_at(state, node, "data_layer", "minimum");
  layer.high = report::number_at(state, node, "data_layer", "maximum");
  const std::size_t stride = values->rows.size() / kMostPoints + 1;
  for (std::size_t row = 0; row < values->rows.size(); row += stride)
    layer.values.emplace_back(Point3{values->number(row, "x"), values->number(row, "y"), 0}, values->number(row, "value"));
  urban.layers.push_back(std::move(layer));
}

void read_ring(const State& state, std::uint32_t node, std::vector<Point3> ring, bool is_overshot,
               std::vector<RingFacts>& rings) {
  if (ring.size() >= 3) rings.push_back({node, state.plan->nodes[node].id, std::move(ring), is_overshot});
}

DaylightSaving rule_of(const std::string& id) {
  if (id == "europe") return DaylightSaving::europe;
  if (id == "north_america") return DaylightSaving::north_america;
  return id == "australia" ? DaylightSaving::australia : DaylightSaving::none;
}

void read_sun(const State& state, std::uint32_t node, UrbanFacts& urban) {
  const auto number = [&](const char* port) { return report::number_at(state, node, "sun_and_sky", port); };
  const auto date = parse_date(report::text_at(state, node, "sun_and_sky", "date"));
  if (!date) return;  // the node's own error says so
  SunFacts sun;
  sun.node = node;
  sun.id = state.plan->nodes[node].id;
  sun.place = {number("latitude"),   number("longitude"),
               number("elevation"),  number("true_north"),
               number("utc_offset"), rule_of(report::text_at(state, node, "sun_and_sky", "daylight_saving")),
               number("delta_t"),    flag_at(state, node, "sun_and_sky", "refraction", true),
               number("pressure"),   number("temperature")};
  sun.added_days = std::floor(number("days"));
  sun.clock = {*date + static_cast<DayNumber>(sun.added_days), number("time")};
  sun.toward = direction_to_sun(sun.place, sun.clock);
  sun.is_ahead = sun.toward != report::point_at(state, node, "sun_and_sky", "direction");
  urban.suns.push_back(std::move(sun));
}

void read_caster(const State& state, std::uint32_t node, UrbanFacts& urban) {
  if (!flag_at(state, node, "shadow_caster", "casts", true)) return;
  const std::uint32_t study = keeper_of(*state.plan, node, "sun_study");
  const double ground = study < state.plan->nodes.size() ? report::number_at(state, study, "sun_study", "ground") : 0;
  for (const char* type : {"smart_volume", "existing_building"})
    if (const MeshPointer mesh = report::mesh_at(state, node, type, "mesh"); mesh && !mesh->triangles.empty())
      urban.casters.push_back({node, state.plan->nodes[node].id, mesh, ground});
}

std::int64_t age_of_sun(const State& state) {
  std::int64_t age = 0;
  for (std::size_t a = 0; a < state.analyses.size(); ++a) {
    const AnalysisPlan& plan = state.plan->analyses[a];
    if (state.plan->nodes[plan.node].types[plan.type].definition->id != "sun_study") continue;
    if (state.analyses[a].as_of < 0) return -1;
    age = std::max(age, state.tick - state.analyses[a].as_of);
  }
  return age;
}

}  // namespace

Vector3 direction_to_sun(const SunPlace& place, const SunClock& clock) {
  const SunPosition sun = sun_position(place, moment_of(place, clock.day, clock.seconds));
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
  UrbanFacts urban;
  for (std::uint32_t n = 0; n < state.plan->nodes.size(); ++n) {
    const auto is = [&](const char* type) { return report::has_type(state, n, type); };
    if (is("street")) read_street(state, n, urban);
    if (is("traffic_network")) read_routes(state, n, urban);
    if (is("existing_building")) read_body(state, n, last, urban);
    if (is("shadow_receiver")) read_sun_map(state, n, last, urban);
    if (is("data_layer")) read_layer(state, n, urban);
    if (is("shadow_caster")) read_ring(state, n, points_at(state, n, "shadow_caster", "outline"), false, urban.shadows);
    if (is("plot")) {
      std::vector<Point3> ring = points_at(state, n, "plot", "polygon");
      for (Point3& corner : ring) corner.z = report::number_at(state, n, "plot", "ground");
      read_ring(state, n, std::move(ring), report::number_at(state, n, "plot", "overshoot") > 0, urban.plots);
    }
    if (is("terrain"))
      if (const MeshPointer mesh = report::mesh_at(state, n, "terrain", "mesh"); mesh && !mesh->triangles.empty())
        urban.grounds.emplace_back(n, mesh);
    if (is("shadow_caster")) read_caster(state, n, urban);
    if (is("sun_and_sky")) read_sun(state, n, urban);
  }
  if (!urban.suns.empty() && urban.suns.front().toward.z > 0) urban.sun = urban.suns.front().toward;
  urban.sun_age = age_of_sun(state);
  return urban;
}

}  // namespace bl::desktop
