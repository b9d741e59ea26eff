// Areas of sites in plan, without the ground that they leave out.
#include "core/making/room_left.h"

#include <algorithm>
#include <set>
#include <vector>

#include "core/base/text.h"
#include "core/geometry/domain_table.h"
#include "core/geometry/site_domain.h"

namespace bl::making {

namespace {

// The floor area that the rows of all programmes ask for, without open space [m²].
double asked_floor(const Scene& scene, const Registry& registry) {
  const TypificationDefinition *programme = registry.typification("programme"), *use = registry.typification("use");
  std::set<std::string> open;
  double area = 0;
  if (programme == nullptr || use == nullptr) return area;
  for (const auto& [id, node] : scene.nodes) {
    if (!node.types.contains("use")) continue;
    const std::string& name = std::get<std::string>(set_value(scene, node, *use, *use->find_port("use")));
    if (std::get<bool>(set_value(scene, node, *use, *use->find_port("is_open")))) open.insert(lower_case(name));
  }
  for (const auto& [id, node] : scene.nodes) {
    if (!node.types.contains("programme")) continue;
    const auto rows = std::get<Shared<Table>>(set_value(scene, node, *programme, *programme->find_port("rows")));
    for (std::size_t row = 0; row < rows->rows.size(); ++row) {
      const std::string& name = rows->text(row, "use");
      if (!open.contains(lower_case(name))) area += rows->number(row, "floor_area") * std::max(1.0, rows->number(row, "count"));
    }
  }
  return area;
}

}  // namespace

double ground_of(const Site& site, bool is_whole) {
  if (site.grounds.empty()) return 0;
  const std::vector<geometry::Ring>& rings = site.grounds.front();
  geometry::SitePlan plan{rings.front(), {rings.begin() + 1, rings.end()}, site.bottom, site.top, {}, {}};
  for (std::size_t step = 1; step < site.grounds.size(); ++step)
    plan.steps.push_back({site.grounds[step].front(), site.bottom, site.top});
  // What begins at the underside takes the ground, however low its roof is.
  if (!is_whole)
    for (geometry::NamedRing& ring : geometry::read_rings(site.rows))
      if (ring.bottom <= site.bottom) plan.exclusions.push_back({std::move(ring.corners), ring.bottom, site.top});
  const auto domain = geometry::site_domain(plan);
  return domain ? area_in_plan(*domain) : 0;
}

std::string room_left_text(const Scene& scene, const Registry& registry) {
  double whole = 0, left = 0;
  const std::vector<Site> sites = sites_of(scene, registry);
  for (const Site& site : sites) whole += ground_of(site, true), left += ground_of(site, false);
  if (!(whole > 0)) return "";
  const double asked = asked_floor(scene, registry);
  return "Of " + fixed(whole, 0) + " m² of the site" + (sites.size() == 1 ? " `" + sites.front().id + "`" : "s") + ", " +
         fixed(left, 0) + " m² remain to build on" +
         (asked > 0 ? "; the brief asks for " + fixed(asked, 0) + " m² of floor area." : ".");
}

}  // namespace bl::making
