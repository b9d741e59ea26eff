// Each element becomes one node: its ports as JSON, an id of its own, and a position in its middle.
#include "ui/cli/context_nodes.h"

#include <algorithm>
#include <cmath>

#include <nlohmann/json.hpp>

#include "core/base/text.h"
#include "core/define/codec.h"
#include "core/geometry/height_grid.h"
#include "core/geometry/plan_ring.h"

namespace bl::cli {

namespace {

// A tenth of a millimetre: files stay readable, and far finer than any survey.
double tidy(double number) {
  const double rounded = std::round(number * 1e4) / 1e4;
  return rounded == 0 ? 0 : rounded;
}

Json points_json(const std::vector<Point3>& points, bool with_heights) {
  Json list = Json::array();
  for (const Point3& p : points) list.push_back({tidy(p.x), tidy(p.y), with_heights ? tidy(p.z) : 0.0});
  return list;
}

Point3 middle(const std::vector<Point3>& points) {
  Point3 sum;
  for (const Point3& p : points) sum += p;
  return sum / static_cast<double>(std::max<std::size_t>(1, points.size()));
}

Json position_json(const Point3& p) { return {tidy(p.x), tidy(p.y), tidy(p.z)}; }

template <class Element>
const std::string& row_of(const Element& element) {
  return element.row.empty() ? element.id : element.row;
}

double length_of(const std::vector<Point3>& line) {
  double length = 0;
  for (std::size_t i = 1; i < line.size(); ++i) length += distance(line[i - 1], line[i]);
  return length;
}

// Values for ports that this program's typification really has, in the kind that it wants.
class Fitting {
 public:
  explicit Fitting(const TypificationDefinition& type) : type_(type) {}
  void set(const char* port, double value) {
    const PortDefinition* found = type_.find_port(port);
    if (found == nullptr || found->is_computed) return;
    const double fitted = std::clamp(value, found->hard_minimum, found->hard_maximum);
    if (found->kind == ValueKind::integer) values[port] = static_cast<std::int64_t>(std::llround(fitted));
    else if (found->kind == ValueKind::number) values[port] = fitted;
  }
  void set(const char* port, bool value) {
    const PortDefinition* found = type_.find_port(port);
    if (found != nullptr && !found->is_computed && found->kind == ValueKind::boolean) values[port] = value;
  }
  void set_node(const char* port, const std::string& id) {
    const PortDefinition* found = type_.find_port(port);
    if (found != nullptr && !found->is_computed && found->kind == ValueKind::selection) values[port] = Json::array({id});
  }
  void set(const char* port, const std::vector<Point3>& points) {
    const PortDefinition* found = type_.find_port(port);
    if (found != nullptr && !found->is_computed && found->kind == ValueKind::points) values[port] = points_json(points, true);
  }
  Json values = Json::object();

 private:
  const TypificationDefinition& type_;
};

}  // namespace

ContextNodes::ContextNodes(const Scene& scene, const Registry& registry) : registry_(&registry) {
  for (const auto& [id, node] : scene.nodes) taken_.insert(id);
}

std::string ContextNodes::fresh_id(const std::string& wanted) {
  const std::string stem = to_identifier(wanted);
  std::string id = stem;
  for (int i = 2; !taken_.insert(id).second; ++i) id = stem + "_" + std::to_string(i);
  return id;
}

void ContextNodes::place(const GeoReference& reference) {
  const auto set = [this](const std::string& id, const Json& value) {
    commands_.push_back(write_json_line(command_to_json(*registry_, command<SetSetting>({id, {write_json_line(value)}}))));
  };
  set("coordinate_system", reference.crs);
  set("origin_x", reference.origin_x);
  set("origin_y", reference.origin_y);
  set("latitude", reference.latitude);
  set("longitude", reference.longitude);
  set("true_north", reference.true_north);
}

Command ContextNodes::batch() const {
  std::string list = "[";
  for (const std::string& text : commands_) list += (list.size() > 1 ? "," : "") + text;
  return command<Batch>({{list + "]"}});
}

std::map<std::string, std::string> ContextNodes::add(const Context& context, const NodeMaking& making) {
  Uses uses;
  for (const ContextBuilding& building : context.buildings) {
    add_building(building, making);
    uses.use(row_of(building));
  }
  std::size_t ground = 0;
  for (const ContextArea& area : context.areas) {
    if (area.is_plot) {
      add_plot(area);
      uses.use(row_of(area));
    } else {
      ++ground;
      uses.leave(row_of(area), "there is no typification for it");
    }
  }
  if (ground > 0)
    notes_.push_back(std::to_string(ground) +
                     " areas of ground (land use, green, water) became no nodes: there is no typification for them.");
  if (!context.streets.empty()) add_streets(context, making, uses);
  for (const std::string& row : uses.used) uses.reasons.erase(row);
  return std::move(uses.reasons);
}

void ContextNodes::add_building(const ContextBuilding& building, const NodeMaking& making) {
  Json ports = {{"outline", points_json(building.outer, false)}};
  for (std::size_t h = 0; h < building.holes.size(); ++h)
    for (const Point3& corner : building.holes[h])
      ports["holes"].push_back({{"name", "court " + std::to_string(h + 1)}, {"x", tidy(corner.x)}, {"y", tidy(corner.y)}});
  ports["base"] = tidy(building.base);
  ports["height"] = std::max(0.01, tidy(building.height));
  ports["height_source"] = std::string(name_of(building.height_source));
  if (building.storey_height > 0) ports["storey_height"] = tidy(building.storey_height);
  if (!building.use.empty()) ports["use"] = building.use;
  ports["origin"] =
      building.id + (making.source.empty() ? "" : " of " + making.source) + (making.licence.empty() ? "" : ", " + making.licence);
  if (building.solid && !making.is_extruded) {
    ports["form"] = "mesh";
    ports["vertices"] = points_json(building.solid->vertices, true);
    for (const auto& [a, b, c] : building.solid->triangles) ports["triangles"].push_back({{"a", a}, {"b", b}, {"c", c}});
  }
  Point3 position = middle(building.outer);
  position.z = building.base;
  const std::string id = fresh_id("building_" + building.id);
  const Json node = {{"name", building.name.empty() ? building.id : building.name},
                     {"position", position_json(position)},
                     {"types", {{"existing_building", ports}}}};
  commands_.push_back(write_json_line(command_to_json(*registry_, command<AddNode>({id, {write_json_line(node)}}))));
  ++made_["existing_building"];
}

void ContextNodes::add_plot(const ContextArea& area) {
  const Json ports = {{"polygon", points_json(area.outer, false)}};
  const Json node = {{"name", area.name.empty() ? area.id : area.name},
                     {"position", position_json(middle(area.outer))},
                     {"types", {{"plot", ports}}}};
  commands_.push_back(
      write_json_line(command_to_json(*registry_, command<AddNode>({fresh_id("plot_" + area.id), {write_json_line(node)}}))));
  ++made_["plot"];
  if (!area.holes.empty()) notes_.push_back("The holes of plot `" + area.id + "` were left out: a plot is one polygon.");
}

void ContextNodes::add_streets(const Context& context, const NodeMaking& making, Uses& uses) {
  for (const ContextRestriction& turn : context.restrictions) uses.leave(turn.id, "the network of streets has no turns");
  const TypificationDefinition *junction = registry_->typification("junction"), *street = registry_->typification("street");
  if (junction == nullptr || street == nullptr) {
    notes_.push_back(std::to_string(context.streets.size()) +
                     " pieces of street became no nodes: this program has no typifications `junction` and `street`.");
    for (const ContextStreet& piece : context.streets) uses.leave(row_of(piece), "there is no typification for it");
    return;
  }
  std::vector<std::string> ids(context.junctions.size());
  const auto id_of = [&](std::size_t index) -> const std::string& {
    if (!ids[index].empty()) return ids[index];
    ids[index] = fresh_id("junction_" + context.junctions[index].id);
    const Json node = {{"name", context.junctions[index].id},
                       {"position", position_json(context.junctions[index].position)},
                       {"types", {{"junction", Json::object()}}}};
    commands_.push_back(write_json_line(command_to_json(*registry_, command<AddNode>({ids[index], {write_json_line(node)}}))));
    ++made_["junction"];
    return ids[index];
  };
  std::size_t without_cars = 0, loops = 0, courses = 0, cars_only = 0;
  for (const ContextStreet& piece : context.streets) {
    if (!piece.for_cars && !making.takes_all_streets) {
      ++without_cars;
      uses.leave(row_of(piece), "without cars; --all-streets takes it");
    } else if (piece.start == piece.end) {
      ++loops;
      uses.leave(row_of(piece), "it begins and ends at one junction");
    } else {
      uses.use(row_of(piece));
      courses += piece.line.size() > 2 ? 1 : 0;
      cars_only += piece.for_feet ? 0 : 1;
      Fitting fit(*street);
      fit.set_node("start", id_of(piece.start));
      fit.set_node("end", id_of(piece.end));
      // A street has lanes in each direction; maps count those of both together, and a narrow one is shared.
      fit.set("lanes", piece.is_one_way ? piece.lanes : std::max(1.0, piece.lanes / 2));
      fit.set("speed", piece.speed);
      fit.set("length", length_of(piece.line));
      fit.set("one_way", piece.is_one_way);
      fit.set("for_cars", piece.for_cars);
      fit.set("line", piece.line);
      const Json node = {{"name", piece.name.empty() ? piece.street_class + " " + piece.id : piece.name},
                         {"position", position_json(piece.line[piece.line.size() / 2])},
                         {"types", {{"street", fit.values}}}};
      commands_.push_back(write_json_line(
          command_to_json(*registry_, command<AddNode>({fresh_id("street_" + piece.id), {write_json_line(node)}}))));
      ++made_["street"];
    }
  }
  if (courses > 0 && street->find_port("line") == nullptr)
    notes_.push_back("The bends of " + std::to_string(courses) +
                     " pieces of street were left out: a street runs straight between its junctions, and keeps its length.");
  if (cars_only > 0)
    notes_.push_back(std::to_string(cars_only) + " pieces of street are closed to people on foot, which a street cannot say.");
  if (!making.licence.empty() && made_.contains("street"))
    notes_.push_back("Streets and junctions have no place for the licence " + making.licence +
                     ": name it beside what you publish.");
  if (without_cars > 0)
    notes_.push_back(std::to_string(without_cars) + " pieces of street without cars became no nodes; --all-streets takes them.");
  if (loops > 0)
    notes_.push_back(std::to_string(loops) + " pieces of street that begin and end at one junction became no nodes.");
  if (!context.restrictions.empty())
    notes_.push_back(std::to_string(context.restrictions.size()) +
                     " turn restrictions became nothing: the network of streets has no turns.");
}

void ContextNodes::add(const LocalTerrain& terrain, const NodeMaking& making) {
  double lowest = INFINITY, highest = -INFINITY;
  for (const double value : terrain.values)
    if (std::isfinite(value)) lowest = std::min(lowest, value), highest = std::max(highest, value);
  if (!std::isfinite(lowest)) lowest = highest = 0;
  lowest = std::floor(lowest * 100) / 100;
  // Centimetres, as long as the range of heights fits into three digits.
  double step = 0.01;
  while ((highest - lowest) / step > HeightGrid::kMostSteps) step *= 10;
  Json rows = Json::array();
  for (std::size_t row = 0; row < terrain.rows; ++row)
    rows.push_back(
        {{"heights", height_row(std::span(terrain.values).subspan(row * terrain.columns, terrain.columns), lowest, step)}});
  const Json ports = {{"rows", rows},
                      {"west", tidy(terrain.west)},
                      {"north", tidy(terrain.north)},
                      {"cell", terrain.cell},
                      {"lowest", lowest},
                      {"step", step},
                      {"origin", making.source + (making.licence.empty() ? "" : ", " + making.licence)}};
  const double east = terrain.west + terrain.cell * static_cast<double>(terrain.columns) / 2;
  const double south = terrain.north - terrain.cell * static_cast<double>(terrain.rows) / 2;
  const Json node = {{"name", "Terrain"}, {"position", position_json({east, south, lowest})}, {"types", {{"terrain", ports}}}};
  commands_.push_back(
      write_json_line(command_to_json(*registry_, command<AddNode>({fresh_id("terrain"), {write_json_line(node)}}))));
  ++made_["terrain"];
}

void ContextNodes::add(const DataLayer& layer, const NodeMaking& making) {
  Json rows = Json::array();
  std::vector<Point3> places;
  for (const LayerPoint& point : layer.points) {
    rows.push_back({{"x", tidy(point.x)}, {"y", tidy(point.y)}, {"value", point.value}});
    places.push_back({point.x, point.y, 0});
  }
  const Json ports = {{"values", rows},
                      {"quantity", layer.value_name},
                      {"unit", making.unit.empty() ? layer.unit : making.unit},
                      {"source", making.source},
                      {"licence", making.licence}};
  const Json node = {{"name", layer.value_name}, {"position", position_json(middle(places))}, {"types", {{"data_layer", ports}}}};
  commands_.push_back(write_json_line(
      command_to_json(*registry_, command<AddNode>({fresh_id("layer_" + layer.value_name), {write_json_line(node)}}))));
  ++made_["data_layer"];
}

}  // namespace bl::cli
