// The ground below a site is measured at the cells of the terrain inside it and along its border.
#include "core/making/site_on_ground.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>

#include <nlohmann/json.hpp>

#include "core/base/plural.h"
#include "core/base/text.h"
#include "core/define/codec.h"
#include "core/geometry/domain_table.h"
#include "core/geometry/height_grid.h"
#include "core/making/named_list.h"
#include "core/making/site.h"
#include "core/making/tidy_length.h"
#include "core/session/commands.h"

namespace bl::making {

namespace {

constexpr double kSameHeight = 0.01;   // [m]
constexpr double kLeastCovered = 0.5;  // [ratio] of a site; with less the terrain does not say how the site lies
constexpr double kOneStorey = 3;       // [m]

// A terrain of the scene; the rows of its grid stay in the scene.
struct Ground {
  std::string id;
  geometry::HeightGrid grid;
};

std::optional<Ground> ground_of(const Scene& scene, const Registry& registry, const std::string& id) {
  const TypificationDefinition* type = registry.typification("terrain");
  const NodeRecord& node = scene.nodes.find(id)->second;
  const auto* rows = std::get_if<Shared<Table>>(&set_value(scene, node, *type, *type->find_port("rows")));
  if (rows == nullptr) return std::nullopt;
  const auto number = [&](const char* port) { return as_number(set_value(scene, node, *type, *type->find_port(port))); };
  Ground ground{id, {number("west"), number("north"), number("cell"), number("lowest"), number("step"), {}}};
  const std::size_t column = (*rows)->column("heights");
  for (const TableRow& row : (*rows)->rows)
    if (const auto* text = column < row.size() ? std::get_if<std::string>(&row[column]) : nullptr)
      ground.grid.rows.push_back(*text);
  return ground.grid.columns() > 0 && ground.grid.cell > 0 ? std::optional(std::move(ground)) : std::nullopt;
}

bool is_inside(const Site& site, const Point3& place) {
  return std::any_of(site.grounds.begin(), site.grounds.end(), [&](const std::vector<geometry::Ring>& rings) {
    std::size_t around = 0;
    for (const geometry::Ring& ring : rings) around += geometry::ring_contains(ring, place) ? 1 : 0;
    return around % 2 == 1;
  });
}

// The heights of the ground below a site [m], and for how much of it the terrain has some.
struct Below {
  double lowest = std::numeric_limits<double>::infinity(), highest = -std::numeric_limits<double>::infinity();
  std::size_t places = 0, known = 0;

  void add(const std::optional<double>& height) {
    ++places;
    if (!height) return;
    ++known;
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
    for (const geometry::Ring& ring : rings)
      for (std::size_t i = 0; i < ring.size(); ++i) {
        const Point3 &a = ring[i], &b = ring[(i + 1) % ring.size()];
        west = std::min(west, a.x), east = std::max(east, a.x), south = std::min(south, a.y), north = std::max(north, a.y);
        const int steps = static_cast<int>(std::clamp(std::ceil(4 * distance(a, b) / grid.cell), 1.0, 1e4));
        for (int k = 0; k < steps; ++k) {
          const Point3 place = a + (b - a) * (static_cast<double>(k) / steps);
          found.add(grid.sample(place.x, place.y));
        }
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
      if (is_inside(site, {x, y, 0})) found.add(grid.at(row, column));
    }
  }
  return found;
}

class Standing {
 public:
  Standing(const Scene& before, const Scene& after, const Registry& registry)
      : before_(before), scene_(after), registry_(registry) {}

  SitesOnGround run() {
    std::vector<Ground> grounds;
    for (const auto& [id, node] : scene_.nodes)
      if (node.types.contains("terrain"))
        if (auto ground = ground_of(scene_, registry_, id)) grounds.push_back(std::move(*ground));
    const std::vector<Site> sites = sites_of(scene_, registry_);
    is_alone_ = sites.size() == 1;
    for (const Site& site : sites) {
      const Ground* best = nullptr;
      Below most;
      for (const Ground& ground : grounds)
        if (const Below found = below(site, ground.grid); found.covered() > most.covered()) best = &ground, most = found;
      if (best != nullptr) stand(site, *best, most);
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

  void stand(const Site& site, const Ground& ground, const Below& found) {
    const NodeRecord& node = scene_.nodes.find(site.id)->second;
    // Down to a centimetre; whole ones stay, whatever the last bits of the grid are.
    const double lowest = tidy_length(std::floor(found.lowest * 100 + 1e-3) / 100);
    const bool is_plan = std::get<std::string>(value(node, "boundary", "form")) == "plan";
    const bool is_new = !before_.nodes.contains(ground.id), is_unsaid = !node.types.at("boundary").contains("bottom");
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
    if (is_unsaid && std::abs(lowest - site.bottom) > kSameHeight) sentence = lift(site, node, ground, found, lowest);
    const std::string link = add_link(ground);
    if (!link.empty())
      sentence += (sentence.empty() ? heights + ". The link `" : " The link `") + link + "` sets all volumes that stand on it.";
    if (!sentence.empty()) made_.notes.push_back(sentence);
    if (found.known < found.places && !link.empty())
      made_.warnings.push_back("The terrain has a height for " + percent(found.covered()) + " of the site `" + site.id +
                               "`: a volume beside that is an error, until it is moved or `needs_ground` of the link `" + link +
                               "` is off.");
  }

  static std::string percent(double ratio) { return fixed(std::floor(100 * ratio), 0) + " %"; }
  std::string remedy(const Below& found, bool is_plan, double lowest) const {
    if (found.covered() < kLeastCovered) return "Import a terrain that covers the site, with a larger --radius.";
    const std::string raise = is_plan ? "Set its `bottom` to " + shortest(lowest) + " m" : "Raise its corners";
    return raise + (has_link() ? "." : ", and add a link `terrain_follow` from the terrain to its volumes.");
  }

  // The sentence about it.
  std::string lift(const Site& site, const NodeRecord& node, const Ground& ground, const Below& found, double lowest) {
    const double rise = lowest - site.bottom, height = as_number(value(node, "boundary", "height"));
    set(site.id, "boundary.bottom", lowest);
    lift_exclusions(site, rise, lowest);
    lift_tables(site.id, node, rise);
    lift_nodes(site, ground, rise, lowest);
    if (const double above = lowest + height - found.highest; above < kOneStorey)
      made_.warnings.push_back("The site `" + site.id + "` ends " + fixed(std::abs(above), 1) + " m " +
                               (above < 0 ? "below" : "above") + " its highest ground: raise its `height` of " +
                               shortest(height) + " m, so that volumes fit there.");
    return "The site `" + site.id + "` begins at " + fixed(lowest, 2) + " m now, its lowest ground, instead of " +
           shortest(site.bottom) + " m, and keeps its height of " + shortest(height) + " m; its highest ground lies at " +
           fixed(found.highest, 2) + " m.";
  }

  // What reaches over the whole height of the site still does; what ends below the ground counted from it, all else from the sea.
  void lift_exclusions(const Site& site, double rise, double lowest) {
    Table rows = site.rows;
    const std::size_t name = rows.column("name"), bottom = rows.column("bottom"), top = rows.column("top");
    for (const geometry::NamedRing& ring : geometry::read_rings(site.rows)) {
      const bool is_whole = ring.bottom <= site.bottom && std::abs(ring.top - site.top) < kSameHeight;
      if (!is_whole && ring.top > lowest) continue;
      for (TableRow& row : rows.rows)
        if (std::get<std::string>(row[name]) == ring.name) {
          row[bottom] = tidy_length(ring.bottom + rise);
          row[top] = tidy_length(ring.top + rise);
        }
    }
    if (rows != site.rows) set_table(site.id, "exclusions", std::move(rows));
  }

  void lift_tables(const std::string& id, const NodeRecord& node, double rise) {
    const auto rows_of = [&](const char* port) { return *std::get<Shared<Table>>(value(node, "boundary", port)); };
    if (Table steps = rows_of("steps"); !steps.rows.empty()) {
      const std::size_t top = steps.column("top");
      for (const geometry::NamedRing& ring : geometry::read_rings(steps))
        steps.rows[ring.first_row][top] = tidy_length(ring.top + rise);
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
  void lift_nodes(const Site& site, const Ground& ground, double rise, double lowest) {
    std::size_t sunk = 0;
    for (const auto& [id, node] : scene_.nodes) {
      const Point3 place = std::get<Vector3>(value(node, "node", "position"));
      const bool is_rounded = node.types.contains("smart_volume") && !node.types.contains("footprint");
      const bool is_imported = node.types.contains("imported");
      if (node.types.contains("existing_building"))
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
      if (!is_inside(site, place) && !(is_rounded && is_alone_)) continue;
      const double up = is_rounded ? rise : ground.grid.sample(place.x, place.y).value_or(lowest) - site.bottom;
      set(id, "node.position", {tidy_length(place.x), tidy_length(place.y), tidy_length(place.z + up)});
    }
    if (sunk > 0)
      made_.warnings.push_back(
          how_many(sunk, "building") + by_number(sunk, " of the surroundings ends", " of the surroundings end") +
          " below the ground of the site, because " + by_number(sunk, "its heights count", "their heights count") +
          " from the ground: their shadows do not reach the site until `base` is the height of their ground.");
  }

  bool has_link() const {
    return std::any_of(scene_.links.begin(), scene_.links.end(),
                       [](const auto& entry) { return entry.second.kind == "terrain_follow"; });
  }

  // One for all volumes of the scene; its id; empty where there is one already, or no volume stands.
  std::string add_link(const Ground& ground) {
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
  SitesOnGround made_;
};

}  // namespace

SitesOnGround sites_on_ground(const Scene& before, const Scene& after, const Registry& registry) {
  if (registry.typification("terrain") == nullptr || registry.typification("boundary") == nullptr) return {};
  return Standing(before, after, registry).run();
}

}  // namespace bl::making
