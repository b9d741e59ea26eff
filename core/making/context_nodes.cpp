// Each element becomes one node: its ports as JSON, an id of its own, and a position in its middle.
#include "core/making/context_nodes.h"

#include <algorithm>
#include <cmath>

#include <nlohmann/json.hpp>

#include "core/base/plural.h"
#include "core/base/stop_check.h"
#include "core/base/text.h"
#include "core/define/codec.h"
#include "core/geometry/height_grid.h"
#include "core/geometry/plan_ring.h"
#include "core/import/thin_line.h"
#include "core/making/port_fitting.h"
#include "core/making/tidy_length.h"

namespace bl::making {

namespace {

// No street has more bends; where its file has more, those that count most are taken.
constexpr std::size_t kMostBends = 500;

Point3 middle(const std::vector<Point3>& points) {
  Point3 sum;
  for (const Point3& p : points) sum += p;
  return sum / static_cast<double>(std::max<std::size_t>(1, points.size()));
}

Point3 place_of(const importing::ContextBuilding& building) {
  Point3 place = middle(building.outer);
  place.z = building.base;
  return place;
}

Json position_json(const Point3& p) { return {tidy_length(p.x), tidy_length(p.y), tidy_length(p.z)}; }

double length_of(const std::vector<Point3>& line) {
  double length = 0;
  for (std::size_t i = 1; i < line.size(); ++i) length += distance(line[i - 1], line[i]);
  return length;
}

// All that was taken became the same node.
void name_all(importing::ImportReport& report, const std::string& id) {
  for (std::size_t row = 0; row < report.rows().size(); ++row)
    if (report.rows()[row].outcome != importing::ImportOutcome::skipped) report.made(row, id);
}

}  // namespace

ContextNodes::ContextNodes(const Scene& scene, const Registry& registry)
    : registry_(&registry), terrains_(terrains_of(scene, registry)), earlier_(scene, registry) {
  for (const auto& [id, node] : scene.nodes) taken_.insert(id);
}

std::string ContextNodes::fresh_id(const std::string& wanted) {
  const std::string stem = to_identifier(wanted);
  std::string id = stem;
  // From where the last one of that stem left off: files with one id for all of their features are large, too.
  std::size_t& number = numbers_[stem];
  while (!taken_.insert(id).second) id = stem + "_" + std::to_string(number = std::max<std::size_t>(2, number + 1));
  return id;
}

std::string ContextNodes::known_id(const std::string& kind, const std::string& wanted, const std::string& element,
                                   const Point3& place) {
  return earlier_.claim(kind, to_identifier(wanted), element, {tidy_length(place.x), tidy_length(place.y), tidy_length(place.z)});
}

std::string ContextNodes::id_of(const std::string& kind, const std::string& wanted, const std::string& element,
                                const Point3& place) {
  std::string known = known_id(kind, wanted, element, place);
  return known.empty() ? fresh_id(wanted) : known;
}

void ContextNodes::begin(const NodeMaking& making, std::set<std::string> elements) {
  earlier_.begin(making.source, making.licence, making.has_lasting_ids, std::move(elements));
}

void ContextNodes::end(const std::string& file, bool is_last) {
  bool is_first = true;
  for (const std::string& note : earlier_.end(is_last)) {
    notes_.push_back(is_first ? file + " " + note : note);
    is_first = false;
    is_again_ = true;
  }
}

void ContextNodes::place(const importing::GeoReference& reference) {
  const auto set = [this](const std::string& id, const Json& value) {
    commands_.push_back(command<SetSetting>({id, JsonValue::of(value)}));
  };
  set("coordinate_system", reference.crs);
  set("origin_x", reference.origin_x);
  set("origin_y", reference.origin_y);
  if (reference.is_on_earth()) {
    set("latitude", reference.latitude);
    set("longitude", reference.longitude);
  }
  set("true_north", reference.true_north);
}

Command ContextNodes::batch() const { return command<Batch>({commands_}); }

void ContextNodes::reach(const Point3& point) {
  auto& [low, high] = bounds_;
  low = {std::min(low.x, point.x), std::min(low.y, point.y), std::min(low.z, point.z)};
  high = {std::max(high.x, point.x), std::max(high.y, point.y), std::max(high.z, point.z)};
}

EarlierImports::Fate ContextNodes::add_node(const std::string& kind, const std::string& id, const std::string& element,
                                            const Json& node) {
  auto change = earlier_.put(kind, id, element, node);
  // What cannot be read as a node is refused where the commands are applied, with its place.
  if (!change) {
    commands_.push_back(command<AddNode>({id, JsonValue::of(node)}));
    return EarlierImports::Fate::made;
  }
  commands_.insert(commands_.end(), change->commands.begin(), change->commands.end());
  if (change->fate == EarlierImports::Fate::made) ++made_[kind];
  return change->fate;
}

void ContextNodes::set_port(const std::string& node, const std::string& path, const Value& value) {
  const auto parsed = parse_port_path(path);
  const auto port = parsed ? registry_->port(*parsed) : Result<const PortDefinition*>(Error{});
  if (!port) return;
  commands_.push_back(command<SetPort>({node, {path}, JsonValue::of(value_to_json(value, **port))}));
}

void ContextNodes::add(const importing::Context& context, const NodeMaking& making, SiteBuildings& sites,
                       importing::ImportReport& report) {
  Unused unused;
  add_buildings(context, making, sites, report, unused);
  std::size_t ground = 0;
  for (const importing::ContextArea& area : context.areas) {
    if (const std::string site = sites.site_without(area.row, area.id); !site.empty() && area.row != importing::kNoRow) {
      report.made(area.row, site);
      report.remark(area.row, "the site `" + site + "` leaves its ground out");
      continue;
    }
    if (!area.is_plot) {
      ++ground;
      if (area.row != importing::kNoRow) unused[area.row] = "there is no typification for it";
      continue;
    }
    const std::string id = add_plot(area);
    if (area.row != importing::kNoRow) report.made(area.row, id);
  }
  std::set<std::size_t> tracks;  // rows of rails that are told; the pieces of a line have one row
  for (const importing::ContextRail& rail : context.rails) {
    const std::string site = sites.site_without(rail.row, rail.id);
    if (site.empty()) unused[rail.row] = "there is no typification for it, and no site leaves its ground out";
    if (site.empty() || !tracks.insert(rail.row).second) continue;
    report.made(rail.row, site);
    report.remark(rail.row, "the site `" + site + "` leaves its ground out");
  }
  if (ground > 0)
    notes_.push_back(how_many(ground, "area") + " of ground (land use, green, water) became " +
                     by_number(ground, "no node", "no nodes") + ": there is no typification for that.");
  if (!context.streets.empty()) add_streets(context, making, report, unused);
  report.drop(unused);
}

void ContextNodes::add_buildings(const importing::Context& context, const NodeMaking& making, SiteBuildings& sites,
                                 importing::ImportReport& report, Unused& unused) {
  // Of buildings that are drawn by their parts: what the parts became.
  std::map<std::string, std::vector<std::string>> of_parts;
  std::set<std::string> cleared;  // buildings of which parts were left out
  for (std::size_t b = 0; b < context.buildings.size(); ++b) {
    if (is_stop_wished()) return;  // what is half made is dropped by who wished it
    if (b % 256 == 0) (void)goes_on(making.watch, "buildings", b, context.buildings.size());
    const importing::ContextBuilding& building = context.buildings[b];
    if (sites.is_cleared(b)) {
      const std::string spared = clear_building(building, b, sites);
      if (building.row != importing::kNoRow && spared.empty()) unused[building.row] = SiteBuildings::kClearedReason;
      if (building.row != importing::kNoRow && !spared.empty()) {
        report.made(building.row, spared);
        report.remark(building.row, std::string(SiteBuildings::kClearedReason) + ", and people have changed it: it stays");
      }
      cleared.insert(building.whole);
      continue;
    }
    const auto [id, fate] = add_building(building, making);
    if (building.row != importing::kNoRow) report.made(building.row, id);
    sites.keep(b, building, id, fate != EarlierImports::Fate::as_before, report);
    // An outline of several has the number of the outline behind the id of its element.
    if (!building.whole.empty()) of_parts[building.whole].push_back(id);
    if (const std::size_t slash = building.whole.rfind('/'); slash != std::string::npos)
      of_parts[building.whole.substr(0, slash)].push_back(id);
  }
  for (std::size_t row = 0; row < report.rows().size(); ++row) {
    const importing::ImportRow& one = report.rows()[row];
    if (one.id.empty() || one.outcome == importing::ImportOutcome::skipped || !one.made.empty()) continue;
    const auto parts = of_parts.find(one.id);
    if (parts != of_parts.end())
      for (const std::string& id : parts->second) report.made(row, id);
    else if (cleared.contains(one.id)) unused[row] = SiteBuildings::kClearedReason;
  }
}

std::string ContextNodes::clear_building(const importing::ContextBuilding& building, std::size_t number, SiteBuildings& sites) {
  const std::string id = known_id("existing_building", "building_" + building.id, building.id, place_of(building));
  if (id.empty()) return "";
  if (auto removal = earlier_.remove(id)) {
    commands_.push_back(std::move(*removal));
    sites.remove(number, id);
    return "";
  }
  sites.spare(number, id);
  return id;
}

std::pair<std::string, EarlierImports::Fate> ContextNodes::add_building(importing::ContextBuilding building,
                                                                        const NodeMaking& making) {
  // On a terrain of the scene it stands on its lowest ground.
  if (const auto ground = building.is_above_sea ? std::nullopt : lowest_along(terrains_, building.outer))
    building.base += *ground;
  Json ports = {{"outline", points_json(building.outer, false)}};
  for (std::size_t h = 0; h < building.holes.size(); ++h)
    for (const Point3& corner : building.holes[h])
      ports["holes"].push_back(
          {{"name", "court " + std::to_string(h + 1)}, {"x", tidy_length(corner.x)}, {"y", tidy_length(corner.y)}});
  ports["base"] = tidy_length(building.base);
  if (building.is_above_sea) ports["is_above_sea"] = true;
  ports["height"] = std::max(0.01, tidy_length(building.height));
  ports["height_source"] = std::string(name_of(building.height_source));
  if (building.storey_height > 0) ports["storey_height"] = tidy_length(building.storey_height);
  if (!building.use.empty()) ports["use"] = building.use;
  ports["origin"] =
      building.id + (making.source.empty() ? "" : " of " + making.source) + (making.licence.empty() ? "" : ", " + making.licence);
  if (building.solid && !making.is_extruded) {
    ports["form"] = "mesh";
    ports["vertices"] = points_json(building.solid->vertices, true);
    for (const auto& [a, b, c] : building.solid->triangles) ports["triangles"].push_back({{"a", a}, {"b", b}, {"c", c}});
  }
  const Point3 position = place_of(building);
  const std::string id = id_of("existing_building", "building_" + building.id, building.id, position);
  const Json node = {{"name", building.name.empty() ? building.id : building.name},
                     {"position", position_json(position)},
                     {"types", {{"existing_building", ports}}}};
  const EarlierImports::Fate fate = add_node("existing_building", id, building.id, node);
  for (const Point3& corner : building.outer) {
    reach({corner.x, corner.y, building.base});
    reach({corner.x, corner.y, building.base + building.height});
  }
  return {id, fate};
}

std::string ContextNodes::add_plot(const importing::ContextArea& area) {
  const Json ports = {{"polygon", points_json(area.outer, false)}};
  Json node = {{"name", area.name.empty() ? area.id : area.name},
               {"position", position_json(middle(area.outer))},
               {"types", {{"plot", ports}}}};
  const std::string id = id_of("plot", "plot_" + area.id, area.id, middle(area.outer));
  add_node("plot", id, area.id, node);
  for (const Point3& corner : area.outer) reach(corner);
  if (!area.holes.empty()) notes_.push_back("The holes of plot `" + area.id + "` were left out: a plot is one polygon.");
  return id;
}

void ContextNodes::add_streets(const importing::Context& context, const NodeMaking& making, importing::ImportReport& report,
                               Unused& unused) {
  if (registry_->typification("junction") == nullptr || registry_->typification("street") == nullptr) {
    notes_.push_back(how_many(context.streets.size(), "piece") +
                     " of street became no nodes: this program has no typifications `junction` and `street`.");
    return;
  }
  // Ids first: turn rules stand at junctions and name streets.
  std::vector<std::string> street_ids(context.streets.size()), junction_ids(context.junctions.size());
  std::size_t without_cars = 0, loops = 0, without_walkers = 0;
  for (std::size_t s = 0; s < context.streets.size() && !is_stop_wished(); ++s) {
    if (s % 256 == 0) (void)goes_on(making.watch, "streets", s, context.streets.size());
    const importing::ContextStreet& piece = context.streets[s];
    const auto leave = [&](std::size_t& count, const char* reason) {
      ++count;
      if (piece.row != importing::kNoRow) unused[piece.row] = reason;
    };
    if (!piece.for_cars && !making.takes_all_streets) {
      leave(without_cars, "without cars; it is taken where all streets are asked for");
    } else if (piece.start == piece.end && !(length_of(piece.line) > 0)) {
      leave(loops, "it leads nowhere");
    } else {
      street_ids[s] = id_of("street", "street_" + piece.id, piece.id, piece.line[piece.line.size() / 2]);
      if (!piece.for_feet) ++without_walkers;
    }
  }
  const std::map<std::size_t, Json> turns = turn_rules(context, street_ids, report, unused);
  const auto junction_at = [&](std::size_t index) -> const std::string& {
    if (junction_ids[index].empty()) {
      const auto rules = turns.find(index);
      junction_ids[index] = add_junction(context.junctions[index], rules == turns.end() ? Json::array() : rules->second);
    }
    return junction_ids[index];
  };
  for (std::size_t s = 0; s < context.streets.size(); ++s) {
    if (street_ids[s].empty()) continue;
    const std::string &start = junction_at(context.streets[s].start), &end = junction_at(context.streets[s].end);
    add_street(street_ids[s], context.streets[s], start, end, report);
    if (context.streets[s].row != importing::kNoRow) report.made(context.streets[s].row, street_ids[s]);
  }
  // A rule lies at its junction, which is there by now.
  for (const importing::ContextRestriction& turn : context.restrictions) {
    const bool holds = !street_ids[turn.from].empty() && !street_ids[turn.to].empty();
    if (turn.row == importing::kNoRow || !holds) continue;
    const auto& made = report.rows()[turn.row].made;
    if (std::find(made.begin(), made.end(), junction_ids[turn.via]) == made.end()) report.made(turn.row, junction_ids[turn.via]);
  }
  if (without_walkers > 0)
    notes_.push_back(how_many(without_walkers, "piece") + " of street " + by_number(without_walkers, "is", "are") +
                     " closed to people on foot, which a street cannot say.");
  if (without_cars > 0)
    notes_.push_back(how_many(without_cars, "piece") + " of street without cars became " +
                     by_number(without_cars, "no node", "no nodes") + ": such streets are taken where all are asked for.");
  if (loops > 0)
    notes_.push_back(how_many(loops, "piece") + " of street without any length became " +
                     by_number(loops, "no node.", "no nodes."));
}

std::string ContextNodes::add_junction(const importing::ContextJunction& junction, const Json& turns) {
  const std::string id = id_of("junction", "junction_" + junction.id, junction.id, junction.position);
  Json types = {{"junction", Json::object()}};
  if (!turns.empty()) types["turn_rules"] = {{"turns", turns}};
  Json node = {{"position", position_json(junction.position)}, {"types", types}};
  add_node("junction", id, junction.id, node);
  return id;
}

void ContextNodes::add_street(const std::string& id, const importing::ContextStreet& piece, const std::string& start,
                              const std::string& end, importing::ImportReport& report) {
  const importing::ThinLine thin = importing::thin_line(piece.line, kMostBends);
  const bool is_thinned = thin.points.size() < piece.line.size();
  if (is_thinned && piece.row != importing::kNoRow)
    report.mend(piece.row, std::to_string(thin.points.size() - 2) + " of the " + std::to_string(piece.line.size() - 2) +
                               " bends of " + piece.id + " were taken, the others lie within " +
                               fixed(std::max(0.01, std::ceil(thin.aside * 100) / 100), 2) + " m of its line");
  Fitting fit(*registry_->typification("street"));
  fit.set_node("start", start);
  fit.set_node("end", end);
  // A street has lanes in each direction; maps count those of both together, and a narrow one is shared.
  fit.set("lanes", piece.is_one_way ? piece.lanes : std::max(1.0, piece.lanes / 2));
  fit.set("speed", piece.speed);
  if (piece.line.size() > 2) fit.set("course", std::vector<Point3>(thin.points.begin() + 1, thin.points.end() - 1));
  // Else a street measures its line itself, also after somebody has moved a junction.
  if (is_thinned) fit.set("length", length_of(piece.line));
  fit.set("one_way", piece.is_one_way);
  fit.set("for_cars", piece.for_cars);
  Json node = {{"name", piece.name.empty() ? piece.street_class + " " + piece.id : piece.name},
               {"position", position_json(piece.line[piece.line.size() / 2])},
               {"types", {{"street", fit.values()}}}};
  add_node("street", id, piece.id, node);
  for (const Point3& point : piece.line) reach(point);
}

// Rows of turn rules by junction. A restriction holds only where both of its streets became nodes.
std::map<std::size_t, Json> ContextNodes::turn_rules(const importing::Context& context,
                                                     const std::vector<std::string>& street_ids, importing::ImportReport& report,
                                                     Unused& unused) {
  std::map<std::size_t, Json> rules;
  for (const importing::ContextRestriction& turn : context.restrictions) {
    const std::string &from = street_ids[turn.from], &to = street_ids[turn.to];
    if (from.empty() || to.empty()) {
      const std::string& street = context.streets[from.empty() ? turn.from : turn.to].id;
      notes_.push_back("Turn restriction `" + turn.id + "` (" + turn.rule + ") became nothing: `" + street + "` became no node.");
      if (turn.row != importing::kNoRow) {
        report.remark(turn.row, "`" + street + "` became no node");
        unused[turn.row] = "one of its streets became no node";
      }
      continue;
    }
    Json row = {{"from", from}, {"to", to}};
    if (turn.rule.starts_with("only_")) row["rule"] = "only";
    Json& rows = rules[turn.via];
    if (std::find(rows.begin(), rows.end(), row) == rows.end()) rows.push_back(std::move(row));
  }
  return rules;
}

void ContextNodes::add(const importing::LocalTerrain& terrain, const NodeMaking& making, importing::ImportReport& report) {
  double lowest = INFINITY, highest = -INFINITY;
  for (const double value : terrain.values)
    if (std::isfinite(value)) lowest = std::min(lowest, value), highest = std::max(highest, value);
  if (!std::isfinite(lowest)) lowest = highest = 0;
  lowest = std::floor(lowest * 100) / 100;
  // Centimetres, as long as the range of heights fits into three digits.
  double step = 0.01;
  while ((highest - lowest) / step > geometry::HeightGrid::kMostSteps) step *= 10;
  Json rows = Json::array();
  for (std::size_t row = 0; row < terrain.rows; ++row)
    rows.push_back({{"heights", geometry::height_row(std::span(terrain.values).subspan(row * terrain.columns, terrain.columns),
                                                     lowest, step)}});
  const Json ports = {{"rows", rows},
                      {"west", tidy_length(terrain.west)},
                      {"north", tidy_length(terrain.north)},
                      {"cell", terrain.cell},
                      {"lowest", lowest},
                      {"step", step},
                      {"origin", making.source + (making.licence.empty() ? "" : ", " + making.licence)}};
  const double east = terrain.west + terrain.cell * static_cast<double>(terrain.columns) / 2;
  const double south = terrain.north - terrain.cell * static_cast<double>(terrain.rows) / 2;
  Json node = {{"name", "Terrain"}, {"position", position_json({east, south, lowest})}, {"types", {{"terrain", ports}}}};
  const std::string id = id_of("terrain", "terrain", "terrain", {east, south, lowest});
  add_node("terrain", id, "terrain", node);
  name_all(report, id);
  reach({terrain.west, terrain.north, lowest});
  reach({2 * east - terrain.west, 2 * south - terrain.north, std::isfinite(highest) ? highest : lowest});
}

void ContextNodes::add(const importing::DataLayer& layer, const NodeMaking& making, importing::ImportReport& report) {
  Json rows = Json::array();
  std::vector<Point3> places;
  for (const importing::LayerPoint& point : layer.points) {
    rows.push_back({{"x", tidy_length(point.x)}, {"y", tidy_length(point.y)}, {"value", point.value}});
    places.push_back({point.x, point.y, 0});
  }
  const Json ports = {{"values", rows},
                      {"quantity", layer.value_name},
                      {"unit", making.unit.empty() ? layer.unit : making.unit},
                      {"source", making.source},
                      {"licence", making.licence}};
  Json node = {{"name", layer.value_name}, {"position", position_json(middle(places))}, {"types", {{"data_layer", ports}}}};
  const std::string id = id_of("data_layer", "layer_" + layer.value_name, layer.value_name, middle(places));
  add_node("data_layer", id, layer.value_name, node);
  name_all(report, id);
  for (const Point3& place : places) reach(place);
}

}  // namespace bl::making
