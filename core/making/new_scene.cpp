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

std::string numbered(std::size_t number, std::size_t count) {
  const std::string text = std::to_string(number), last = std::to_string(count);
  return std::string(last.size() - std::min(last.size(), text.size()), '0') + text;
}

std::string fresh_id(const std::string& wanted, std::set<std::string>& taken) {
  std::string id = wanted.substr(0, 56);
  for (int i = 2; !taken.insert(id).second; ++i) id = wanted.substr(0, 56) + "_" + std::to_string(i);
  return id;
}

// Storeys with which all footprints together cover so much of the plan, as many as fit under the height.
constexpr double kCoverage = 0.45;

// Of the ground that can be built on.
double plan_area(const SceneParts& parts) {
  double area = geometry::signed_area(parts.plan);
  for (const geometry::Ring& hole : parts.holes) area += geometry::signed_area(hole);
  return area - parts.open_area();
}

int storeys_for(const SceneParts& parts, const importing::ProgrammeRow& row) {
  if (row.storeys > 0) return row.storeys;
  const double storey_height = row.storey_height;
  const double needed = std::ceil(parts.programme.floor_area / (kCoverage * plan_area(parts)));
  return static_cast<int>(std::clamp(needed, 1.0, std::max(1.0, std::floor(parts.height / storey_height + 1e-9))));
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

// Figures of built uses are not those of open space of the same name, and the other way round.
const UseRates* rates_of(const importing::ProgrammeRow& row) {
  const UseRates* rates = use_rates(row.use);
  return rates != nullptr && rates->is_open == row.is_open ? rates : nullptr;
}

class Builder {
 public:
  explicit Builder(const SceneParts& parts) : parts_(parts), angle_(block_angle(parts.plan)) {}

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
    for (const importing::ProgrammeRow& row : parts_.programme.rows)
      rows.push_back({{"use", row.use},
                      {"floor_area", row.floor_area},
                      {"floor_area_min", row.floor_area_min.value_or(0)},
                      {"floor_area_max", row.floor_area_max.value_or(0)},
                      {"storey_height", row.storey_height},
                      {"count", static_cast<double>(row.count)},
                      {"standing", row.standing},
                      {"note", row.name == row.use ? "" : row.name}});
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
      if ((rates == nullptr && !row.is_open) || !named.insert(row.use).second) continue;
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

  void volume(const NewVolume& volume) {
    const importing::ProgrammeRow& row = parts_.programme.rows[volume.row];
    Json tags = Json::array({row.use});
    for (const std::string& tag : row.tags)
      if (tag != row.use) tags.push_back(tag);
    Json types = {{"smart_volume", {{"use", row.use}, {"storey_height", row.storey_height}, {"standing", row.standing}}}};
    if (rates_of(row) != nullptr) types["use_figures"] = Json::object();
    if (parts_.is_standing) types["footprint"] = {{"storeys", storeys_for(parts_, row)}};
    if (parts_.is_standing && angle_ != 0) types["footprint"]["angle"] = angle_;
    node(volume.id, {{"name", volume.name},
                     {"position", {volume.position.x, volume.position.y, volume.position.z}},
                     {"tags", tags},
                     {"types", types}});
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

  const SceneParts& parts_;
  double angle_ = 0;  // of blocks [degree]
  std::vector<Command> commands_;
  std::set<std::string> link_ids_{"demands", kInsideLink, "room", "standing"};
};

}  // namespace

std::vector<NewVolume> volumes_of(const importing::ProgrammeImport& programme) {
  std::set<std::string> taken{kSite, kProgramme, kSolver, kTotal};
  std::vector<NewVolume> volumes;
  for (std::size_t r = 0; r < programme.rows.size(); ++r) {
    const importing::ProgrammeRow& row = programme.rows[r];
    const std::size_t count = row.is_open ? 0 : static_cast<std::size_t>(row.count);
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

Result<Command> new_scene_command(const SceneParts& parts) {
  std::vector<NewVolume> volumes = volumes_of(parts.programme);
  const std::vector<WantedContact> contacts = contacts_of(parts.programme, volumes);
  std::vector<double> demands;
  std::vector<std::uint8_t> on_ground;
  for (const NewVolume& volume : volumes) {
    demands.push_back(volume.demand);
    on_ground.push_back(parts.programme.rows[volume.row].standing == "ground" ? 1 : 0);
  }
  std::vector<std::pair<std::size_t, std::size_t>> neighbours;
  for (const WantedContact& contact : contacts)
    for (const std::size_t partner : contact.partners) neighbours.emplace_back(contact.hub, partner);
  // What stands is spread in plan: as volumes of one metre with the area of their footprint.
  if (parts.is_standing)
    for (std::size_t v = 0; v < volumes.size(); ++v) {
      const importing::ProgrammeRow& row = parts.programme.rows[volumes[v].row];
      demands[v] = volumes[v].demand / (row.storey_height * storeys_for(parts, row));
      on_ground[v] = 1;
    }
  const double height = parts.is_standing ? 1 : parts.height;
  std::vector<geometry::Ring> holes = parts.holes;
  for (const OpenPlace& place : parts.open_places) holes.emplace_back(place.ring.rbegin(), place.ring.rend());
  const auto points = spread_points(parts.plan, 0, height, demands, parts.seed, neighbours, holes, on_ground);
  if (!points) return points.error();
  // Millimetres are enough for a first position, and keep the file readable.
  const auto millimetres = [](double x) { return std::round(x * 1000) / 1000; };
  for (std::size_t v = 0; v < volumes.size(); ++v)
    volumes[v].position = {millimetres((*points)[v].x), millimetres((*points)[v].y),
                           parts.is_standing ? 0 : millimetres((*points)[v].z)};
  Builder builder(parts);
  builder.settings();
  builder.fixtures();
  builder.uses(volumes);
  for (const NewVolume& volume : volumes) builder.volume(volume);
  builder.general_links();
  for (const WantedContact& contact : contacts) builder.contact(contact, volumes);
  return builder.batch();
}

}  // namespace bl::making
