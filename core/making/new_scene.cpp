// The nodes and links of a new scene.
#include "core/making/new_scene.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include <nlohmann/json.hpp>

#include "core/base/mathematics.h"
#include "core/base/text.h"
#include "core/define/codec.h"
#include "core/geometry/plan_ring.h"
#include "core/making/building_plan.h"
#include "core/making/spread_points.h"
#include "core/making/use_rates.h"

namespace bl::making {

namespace {

// Ids of the nodes that are no volumes; a use of the same name gets a number.
constexpr const char* kSite = "site";
constexpr const char* kProgramme = "programme";
constexpr const char* kSolver = "solver";
constexpr const char* kTotal = "total_floor_area";

// Shared facets that are asked for: a modest share of the smaller volume's face, and together no more of the hub's surface than
// can be had. The surface of a ball of volume V is 4.84 V^(2/3).
constexpr double kFacetShare = 0.15, kSurfaceShare = 0.3 * 4.84;

// A bar is no longer than this, but where the square around a courtyard would leave a courtyard narrower than that.
constexpr double kLongestBar = 4;   // length / depth
constexpr double kLeastCourt = 10;  // [m]

std::string numbered(std::size_t number, std::size_t count) {
  const std::string text = std::to_string(number), last = std::to_string(count);
  return std::string(last.size() - std::min(last.size(), text.size()), '0') + text;
}

std::string fresh_id(const std::string& wanted, std::set<std::string>& taken) {
  std::string id = wanted.substr(0, 56);
  for (int i = 2; !taken.insert(id).second; ++i) id = wanted.substr(0, 56) + "_" + std::to_string(i);
  return id;
}

// Of the ground that can be built on.
double plan_area(const SceneParts& parts) {
  double area = geometry::signed_area(parts.plan);
  for (const geometry::Ring& hole : parts.holes) area += geometry::signed_area(hole);
  return area - parts.open_area();
}

// The direction of the longest side of the plan, which blocks stand along [degree], from -45 to 45: a block has sides across it
// as well.
double block_angle(const geometry::Ring& plan) {
  constexpr double kHalfTurn = 3.14159265358979323846;
  const Vector3 side = main_direction(plan);
  double angle = mathematics::arc_tangent(side.y, side.x) * 180 / kHalfTurn;
  angle -= 90 * std::round(angle / 90);
  return std::round(angle * 1000) / 1000 + 0.0;
}

class Builder {
 public:
  Builder(const SceneParts& parts, const std::vector<BuildingPart>& buildings)
      : parts_(parts), buildings_(buildings), angle_(block_angle(parts.plan)) {}

  void setting(const std::string& id, const Json& value) { add(command<SetSetting>({id, JsonValue::of(value)})); }
  void node(const std::string& id, const Json& content) { add(command<AddNode>({id, JsonValue::of(content)})); }
  void link(const std::string& id, const Json& content) { add(command<AddLink>({id, JsonValue::of(content)})); }
  Command batch() const { return command<Batch>({commands_}); }

  void settings() {
    const importing::GeoReference& reference = parts_.reference;
    setting("title", parts_.title);
    setting("coordinate_system", reference.crs);
    setting("origin_x", reference.origin_x);
    setting("origin_y", reference.origin_y);
    if (reference.is_on_earth()) {
      setting("latitude", reference.latitude);
      setting("longitude", reference.longitude);
    }
    setting("true_north", reference.true_north);
  }

  void fixtures() {
    Json plan = Json::array();
    for (const Point3& corner : parts_.plan) plan.push_back({corner.x, corner.y, 0.0});
    Json boundary = {{"form", "plan"}, {"plan", plan}, {"height", parts_.height}};
    for (std::size_t h = 0; h < parts_.holes.size(); ++h)
      for (const Point3& corner : parts_.holes[h])
        boundary["holes"].push_back({{"name", "hole " + std::to_string(h + 1)}, {"x", corner.x}, {"y", corner.y}});
    for (const OpenPlace& place : parts_.open_places)
      for (const Point3& corner : place.ring)
        boundary["exclusions"].push_back({{"name", place.name},
                                          {"x", corner.x},
                                          {"y", corner.y},
                                          {"bottom", 0.0},
                                          {"top", parts_.height},
                                          {"use", parts_.programme.rows[place.row].use}});
    node(kSite, {{"name", "Site"}, {"types", {{"boundary", boundary}}}});
    Json rows = Json::array();
    for (const importing::ProgrammeRow& row : parts_.programme.rows) {
      if (row.is_below_ground) continue;  // no floor area
      const std::string name = row.name == row.use ? "" : row.name;
      rows.push_back({{"use", row.use},
                      {"floor_area", row.floor_area},
                      {"floor_area_min", row.floor_area_min.value_or(0)},
                      {"floor_area_max", row.floor_area_max.value_or(0)},
                      {"storey_height", row.storey_height},
                      {"count", static_cast<double>(row.count)},
                      {"standing", row.standing},
                      {"note", name + (name.empty() || row.note.empty() ? "" : "; ") + row.note}});
    }
    node(kProgramme, {{"name", "Programme"}, {"types", {{"programme", {{"rows", rows}}}}}});
    node(kSolver,
         {{"name", "Solver"}, {"types", {{parts_.is_standing ? "standing_solver" : "smart_volumes_solver", Json::object()}}}});
    node(kTotal, {{"name", "Total floor area"}, {"types", {{"statistics", {{"port", "smart_volume.floor_area"}}}}}});
  }

  // Where we can name a source, volumes get the figures of their use; the settings of the link would be nobody's.
  void uses(const std::vector<NewVolume>& volumes) {
    std::set<std::string> taken, named;
    for (const NewVolume& volume : volumes) taken.insert(volume.id);
    for (const importing::ProgrammeRow& row : parts_.programme.rows) {
      const UseRates* rates = rates_of(row);
      if ((rates == nullptr && !row.is_open) || row.is_below_ground || !named.insert(row.use).second) continue;
      if (row.is_open) {
        const Json ground = {
            {"use", row.use},
            {"is_open", true},
            {"least_sun", rates == nullptr ? 0 : rates->least_sun},
            {"source", rates == nullptr ? "open space by its row of the programme" : std::string(rates->source)}};
        node(fresh_id("use_" + to_identifier(row.use), taken), {{"name", "Use: " + row.use}, {"types", {{"use", ground}}}});
        continue;
      }
      const Json figures = {{"use", row.use},
                            {"people_per_100", rates->people},
                            {"parking_per_100", rates->parking},
                            {"trips_per_100", rates->trips},
                            {"out_share", rates->out_share},
                            {"least_sun", rates->least_sun},
                            {"most_noise", rates->most_noise},
                            {"source", std::string(rates->source)}};
      node(fresh_id("use_" + to_identifier(row.use), taken), {{"name", "Use: " + row.use}, {"types", {{"use", figures}}}});
    }
  }

  void volume(const NewVolume& volume, const BuildingPart& building) {
    const importing::ProgrammeRow& row = parts_.programme.rows[volume.row];
    Json tags = Json::array({row.use});
    for (const std::string& tag : row.tags)
      if (tag != row.use) tags.push_back(tag);
    Json types = {{"smart_volume", {{"use", row.use}, {"storey_height", row.storey_height}, {"standing", row.standing}}}};
    if (rates_of(row) != nullptr) types["use_figures"] = Json::object();
    if (parts_.is_standing) types["footprint"] = footprint_of(row, building);
    node(volume.id, {{"name", volume.name},
                     {"position", {volume.position.x, volume.position.y, volume.position.z}},
                     {"tags", tags},
                     {"types", types}});
  }

  // What carries volumes and what they share: links that people see, and can take away.
  void building_links(const std::vector<NewVolume>& volumes) {
    for (std::size_t v = 0; v < volumes.size(); ++v) {
      const BuildingPart& part = buildings_[v];
      if (part.base) {
        Json stack = {{"kind", "stack"}, {"from", volumes[*part.base].id}, {"to", volumes[v].id}};
        if (!part.is_alone_on_roof) stack["parameters"] = {{"centred", false}};
        link(fresh_id("on_roof_" + volumes[v].id, link_ids_), stack);
      }
      if (part.host)
        link(fresh_id("building_" + volumes[v].id, link_ids_),
             {{"kind", "share_footprint"}, {"from", volumes[*part.host].id}, {"to", volumes[v].id}});
    }
  }

  void general_links() {
    const Json all = {{"typification", "smart_volume"}};
    link("demands", {{"kind", "demand"}, {"from", kProgramme}, {"to", all}});
    link(kInsideLink, {{"kind", "inside_boundary"}, {"from", kSite}, {"to", all}, {"parameters", {{"margin", parts_.margin}}}});
    if (parts_.is_standing) return;
    // Wishes to touch pull volumes together and down; these keep each of them a body of its own that stands on something.
    link("room", {{"kind", "make_room"}, {"from", kSolver}, {"to", all}});
    link("standing", {{"kind", "stand"}, {"from", kSolver}, {"to", all}});
  }

  void contact(const WantedContact& contact, const std::vector<NewVolume>& volumes) {
    const NewVolume& hub = volumes[contact.hub];
    double area = kSurfaceShare * mathematics::power(hub.demand, 2.0 / 3) / static_cast<double>(contact.partners.size());
    Json partners = Json::array();
    for (const std::size_t partner : contact.partners) {
      area = std::min(area, kFacetShare * mathematics::power(std::min(hub.demand, volumes[partner].demand), 2.0 / 3));
      partners.push_back(volumes[partner].id);
    }
    // The one item of a use and all of another are named by their use, so that later items of that use take part too.
    const std::string& hub_use = parts_.programme.rows[hub.row].use;
    const std::string& partner_use = parts_.programme.rows[volumes[contact.partners.front()].row].use;
    const bool is_whole =
        contact.partners.size() == static_cast<std::size_t>(parts_.programme.rows[volumes[contact.partners.front()].row].count) &&
        parts_.programme.rows[hub.row].count == 1;
    const std::string id = fresh_id(
        "near_" + (is_whole ? to_identifier(hub_use) : hub.id).substr(0, 24) + "_" + to_identifier(partner_use).substr(0, 24),
        link_ids_);
    link(id, {{"kind", "adjacency"},
              {"from", is_whole ? Json{{"tag", hub_use}} : Json(hub.id)},
              {"to", is_whole ? Json{{"tag", partner_use}} : partners},
              {"parameters", {{"area", std::max(0.1, std::floor(area * 10) / 10)}}}});
  }

 private:
  void add(Command command) { commands_.push_back(std::move(command)); }

  // Of what shares the footprint of another one, only its place in that building counts.
  Json footprint_of(const importing::ProgrammeRow& row, const BuildingPart& building) const {
    Json footprint = {{"storeys", building.storeys}};
    if (building.order != 0) footprint["order"] = building.order;
    if (building.host) return footprint;
    if (angle_ != 0) footprint["angle"] = angle_;
    if (building.cellar_storeys != 0) footprint["cellar_storeys"] = building.cellar_storeys;
    if (const double depth = building.depth; depth > 0) {
      footprint["depth"] = depth;
      // A bar of that depth, until it would be so long that a courtyard is the better form. A square of the depth d around a
      // courtyard with the plate A has sides of A / (4 d) + d, and its courtyard has sides of A / (4 d) - d.
      const double aspect = building.footprint / (depth * depth), court = building.footprint / (4 * depth) - depth;
      if (aspect > 1 && (aspect <= kLongestBar || court < kLeastCourt)) footprint["aspect"] = std::round(aspect * 100) / 100;
    }
    // Half on either side, and towards the border; walls of neighbours do not touch then.
    if (row.distance.value_or(0) > 0) {
      footprint["setback"] = *row.distance / 2;
      footprint["party_walls"] = false;
    }
    return footprint;
  }

  const SceneParts& parts_;
  const std::vector<BuildingPart>& buildings_;  // of the volumes
  double angle_ = 0;                            // of blocks [degree]
  std::vector<Command> commands_;
  std::set<std::string> link_ids_{"demands", kInsideLink, "room", "standing"};
};

}  // namespace

std::vector<NewVolume> volumes_of(const importing::ProgrammeImport& programme) {
  std::set<std::string> taken{kSite, kProgramme, kSolver, kTotal};
  std::vector<NewVolume> volumes;
  for (std::size_t r = 0; r < programme.rows.size(); ++r) {
    const importing::ProgrammeRow& row = programme.rows[r];
    const std::size_t count = row.has_volumes() ? static_cast<std::size_t>(row.count) : 0;
    for (std::size_t i = 1; i <= count; ++i) {
      const std::string suffix = count > 1 ? "_" + numbered(i, count) : "", number = count > 1 ? " " + std::to_string(i) : "";
      volumes.push_back({fresh_id(to_identifier(row.use).substr(0, 48) + suffix, taken),
                         row.name + number,
                         r,
                         row.floor_area * row.storey_height,
                         {}});
    }
  }
  return volumes;
}

std::vector<WantedContact> contacts_of(const importing::ProgrammeImport& programme, const std::vector<NewVolume>& volumes) {
  std::map<std::string, std::size_t> row_of;
  for (std::size_t r = 0; r < programme.rows.size(); ++r) row_of[programme.rows[r].use] = r;
  std::vector<std::vector<std::size_t>> items(programme.rows.size());
  for (std::size_t v = 0; v < volumes.size(); ++v) items[volumes[v].row].push_back(v);
  // A wish that both rows express is one wish.
  std::set<std::pair<std::size_t, std::size_t>> wishes;
  for (std::size_t r = 0; r < programme.rows.size(); ++r)
    for (const std::string& other : programme.rows[r].adjacent_to)
      if (const auto it = row_of.find(other); it != row_of.end() && it->second != r) wishes.insert(std::minmax(r, it->second));
  std::vector<WantedContact> contacts;
  for (const auto& [a, b] : wishes) {
    const auto& hubs = items[a].size() <= items[b].size() ? items[a] : items[b];
    const auto& partners = items[a].size() <= items[b].size() ? items[b] : items[a];
    for (std::size_t h = 0; h < hubs.size(); ++h) {
      WantedContact contact{hubs[h], {}};
      for (std::size_t p = h; p < partners.size(); p += hubs.size()) contact.partners.push_back(partners[p]);
      contacts.push_back(std::move(contact));
    }
  }
  return contacts;
}

namespace {

// What stands on others or within their building touches it already.
void leave_out_own_building(std::vector<WantedContact>& contacts, const std::vector<BuildingPart>& buildings) {
  for (WantedContact& contact : contacts)
    std::erase_if(contact.partners,
                  [&](std::size_t partner) { return root_of(buildings, partner) == root_of(buildings, contact.hub); });
  std::erase_if(contacts, [](const WantedContact& contact) { return contact.partners.empty(); });
}

// First positions: those of volumes with ground of their own are spread, the others go with them.
Result<void> spread(const SceneParts& parts, const std::vector<WantedContact>& contacts,
                    const std::vector<BuildingPart>& buildings, std::vector<NewVolume>& volumes) {
  std::vector<double> demands;
  std::vector<std::uint8_t> on_ground;
  std::vector<std::size_t> place(volumes.size());  // of each volume: which of the points
  const auto root = [&](std::size_t v) { return parts.is_standing ? root_of(buildings, v) : v; };
  for (std::size_t v = 0; v < volumes.size(); ++v) {
    if (root(v) != v) continue;
    place[v] = demands.size();
    // What stands is spread in plan: as volumes of one metre with the area of their footprint.
    demands.push_back(parts.is_standing ? buildings[v].footprint : volumes[v].demand);
    on_ground.push_back(parts.is_standing || parts.programme.rows[volumes[v].row].standing == "ground" ? 1 : 0);
  }
  for (std::size_t v = 0; v < volumes.size(); ++v) place[v] = place[root(v)];
  std::vector<std::pair<std::size_t, std::size_t>> neighbours;
  for (const WantedContact& contact : contacts)
    for (const std::size_t partner : contact.partners) neighbours.emplace_back(place[contact.hub], place[partner]);
  const double height = parts.is_standing ? 1 : parts.height;
  std::vector<geometry::Ring> holes = parts.holes;
  for (const OpenPlace& open : parts.open_places) holes.emplace_back(open.ring.rbegin(), open.ring.rend());
  const auto points = spread_points(parts.plan, 0, height, demands, parts.seed, neighbours, holes, on_ground);
  if (!points) return points.error();
  // Millimetres are enough for a first position, and keep the file readable.
  const auto millimetres = [](double x) { return std::round(x * 1000) / 1000; };
  for (std::size_t v = 0; v < volumes.size(); ++v) {
    Point3 point = (*points)[place[v]];
    for (std::optional<std::size_t> at = v; at && parts.is_standing;
         at = buildings[*at].host ? buildings[*at].host : buildings[*at].base)
      point = point + buildings[*at].offset;
    volumes[v].position = {millimetres(point.x), millimetres(point.y), parts.is_standing ? 0 : millimetres(point.z)};
  }
  return {};
}

}  // namespace

Result<NewSceneCommand> new_scene_command(const SceneParts& parts) {
  NewSceneCommand made;
  std::vector<NewVolume> volumes = volumes_of(parts.programme);
  std::vector<WantedContact> contacts = contacts_of(parts.programme, volumes);
  const std::vector<BuildingPart> buildings =
      plan_buildings(parts, volumes, plan_area(parts), main_direction(parts.plan), made.notes);
  leave_out_own_building(contacts, buildings);
  if (auto done = spread(parts, contacts, buildings, volumes); !done) return done.error();
  Builder builder(parts, buildings);
  builder.settings();
  builder.fixtures();
  builder.uses(volumes);
  for (std::size_t v = 0; v < volumes.size(); ++v) builder.volume(volumes[v], buildings[v]);
  builder.general_links();
  builder.building_links(volumes);
  for (const WantedContact& contact : contacts) builder.contact(contact, volumes);
  for (std::size_t v = 0; v < volumes.size() && parts.is_standing; ++v)
    made.footprints += root_of(buildings, v) == v ? buildings[v].footprint : 0;
  made.command = builder.batch();
  return made;
}

}  // namespace bl::making
