// The ground below a site is measured at the cells of the terrain inside it and along its border.
#include "core/making/site_on_ground.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <set>

#include <nlohmann/json.hpp>

#include "core/base/plural.h"
#include "core/base/text.h"
#include "core/define/codec.h"
#include "core/geometry/domain_table.h"
#include "core/making/earlier_imports.h"
#include "core/making/named_list.h"
#include "core/making/scene_ground.h"
#include "core/making/site.h"
#include "core/making/tidy_length.h"
#include "core/session/commands.h"

namespace bl::making {

namespace {

constexpr double kSameHeight = 0.01;   // [m]
constexpr double kLeastCovered = 0.5;  // [ratio] of a site; with less the terrain does not say how the site lies

// The heights of the ground below a site [m], and for how much of it the terrain has some.
struct Below {
  double lowest = std::numeric_limits<double>::infinity(), highest = -std::numeric_limits<double>::infinity();
  double sum = 0;  // of all that are known: another one where any has changed
  std::size_t places = 0, known = 0;
  bool operator==(const Below&) const = default;

  void add(const std::optional<double>& height) {
    ++places;
    if (!height) return;
    ++known;
    sum += *height;
    lowest = std::min(lowest, *height);
    highest = std::max(highest, *height);
  }
  double covered() const { return places == 0 ? 0 : static_cast<double>(known) / static_cast<double>(places); }
};

// Between cells the ground is bilinear: its ends lie at cells, or on the border.
Below below(const Site& site, const geometry::HeightGrid& grid) {
  Below found;
  double west = INFINITY, east = -INFINITY, south = INFINITY, north = -INFINITY;
  for (const std::vector<geometry::Ring>& rings : site.grounds)
    for (const geometry::Ring& ring : rings) {
      for (const Point3& a : ring) {
        west = std::min(west, a.x), east = std::max(east, a.x), south = std::min(south, a.y), north = std::max(north, a.y);
      }
      geometry::along(ring, grid.cell, [&](const Point3& place) { found.add(grid.sample(place.x, place.y)); });
    }
  const auto index = [](double value, std::size_t most) {
    return static_cast<std::size_t>(std::clamp(value, 0.0, static_cast<double>(most)));
  };
  const std::size_t last_row = grid.rows.size() - 1, last_column = grid.columns() - 1;
  for (std::size_t row = index((grid.north - north) / grid.cell, last_row); row <= last_row; ++row) {
    const double y = grid.north - static_cast<double>(row) * grid.cell;
    if (y < south) break;
    for (std::size_t column = index((west - grid.west) / grid.cell, last_column); column <= last_column; ++column) {
      const double x = grid.west + static_cast<double>(column) * grid.cell;
      if (x > east) break;
      if (is_on(site, {x, y, 0})) found.add(grid.at(row, column));
    }
  }
  return found;
}

class Standing {
 public:
  Standing(const Scene& before, const Scene& after, const Registry& registry)
      : before_(before), scene_(after), registry_(registry) {}

  SitesOnGround run() {
    old_grounds_ = terrains_of(before_, registry_);
    const std::vector<SceneTerrain> grounds = terrains_of(scene_, registry_);
    lift_buildings(grounds);
    const std::vector<Site> sites = sites_of(scene_, registry_);
    is_alone_ = sites.size() == 1;
    for (const Site& site : sites) {
      const SceneTerrain* best = nullptr;
      Below most;
      for (const SceneTerrain& ground : grounds)
        if (const Below found = below(site, ground.grid); found.covered() > most.covered()) best = &ground, most = found;
      if (best != nullptr) stand(site, *best, most);
      else tell_beside(site, grounds);
      tell_unused(site, grounds);
    }
    return std::move(made_);
  }

 private:
  const Value& value(const NodeRecord& node, const char* type, const char* port) const {
    const TypificationDefinition* definition = registry_.typification(type);
    return set_value(scene_, node, *definition, *definition->find_port(port));
  }
  void set(const std::string& node, const std::string& port, const Json& json) {
    made_.commands.push_back(command<SetPort>({node, {port}, JsonValue::of(json)}));
  }
  void set_table(const std::string& node, const char* port, Table table) {
    const PortDefinition& definition = *registry_.typification("boundary")->find_port(port);
    set(node, std::string("boundary.") + port, value_to_json(Shared<Table>(std::move(table)), definition));
  }

  // Elements of OpenStreetMap: ways and relations with their numbers.
  bool is_of_map(const NodeRecord& node) const {
    const auto& element = std::get<std::string>(value(node, "imported", "element"));
    return element.size() > 1 && (element[0] == 'w' || element[0] == 'r') && element[1] >= '0' && element[1] <= '9';
  }

  // Buildings whose heights count from the ground, and which people have left as an import has set them.
  void lift_buildings(const std::vector<SceneTerrain>& grounds) {
    std::size_t count = 0;
    for (const auto& [id, node] : scene_.nodes) {
      const auto types = node.types.find("imported");
      if (types == node.types.end() || !node.types.contains("existing_building")) continue;
      if (std::get<bool>(value(node, "existing_building", "is_above_sea"))) continue;
      const auto outline = std::get<Shared<std::vector<Point3>>>(value(node, "existing_building", "outline"));
      const auto ground = lowest_along(grounds, *outline);
      if (!ground) continue;
      const double rise = *ground - lowest_along(old_grounds_, *outline).value_or(0);
      if (std::abs(rise) < kSameHeight) continue;
      // Of files before `is_above_sea` only maps are known to count heights from the ground.
      const double base = as_number(value(node, "existing_building", "base"));
      if (base != 0 && !is_of_map(node)) continue;
      NodeRecord lifted = node;
      Point3 place = std::get<Vector3>(value(node, "node", "position"));
      place.z = tidy_length(place.z + rise);
      lifted.types["node"]["position"] = place;
      lifted.types["existing_building"]["base"] = tidy_length(base + rise);
      const bool is_left = set_as_imported(lifted, node, registry_);
      // Where people have changed it already, they may have set where it begins.
      if (!is_left && base != 0) continue;
      set(id, "existing_building.base", tidy_length(base + rise));
      set(id, "node.position", {place.x, place.y, place.z});
      if (is_left) set(id, "imported.as_read", std::get<std::string>(lifted.types["imported"]["as_read"]));
      lifted_.insert(id);
      ++count;
    }
    if (count > 0)
      made_.notes.push_back(
          how_many(count, "building") + by_number(count, " of the surroundings has", " of the surroundings have") +
          " heights above the ground: " + by_number(count, "it stands", "each stands") + " on its lowest ground now.");
  }

  // A further terrain below a site whose volumes follow another one.
  void tell_unused(const Site& site, const std::vector<SceneTerrain>& grounds) {
    for (const SceneTerrain& ground : grounds) {
      if (before_.nodes.contains(ground.id) || !(below(site, ground.grid).covered() > 0)) continue;
      const NodeRecord& node = scene_.nodes.find(ground.id)->second;
      std::string other;
      bool is_followed = false;
      for (const auto& [id, link] : scene_.links)
        if (link.kind == "terrain_follow" && link.is_enabled) {
          if (selects(registry_, link.from, ground.id, node)) is_followed = true;
          else if (other.empty()) other = id;
        }
      if (!is_followed && !other.empty())
        made_.warnings.push_back("The terrain `" + ground.id + "` lies below the site `" + site.id + "` too, and the link `" +
                                 other + "` follows another one: connect that link to `" + ground.id +
                                 "`, or remove one of the terrains.");
    }
  }

  void tell_beside(const Site& site, const std::vector<SceneTerrain>& grounds) {
    for (const SceneTerrain& ground : grounds)
      if (!before_.nodes.contains(ground.id))
        made_.warnings.push_back("The terrain `" + ground.id + "` has no height anywhere on the site `" + site.id +
                                 "`, which stays at " + fixed(site.bottom, 1) +
                                 " m: import one that covers the site, with a larger --radius or another file.");
  }

  void stand(const Site& site, const SceneTerrain& ground, const Below& found) {
    const NodeRecord& node = scene_.nodes.find(site.id)->second;
    const double lowest = floor_of(found.lowest);
    const bool is_plan = std::get<std::string>(value(node, "boundary", "form")) == "plan";
    const SceneTerrain* old = old_ground(site, ground, found);
    // What an import has set to the ground that a terrain had goes with the terrain.
    const bool is_new = !before_.nodes.contains(ground.id) || old != nullptr;
    const bool is_unsaid = !node.types.at("boundary").contains("bottom") || old != nullptr;
    const bool is_apart = site.bottom > found.highest + kSameHeight || site.bottom < lowest - kSameHeight;
    const std::string heights = "The ground below the site `" + site.id + "` lies between " + fixed(found.lowest, 1) + " and " +
                                fixed(found.highest, 1) + " m, the site at " + fixed(site.bottom, 1) + " m";
    if (found.covered() < kLeastCovered || !is_plan || (!is_unsaid && is_apart) || (!is_new && is_apart)) {
      if (is_apart)
        made_.warnings.push_back(
            heights +
            (found.covered() < kLeastCovered ? ", and the terrain covers " + percent(found.covered()) + " of it"
             : !is_plan                      ? ", and its form is no plan with a `bottom`"
             : !is_unsaid                    ? ", which somebody has set"
                                             : ", and the terrain was there before") +
            ": it stays there, and its volumes do not stand on the ground. " + remedy(found, is_plan, lowest));
      return;
    }
    if (!is_new) return;
    std::string sentence;
    const double rise = lowest - site.bottom, more = growth(site, {ground, old}, found);
    if (is_unsaid && (std::abs(rise) > kSameHeight || more > kSameHeight || old != nullptr))
      sentence = lift(site, node, {ground, old}, found, lowest);
    const std::string link = add_link(ground);
    if (!link.empty())
      sentence += (sentence.empty() ? heights + ". The link `" : " The link `") + link + "` sets all volumes that stand on it.";
    if (!sentence.empty()) made_.notes.push_back(sentence);
    if (found.known < found.places && !link.empty())
      made_.warnings.push_back("The terrain has a height for " + percent(found.covered()) + " of the site `" + site.id +
                               "`: a volume beside that is an error, until it is moved or `needs_ground` of the link `" + link +
                               "` is off.");
  }

  // A terrain, and as it was before.
  struct Change {
    const SceneTerrain& ground;
    const SceneTerrain* old;
    // How much higher the ground is now at a place; `lowest` and `bottom`: of the site, where the terrains say nothing.
    double at(const Point3& place, double lowest, double bottom) const {
      const auto before = old == nullptr ? std::optional<double>() : old->grid.sample(place.x, place.y);
      return ground.grid.sample(place.x, place.y).value_or(lowest) - before.value_or(bottom);
    }
  };

  // The terrain as it was, where the site began at its lowest ground and the ground below it is another one now.
  const SceneTerrain* old_ground(const Site& site, const SceneTerrain& ground, const Below& found) const {
    for (const SceneTerrain& old : old_grounds_)
      if (const Below before = old.id == ground.id ? below(site, old.grid) : Below();
          before.known > 0 && !(before == found) && std::abs(floor_of(before.lowest) - site.bottom) < kSameHeight)
        return &old;
    return nullptr;
  }

  // Down to a centimetre; whole ones stay, whatever the last bits of the grid are.
  static double floor_of(double lowest) { return tidy_length(std::floor(lowest * 100 + 1e-3) / 100); }

  static std::string percent(double ratio) { return fixed(std::floor(100 * ratio), 0) + " %"; }
  std::string remedy(const Below& found, bool is_plan, double lowest) const {
    if (found.covered() < kLeastCovered) return "Import a terrain that covers the site, with a larger --radius.";
    const std::string raise = is_plan ? "Set its `bottom` to " + shortest(lowest) + " m" : "Raise its corners";
    return raise + (has_link() ? "." : ", and add a link `terrain_follow` from the terrain to its volumes.");
  }

  // The sentence about it.
  std::string lift(const Site& site, const NodeRecord& node, const Change& change, const Below& found, double lowest) {
    const double rise = lowest - site.bottom, height = as_number(value(node, "boundary", "height"));
    const double more = growth(site, change, found);
    if (rise != 0) set(site.id, "boundary.bottom", lowest);
    if (more != 0) set(site.id, "boundary.height", tidy_length(height + more));
    lift_exclusions(site, rise, more, lowest);
    lift_tables(site.id, node, rise, more);
    lift_nodes(site, change, rise, lowest);
    if (rise == 0 && more == 0) return "What stands on the site `" + site.id + "` follows the new heights of its ground.";
    return "The site `" + site.id + "` begins at " + fixed(lowest, 2) + " m now, its lowest ground, instead of " +
           shortest(site.bottom) + " m, and " +
           (more == 0 ? "keeps its height of " + shortest(height) + " m; its"
                      : "its height is " + shortest(tidy_length(height + more)) + " m instead of " + shortest(height) +
                            " m, because its") +
           " ground rises up to " + fixed(found.highest, 2) + " m.";
  }

  // How much higher the site becomes [m], so that uphill there is as much room above the ground as there was; never lower,
  // because people may have set its height since.
  static double growth(const Site& site, const Change& change, const Below& found) {
    const double before = change.old == nullptr ? 0 : relief_of(below(site, change.old->grid));
    return tidy_length(std::max(0.0, relief_of(found) - before));
  }

  // [m], in whole centimetres
  static double relief_of(const Below& found) {
    return found.known == 0 ? 0 : tidy_length(std::ceil(found.highest * 100 - 1e-3) / 100) - floor_of(found.lowest);
  }

  // What reaches over the whole height of the site still does; what ends below the ground counted from it, all else from the sea.
  void lift_exclusions(const Site& site, double rise, double more, double lowest) {
    Table rows = site.rows;
    const std::size_t name = rows.column("name"), bottom = rows.column("bottom"), top = rows.column("top");
    for (const geometry::NamedRing& ring : geometry::read_rings(site.rows)) {
      const bool is_whole = ring.bottom <= site.bottom && ring.top > site.top - kSameHeight;
      if (!is_whole && ring.top > lowest) continue;
      for (TableRow& row : rows.rows)
        if (std::get<std::string>(row[name]) == ring.name) {
          row[bottom] = tidy_length(ring.bottom + rise);
          row[top] = tidy_length(ring.top + rise + (is_whole ? more : 0));
        }
    }
    if (rows != site.rows) set_table(site.id, "exclusions", std::move(rows));
  }

  void lift_tables(const std::string& id, const NodeRecord& node, double rise, double more) {
    const auto rows_of = [&](const char* port) { return *std::get<Shared<Table>>(value(node, "boundary", port)); };
    if (Table steps = rows_of("steps"); !steps.rows.empty()) {
      const std::size_t top = steps.column("top");
      for (const geometry::NamedRing& ring : geometry::read_rings(steps))
        steps.rows[ring.first_row][top] = tidy_length(ring.top + rise + more);
      set_table(id, "steps", std::move(steps));
    }
    if (Table planes = rows_of("setbacks"); !planes.rows.empty()) {
      const std::size_t offset = planes.column("offset");
      for (std::size_t row = 0; row < planes.rows.size(); ++row) {
        const Vector3 normal{planes.number(row, "x"), planes.number(row, "y"), planes.number(row, "z")};
        if (norm(normal) > 0)
          planes.rows[row][offset] = tidy_length(planes.number(row, "offset") + rise * normal.z / norm(normal));
      }
      set_table(id, "setbacks", std::move(planes));
    }
  }

  // Plots count heights from their ground; rounded volumes and places whose sun counts have heights of their own.
  void lift_nodes(const Site& site, const Change& change, double rise, double lowest) {
    std::size_t sunk = 0;
    for (const auto& [id, node] : scene_.nodes) {
      const Point3 place = std::get<Vector3>(value(node, "node", "position"));
      const bool is_rounded = node.types.contains("smart_volume") && !node.types.contains("footprint");
      const bool is_imported = node.types.contains("imported");
      if (node.types.contains("existing_building") && !lifted_.contains(id))
        sunk +=
            as_number(value(node, "existing_building", "base")) + as_number(value(node, "existing_building", "height")) <= lowest
                ? 1
                : 0;
      if (node.types.contains("plot") && std::abs(as_number(value(node, "plot", "ground")) - site.bottom) < kSameHeight) {
        const auto polygon = std::get<Shared<std::vector<Point3>>>(value(node, "plot", "polygon"));
        if (polygon->size() >= 3 &&
            std::any_of(site.grounds.begin(), site.grounds.end(),
                        [&](const std::vector<geometry::Ring>& rings) { return area_on(rings, {&*polygon}) > 1; }))
          set(id, "plot.ground", lowest);
      }
      if (is_imported || !(is_rounded || node.types.contains("shadow_receiver"))) continue;
      if (!is_on(site, place) && !(is_rounded && is_alone_)) continue;
      const double up = is_rounded ? rise : change.at(place, lowest, site.bottom);
      set(id, "node.position", {tidy_length(place.x), tidy_length(place.y), tidy_length(place.z + up)});
    }
    if (sunk > 0)
      made_.warnings.push_back(how_many(sunk, "building") +
                               by_number(sunk, " of the surroundings ends", " of the surroundings end") +
                               " below the ground of the site, and the terrain does not reach " + by_number(sunk, "it", "them") +
                               ", or people have set where " + by_number(sunk, "it begins", "they begin") +
                               ": set `base` to the height of the ground there, or no shadow reaches the site.");
  }

  bool has_link() const {
    return std::any_of(scene_.links.begin(), scene_.links.end(),
                       [](const auto& entry) { return entry.second.kind == "terrain_follow"; });
  }

  // One for all volumes of the scene; its id; empty where there is one already, or no volume stands.
  std::string add_link(const SceneTerrain& ground) {
    const bool is_any = std::any_of(scene_.nodes.begin(), scene_.nodes.end(),
                                    [](const auto& entry) { return entry.second.types.contains("footprint"); });
    if (!is_any || is_linked_ || has_link()) return "";
    is_linked_ = true;
    std::string id = "on_ground";
    for (int number = 2; scene_.links.contains(id); ++number) id = "on_ground_" + std::to_string(number);
    made_.commands.push_back(command<AddLink>(
        {id, JsonValue::of(Json{{"kind", "terrain_follow"}, {"from", ground.id}, {"to", {{"typification", "footprint"}}}})}));
    return id;
  }

  const Scene &before_, &scene_;
  const Registry& registry_;
  bool is_alone_ = false, is_linked_ = false;
  std::set<std::string> lifted_;           // buildings
  std::vector<SceneTerrain> old_grounds_;  // of the scene before
  SitesOnGround made_;
};

}  // namespace

SitesOnGround sites_on_ground(const Scene& before, const Scene& after, const Registry& registry) {
  if (registry.typification("terrain") == nullptr || registry.typification("boundary") == nullptr) return {};
  return Standing(before, after, registry).run();
}

}  // namespace bl::making
