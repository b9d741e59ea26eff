// Reads what stands around the volumes from a state by the names of ports; what a scene lacks stays empty.
#include "core/reading/surroundings.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "core/reading/report_model.h"
#include "core/traffic/street_line.h"

namespace bl::report {

namespace {

// Points of a data layer beyond this are thinned for the eye; the tables have them all.
constexpr std::size_t kMostDataPoints = 1500;

const Value* surrounding_value(const State& state, std::uint32_t node, const char* type, const char* port) {
  const auto ref = state.plan->find(node, PortPath{type, port, ""});
  return ref ? &state.value(*ref) : nullptr;
}

bool is_on(const State& state, std::uint32_t node, const char* type, const char* port, bool fallback) {
  const Value* value = surrounding_value(state, node, type, port);
  const bool* flag = value == nullptr ? nullptr : std::get_if<bool>(value);
  return flag == nullptr ? fallback : *flag;
}

std::vector<Point3> ring_at(const State& state, std::uint32_t node, const char* type, const char* port) {
  const Value* value = surrounding_value(state, node, type, port);
  const auto* points = value == nullptr ? nullptr : std::get_if<Shared<std::vector<Point3>>>(value);
  return points == nullptr ? std::vector<Point3>{} : **points;
}

// The place of the one node that a selection names.
bool end_of_street(const State& state, std::uint32_t node, const char* port, Point3& place) {
  const Value* value = surrounding_value(state, node, "street", port);
  const auto* selection = value == nullptr ? nullptr : std::get_if<Shared<Selection>>(value);
  if (selection == nullptr || (*selection)->ids.size() != 1) return false;
  const std::uint32_t end = state.plan->node_index((*selection)->ids.front());
  if (end >= state.plan->nodes.size()) return false;
  place = point_at(state, end, "node", "position");
  return true;
}

void read_street_line(const State& state, std::uint32_t node, Surroundings& all) {
  Point3 start, end;
  if (!end_of_street(state, node, "start", start) || !end_of_street(state, node, "end", end)) return;
  const auto number = [&](const char* port) { return number_at(state, node, "street", port); };
  StreetLine street;
  street.name = name_at(state, node);
  street.line = street_line(start, ring_at(state, node, "street", "course"), end);
  street.lanes = number("lanes") * (is_on(state, node, "street", "one_way", false) ? 1 : 2);
  street.flow = number("flow_forth") + number("flow_back");
  street.load = number("volume_over_capacity");
  street.is_open = number("open") > 0;
  street.is_for_cars = is_on(state, node, "street", "for_cars", true);
  street.has_traffic = street.flow > 0;
  all.streets.push_back(std::move(street));
}

void read_building(const State& state, std::uint32_t node, Surroundings& all) {
  BuildingShape building;
  building.name = name_at(state, node);
  building.use = text_at(state, node, "existing_building", "use");
  building.mesh = mesh_at(state, node, "existing_building", "mesh");
  building.rings.push_back(ring_at(state, node, "existing_building", "outline"));
  std::map<std::string, std::vector<Point3>> courts;
  if (const Table* holes = table_at(state, node, "existing_building", "holes"))
    for (std::size_t row = 0; row < holes->rows.size(); ++row)
      courts[holes->text(row, "name")].push_back({holes->number(row, "x"), holes->number(row, "y"), 0});
  for (auto& [name, ring] : courts) building.rings.push_back(std::move(ring));
  building.height = number_at(state, node, "existing_building", "top") - number_at(state, node, "existing_building", "base");
  building.is_assumed = is_on(state, node, "existing_building", "is_assumed", false);
  if (building.rings.front().size() >= 3) all.buildings.push_back(std::move(building));
}

// From a point of the map half the way to its neighbour; where it has none, half the rectangle.
Vector3 half_of_square(const Table& map, std::size_t step, bool is_there, const Vector3& whole) {
  if (!is_there || step >= map.rows.size()) return whole;
  const auto at = [&](std::size_t row) { return Point3{map.number(row, "x"), map.number(row, "y"), map.number(row, "z")}; };
  return 0.5 * (at(step) - at(0));
}

void read_sun_field(const State& state, std::uint32_t node, Surroundings& all) {
  const Table* map = table_at(state, node, "shadow_receiver", "map");
  if (map == nullptr || map->rows.empty()) return;
  const auto number = [&](const char* port) { return number_at(state, node, "shadow_receiver", port); };
  SunField field;
  field.name = name_at(state, node);
  field.is_upright = is_on(state, node, "shadow_receiver", "upright", false);
  field.mean = number("sun_mean");
  field.possible = number("sun_possible");
  field.share_met = number("share_met");
  const auto columns = static_cast<std::size_t>(std::max(1.0, number("columns")));
  field.half_across = half_of_square(*map, 1, columns > 1, point_at(state, node, "shadow_receiver", "half_across"));
  field.half_up = half_of_square(*map, columns, map->rows.size() > columns, point_at(state, node, "shadow_receiver", "half_up"));
  all.most_sun = std::max(all.most_sun, field.possible);
  for (std::size_t row = 0; row < map->rows.size(); ++row) {
    field.points.emplace_back(Point3{map->number(row, "x"), map->number(row, "y"), map->number(row, "z")},
                              map->number(row, "sun"));
    all.most_sun = std::max(all.most_sun, field.points.back().second);
  }
  all.sun.push_back(std::move(field));
}

void read_data_field(const State& state, std::uint32_t node, Surroundings& all) {
  const Table* values = table_at(state, node, "data_layer", "values");
  if (values == nullptr || values->rows.empty()) return;
  DataField field;
  field.name = text_at(state, node, "data_layer", "quantity");
  if (field.name.empty()) field.name = name_at(state, node);
  field.unit = text_at(state, node, "data_layer", "unit");
  field.low = number_at(state, node, "data_layer", "minimum");
  field.high = number_at(state, node, "data_layer", "maximum");
  const std::size_t stride = values->rows.size() / kMostDataPoints + 1;
  for (std::size_t row = 0; row < values->rows.size(); row += stride)
    field.points.emplace_back(Point3{values->number(row, "x"), values->number(row, "y"), 0}, values->number(row, "value"));
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
  for (std::uint32_t n = 0; n < state.plan->nodes.size(); ++n) {
    const auto is = [&](const char* type) { return has_type(state, n, type); };
    if (is("street")) read_street_line(state, n, all);
    if (is("existing_building")) read_building(state, n, all);
    if (is("shadow_receiver")) read_sun_field(state, n, all);
    if (is("data_layer")) read_data_field(state, n, all);
    if (is("plot"))
      if (auto ring = ring_at(state, n, "plot", "polygon"); ring.size() >= 3)
        all.plots.emplace_back(name_at(state, n), std::move(ring));
    if (is("terrain"))
      if (const MeshPointer mesh = mesh_at(state, n, "terrain", "mesh"); mesh && !mesh->triangles.empty())
        all.grounds.push_back(mesh);
  }
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

}  // namespace bl::report
