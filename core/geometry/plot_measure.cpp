// What plots count of the volumes on them.
#include "core/geometry/plot_measure.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "core/geometry/plan_ring.h"

namespace bl::geometry {

double built_share(bool has_plates, std::string_view stands_on, double bottom, double storey_height, double ground) {
  if (has_plates) return stands_on == kTheGround ? 1 : 0;
  return std::clamp(2 * (ground + storey_height - bottom) / storey_height, 0.0, 1.0);
}

double clearance_of_disc(std::span<const Point3> polygon, const Point3& centroid, double footprint) {
  const Point3 flat{centroid.x, centroid.y, 0};
  const Point3 side = nearest_on_ring(polygon, flat);
  return distance({side.x, side.y, 0}, flat) - std::sqrt(footprint / std::numbers::pi);
}

std::vector<double> height_bases(std::span<const HeightBase> volumes, double plot_ground) {
  std::map<std::string_view, std::size_t> index;
  for (std::size_t i = 0; i < volumes.size(); ++i) index.emplace(volumes[i].id, i);
  std::vector<double> bases;
  for (std::size_t i = 0; i < volumes.size(); ++i) {
    std::size_t root = i;
    for (std::size_t step = 0; step < volumes.size(); ++step) {
      const auto below = index.find(volumes[root].stands_on);
      if (below == index.end()) break;
      root = below->second;
    }
    bases.push_back(std::max(plot_ground, volumes[root].ground.value_or(plot_ground)));
  }
  return bases;
}

}  // namespace bl::geometry
