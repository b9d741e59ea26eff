// Compares rules with the lowest buildings and the ground of a plot, and gardens with the boundaries of a scene.
#include "core/making/addition_checks.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/base/plural.h"
#include "core/base/text.h"
#include "core/geometry/domain_makers.h"
#include "core/geometry/footprint.h"
#include "core/making/named_list.h"
#include "core/making/site.h"

namespace bl::making {

namespace {

// A sun that is 6 degrees high casts shadows of so many heights; a lower one counts in no standard for sun in gardens.
constexpr double kLongestShadow = 9.5;
// Gardens of which less lies in a boundary touch it only.
constexpr double kTouches = 1e-6;  // [ratio]

double number_at(const Scene& scene, const NodeRecord& node, const TypificationDefinition& type, const char* port) {
  return as_number(set_value(scene, node, type, *type.find_port(port)));
}

// What is left of the plot within a set-back [m²]; nothing where the plot is no sound polygon, which others tell.
double left_within(const std::vector<Point3>& polygon, double setback, double otherwise) {
  const auto plot = geometry::extrude_plan(polygon, {}, 0, 10);
  geometry::FootprintDiagram diagram;
  if (!plot || !diagram.set_domain(*plot)) return otherwise;
  geometry::StandingSite whole;
  whole.site.position = {plot->centroid.x, plot->centroid.y, 0};
  whole.form = geometry::FootprintForm::cell;
  whole.runs = {{1, 0}};
  whole.border_distance = whole.street_distance = setback;
  const auto measured = diagram.update(std::vector<geometry::StandingSite>{whole});
  return measured ? measured->front().floor_area : otherwise;
}

// The ids of volumes that stand and are higher than the rule with their least storeys, and the height of the lowest volume [m].
struct TooHigh {
  std::vector<std::string> ids;
  std::size_t of = 0;
  double lowest = std::numeric_limits<double>::infinity();
};
TooHigh too_high(const Scene& scene, const Registry& registry, double height) {
  TooHigh found;
  const TypificationDefinition *volume = registry.typification("smart_volume"), *footprint = registry.typification("footprint");
  if (volume == nullptr || footprint == nullptr) return found;
  for (const auto& [id, node] : scene.nodes) {
    if (!node.types.contains("smart_volume") || !node.types.contains("footprint")) continue;
    const double least =
        std::max(1.0, number_at(scene, node, *footprint, "storeys_min")) * number_at(scene, node, *volume, "storey_height");
    ++found.of;
    found.lowest = std::min(found.lowest, least);
    if (least > height) found.ids.push_back(id);
  }
  return found;
}

// Between two polygons that do not meet [m].
double way_between(const std::vector<Point3>& a, const std::vector<Point3>& b) {
  double least = std::numeric_limits<double>::infinity();
  for (const auto& [points, ring] : {std::pair(&a, &b), {&b, &a}})
    for (const Point3& p : *points) {
      const Point3 at{p.x, p.y, 0}, near = geometry::nearest_on_ring(*ring, at);
      least = std::min(least, distance(at, {near.x, near.y, 0}));
    }
  return least;
}

}  // namespace

std::vector<std::string> rule_warnings(const Scene& scene, const Registry& registry, const RuleAddition& rules,
                                       const std::string& plot, const std::vector<Point3>& polygon) {
  std::vector<std::string> warnings;
  const TooHigh found = rules.height ? too_high(scene, registry, *rules.height) : TooHigh();
  const std::string as_low = " as low as " + shortest(rules.height.value_or(0)) + " m: ";
  if (!found.ids.empty() && found.ids.size() == found.of)
    warnings.push_back("Warning: no volume can be" + as_low + "the lowest has " + fixed(found.lowest, 2) +
                       " m with its least number of storeys.");
  else if (!found.ids.empty())
    warnings.push_back("Warning: " + std::to_string(found.ids.size()) + " of " + std::to_string(found.of) + " volumes cannot be" +
                       as_low + named_list(found.ids) + by_number(found.ids.size(), " is", " are") +
                       " higher with the least number of storeys.");
  if (rules.fsi && *rules.fsi == 0)
    warnings.push_back("Warning: an FSI of 0 allows no floor area on `" + plot + "`: each volume breaks the rule.");
  if (rules.gsi && *rules.gsi == 0)
    warnings.push_back("Warning: a GSI of 0 leaves no ground of `" + plot + "` to build on: each volume on it breaks the rule.");
  if (rules.setback && *rules.setback > 0 && polygon.size() >= 3)
    if (!(left_within(polygon, *rules.setback, 1) > 0))
      warnings.push_back("Warning: a setback of " + shortest(*rules.setback) + " m leaves nothing of `" + plot +
                         "` to build on: no place in it is so far from its border.");
  return warnings;
}

std::vector<std::string> garden_warnings(const Scene& scene, const Registry& registry, const std::vector<Point3>& corners) {
  double nearest = std::numeric_limits<double>::infinity(), height = 0;
  std::string where;
  for (const Site& site : sites_of(scene, registry))
    for (const std::vector<geometry::Ring>& ground : site.grounds) {
      if (ground.empty() || ground.front().size() < 3) continue;
      if (area_on({ground.front()}, {&corners}) > kTouches * std::abs(geometry::signed_area(corners))) return {};
      const double away = way_between(corners, ground.front());
      if (!(away < nearest)) continue;
      nearest = away;
      where = site.id;
      height = site.top - site.bottom;
    }
  if (where.empty()) return {};
  if (nearest <= kLongestShadow * height)
    return {"The garden lies outside of the site, " + fixed(nearest, 1) + " m from the boundary `" + where +
            "`: its sun is protected, and nothing keeps its ground free."};
  return {
      "Warning: the garden lies " + fixed(nearest, 0) + " m from the boundary `" + where + "`, which is " + fixed(height, 0) +
      " m high: no shadow of its volumes reaches so far while the sun stands higher than 6 degrees. Are the corners in metres "
      "of the scene?"};
}

}  // namespace bl::making
