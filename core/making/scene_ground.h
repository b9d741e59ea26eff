// The ground of a scene: the heights of its terrains, and the undersides of its sites where there is none.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/define/registry.h"
#include "core/geometry/height_grid.h"
#include "core/graph/scene.h"

namespace bl::making {

/// A terrain of the scene; the rows of its grid stay in the scene.
struct SceneTerrain {
  std::string id;
  geometry::HeightGrid grid;
};

/// Those that have heights, by id.
std::vector<SceneTerrain> terrains_of(const Scene& scene, const Registry& registry);

/// The lowest ground along an outline [m], by the first terrain that has heights there; nothing beside all of them.
std::optional<double> lowest_along(std::span<const SceneTerrain> terrains, std::span<const Point3> outline);

/// The height of the ground at a place [m]: of the first terrain that has one, else the underside of the site there, else 0.
double ground_at(const Scene& scene, const Registry& registry, const Point3& place);

}  // namespace bl::making
