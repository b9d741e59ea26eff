// Reads what stands around the volumes from the views of it; what a scene lacks stays empty.
#include "core/reading/surroundings.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "core/reading/views/node.h"
#include "core/reading/views/plot.h"
#include "core/reading/views/sun.h"
#include "core/reading/views/surroundings.h"
#include "core/reading/views/traffic.h"
#include "core/traffic/street_line.h"

namespace bl::reading {

namespace {

// Points of a data layer beyond this are thinned for the eye; the tables have them all.
constexpr std::size_t kMostDataPoints = 1500;

// The place of the one node that a selection names.
std::optional<Point3> end_of_street(const State& state, const Selection& chosen) {
  if (chosen.ids.size() != 1) return std::nullopt;
  const std::uint32_t end = state.plan->node_index(chosen.ids.front());
  if (end >= state.plan->nodes.size()) return std::nullopt;
  return reading::read<&reading::NodePlace::position>(state, end);
}

void add_street(const State& state, std::uint32_t node, const reading::StreetFigures& read, Surroundings& all) {
  const auto start = end_of_street(state, read.start), end = end_of_street(state, read.end);
  if (!start || !end) return;
  StreetLine street;
  street.name = state.plan->nodes[node].name;
  street.line = traffic::street_line(*start, read.course, *end);
  street.lanes = read.lanes * (read.one_way ? 1 : 2);
  street.flow = read.flow_forth + read.flow_back;
  street.load = read.volume_over_capacity;
  street.is_open = read.open > 0;
  street.is_for_cars = read.for_cars;
  street.has_traffic = street.flow > 0;
  all.streets.push_back(std::move(street));
}

void add_building(const std::string& name, reading::BuildingFigures read, Surroundings& all) {
  BuildingShape building;
  building.name = name;
  building.use = read.use;
  building.mesh = read.mesh;
  building.rings.push_back(std::move(read.outline));
  std::map<std::string, std::vector<Point3>> courts;
  for (std::size_t row = 0; row < read.holes->rows.size(); ++row)
    courts[read.holes->text(row, "name")].push_back({read.holes->number(row, "x"), read.holes->number(row, "y"), 0});
  for (auto& [court, ring] : courts) building.rings.push_back(std::move(ring));
  building.height = read.top - read.base;
  building.is_assumed = read.is_assumed;
  if (building.rings.front().size() >= 3) all.buildings.push_back(std::move(building));
}

// From a point of the map half the way to its neighbour; where it has none, half the rectangle.
Vector3 half_of_square(const Table& map, std::size_t step, bool is_there, const Vector3& whole) {
  if (!is_there || step >= map.rows.size()) return whole;
  const auto at = [&](std::size_t row) { return Point3{map.number(row, "x"), map.number(row, "y"), map.number(row, "z")}; };
  return 0.5 * (at(step) - at(0));
}

void add_sun_field(const std::string& name, const reading::ReceiverFigures& read, Surroundings& all) {
  const Table& map = *read.map;
  if (map.rows.empty()) return;
  SunField field;
  field.name = name;
  field.is_upright = read.upright;
  field.mean = read.sun_mean;
  field.possible = read.sun_possible;
  field.required = read.required_sun;
  field.share_met = read.share_met;
  const auto columns = static_cast<std::size_t>(std::max<std::int64_t>(1, read.columns));
  field.half_across = half_of_square(map, 1, columns > 1, read.half_across);
  field.half_up = half_of_square(map, columns, map.rows.size() > columns, read.half_up);
  all.most_sun = std::max(all.most_sun, field.possible);
  for (std::size_t row = 0; row < map.rows.size(); ++row) {
    field.points.emplace_back(Point3{map.number(row, "x"), map.number(row, "y"), map.number(row, "z")}, map.number(row, "sun"));
    all.most_sun = std::max(all.most_sun, field.points.back().second);
  }
  all.sun.push_back(std::move(field));
}

void add_data_field(const std::string& name, const reading::DataLayerFigures& read, Surroundings& all) {
  const Table& values = *read.values;
  if (values.rows.empty()) return;
  DataField field;
  field.name = read.quantity.empty() ? name : read.quantity;
  field.unit = read.unit;
  field.low = read.minimum;
  field.high = read.maximum;
  const std::size_t stride = values.rows.size() / kMostDataPoints + 1;
  for (std::size_t row = 0; row < values.rows.size(); row += stride)
    field.points.emplace_back(Point3{values.number(row, "x"), values.number(row, "y"), 0}, values.number(row, "value"));
  all.data.push_back(std::move(field));
}

struct SurroundingsExtent {
  double low_x = 0, low_y = 0, high_x = 0, high_y = 0;
  bool is_empty = true;

  void take(const Point3& p) {
    low_x = is_empty ? p.x : std::min(low_x, p.x);
    high_x = is_empty ? p.x : std::max(high_x, p.x);
    low_y = is_empty ? p.y : std::min(low_y, p.y);
    high_y = is_empty ? p.y : std::max(high_y, p.y);
    is_empty = false;
  }
};

}  // namespace

Surroundings read_surroundings(const State& state) {
  Surroundings all;
  const auto name = [&](std::uint32_t node) -> const std::string& { return state.plan->nodes[node].name; };
  for (const auto& [node, street] : reading::rows<reading::StreetFigures>(state)) add_street(state, node, street, all);
  for (auto& [node, building] : reading::rows<reading::BuildingFigures>(state))
    add_building(name(node), std::move(building), all);
  for (const auto& [node, receiver] : reading::rows<reading::ReceiverFigures>(state)) add_sun_field(name(node), receiver, all);
  for (const auto& [node, layer] : reading::rows<reading::DataLayerFigures>(state)) add_data_field(name(node), layer, all);
  for (auto& [node, plot] : reading::rows<reading::PlotFigures>(state))
    if (plot.polygon.size() >= 3) all.plots.emplace_back(name(node), std::move(plot.polygon));
  for (const auto& [node, terrain] : reading::rows<reading::TerrainFigures>(state))
    if (terrain.mesh && !terrain.mesh->triangles.empty()) all.grounds.push_back(terrain.mesh);
  return all;
}

std::vector<Point3> framed(const std::vector<Point3>& core, const Surroundings& surroundings, double share) {
  SurroundingsExtent inner, outer;
  for (const Point3& point : core) inner.take(point);
  const auto around = [&](const Point3& point) { outer.take(point); };
  for (const StreetLine& street : surroundings.streets) std::for_each(street.line.begin(), street.line.end(), around);
  for (const BuildingShape& building : surroundings.buildings)
    std::for_each(building.rings.front().begin(), building.rings.front().end(), around);
  for (const SunField& field : surroundings.sun)
    for (const auto& [point, sun] : field.points) around(point);
  for (const DataField& field : surroundings.data)
    for (const auto& [point, value] : field.points) around(point);
  for (const MeshPointer& ground : surroundings.grounds) std::for_each(ground->vertices.begin(), ground->vertices.end(), around);
  for (const auto& [name, ring] : surroundings.plots) std::for_each(ring.begin(), ring.end(), around);
  if (outer.is_empty) return core;
  if (inner.is_empty) return {{outer.low_x, outer.low_y, 0}, {outer.high_x, outer.high_y, 0}};
  const double reach = share * std::max({inner.high_x - inner.low_x, inner.high_y - inner.low_y, 1.0});
  return {{std::min(inner.low_x, std::max(outer.low_x, inner.low_x - reach)),
           std::min(inner.low_y, std::max(outer.low_y, inner.low_y - reach)), 0},
          {std::max(inner.high_x, std::min(outer.high_x, inner.high_x + reach)),
           std::max(inner.high_y, std::min(outer.high_y, inner.high_y + reach)), 0}};
}

}  // namespace bl::reading
