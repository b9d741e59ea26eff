// Tries a grid of places in the plan of the boundary and takes the freest.
#include "ui/desktop/panels/canvas/placing.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/geometry/plan_ring.h"
#include "core/reading/views/solver.h"
#include "core/reading/views/volume.h"

namespace bl::desktop::canvas {

namespace {

constexpr int kTries = 24;

struct Site {
  std::vector<Point3> plan;  // corners in order; of other forms than a plan, the corners of the box around the points
  double bottom = 0, top = 20;
};

Site box_site(const std::vector<Point3>& points) {
  Site site;
  if (points.empty()) return site;
  Point3 low = points.front(), high = low;
  for (const Point3& p : points) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  site.plan = {{low.x, low.y, 0}, {high.x, low.y, 0}, {high.x, high.y, 0}, {low.x, high.y, 0}};
  site.bottom = low.z;
  site.top = high.z;
  return site;
}

std::optional<Site> site_of(const Registry& registry, const Scene& scene) {
  for (const auto& [id, node] : scene.nodes) {
    const auto boundary = reading::settings_of<reading::BoundarySettings>(scene, registry, node);
    if (!boundary) continue;
    if (boundary->form == "plan") return Site{boundary->plan, boundary->bottom, boundary->bottom + boundary->height};
    return box_site(boundary->form == "mesh" ? boundary->vertices : boundary->points);
  }
  return std::nullopt;
}

// Along the ground [m].
double distance_to_outline(const std::vector<Point3>& plan, const Point3& point) {
  const Point3 nearest = geometry::nearest_on_ring(plan, point);
  return std::hypot(nearest.x - point.x, nearest.y - point.y);
}

}  // namespace

Point3 place_volume(const Registry& registry, const Scene& scene) {
  Point3 place;
  std::vector<Point3> others;
  for (const auto& [id, node] : scene.nodes)
    if (const auto position = reading::setting<&reading::VolumeFigures::position>(scene, registry, node))
      others.push_back(*position);
  const auto site = site_of(registry, scene);
  if (!site || site->plan.size() < 3) {
    // Without a boundary: beside the last one.
    if (!others.empty()) place = {others.back().x + 20, others.back().y, others.back().z};
    return place;
  }
  const Site box = box_site(site->plan);
  const double middle = (site->bottom + site->top) / 2;
  double best = -1;
  for (int i = 0; i < kTries; ++i)
    for (int j = 0; j < kTries; ++j) {
      const double x = box.plan[0].x + (box.plan[2].x - box.plan[0].x) * (i + 0.5) / kTries;
      const double y = box.plan[0].y + (box.plan[2].y - box.plan[0].y) * (j + 0.5) / kTries;
      const Point3 spot{x, y, 0};
      if (!geometry::ring_contains(site->plan, spot)) continue;
      double free = 2 * distance_to_outline(site->plan, spot);
      for (const Point3& other : others) free = std::min(free, std::hypot(x - other.x, y - other.y));
      if (free > best) best = free, place = {std::round(10 * x) / 10, std::round(10 * y) / 10, middle};
    }
  return place;
}

}  // namespace bl::desktop::canvas
