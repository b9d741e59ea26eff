// Reads the grids of terrains from a scene, and looks up heights in them.
#include "core/making/scene_ground.h"

#include "core/define/codec.h"
#include "core/geometry/plan_ring.h"
#include "core/making/site.h"

namespace bl::making {

namespace {

std::optional<SceneTerrain> terrain_of(const Scene& scene, const TypificationDefinition& type, const std::string& id,
                                       const NodeRecord& node) {
  const auto* rows = std::get_if<Shared<Table>>(&set_value(scene, node, type, *type.find_port("rows")));
  if (rows == nullptr) return std::nullopt;
  const auto number = [&](const char* port) { return as_number(set_value(scene, node, type, *type.find_port(port))); };
  SceneTerrain terrain{id, {number("west"), number("north"), number("cell"), number("lowest"), number("step"), {}}};
  const std::size_t column = (*rows)->column("heights");
  for (const TableRow& row : (*rows)->rows)
    if (const auto* text = column < row.size() ? std::get_if<std::string>(&row[column]) : nullptr)
      terrain.grid.rows.push_back(*text);
  return terrain.grid.columns() > 0 && terrain.grid.cell > 0 ? std::optional(std::move(terrain)) : std::nullopt;
}

}  // namespace

std::vector<SceneTerrain> terrains_of(const Scene& scene, const Registry& registry) {
  std::vector<SceneTerrain> terrains;
  const TypificationDefinition* type = registry.typification("terrain");
  for (const auto& [id, node] : scene.nodes)
    if (type != nullptr && node.types.contains("terrain"))
      if (auto terrain = terrain_of(scene, *type, id, node)) terrains.push_back(std::move(*terrain));
  return terrains;
}

std::optional<double> lowest_along(std::span<const SceneTerrain> terrains, std::span<const Point3> outline) {
  for (const SceneTerrain& terrain : terrains)
    if (const auto lowest = terrain.grid.lowest_along(outline)) return lowest;
  return std::nullopt;
}

double ground_at(const Scene& scene, const Registry& registry, const Point3& place) {
  for (const SceneTerrain& terrain : terrains_of(scene, registry))
    if (const auto height = terrain.grid.sample(place.x, place.y)) return *height;
  for (const Site& site : sites_of(scene, registry))
    if (is_on(site, place)) return site.bottom;
  return 0;
}

}  // namespace bl::making
