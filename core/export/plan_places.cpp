// Extents and centroids in plan.
#include "core/export/plan_places.h"

#include <algorithm>
#include <cmath>

#include "core/geometry/plan_ring.h"

namespace bl::exporting {

PlanExtent plan_extent(const Proposal& proposal) {
  PlanExtent extent{{1e20, 1e20, 0}, {-1e20, -1e20, 0}};
  const auto take = [&](const std::vector<geometry::PlateFace>& faces) {
    for (const geometry::PlateFace& face : faces)
      for (const Point3& p : face.outer) {
        extent.low = {std::min(extent.low.x, p.x), std::min(extent.low.y, p.y), 0};
        extent.high = {std::max(extent.high.x, p.x), std::max(extent.high.y, p.y), 0};
      }
  };
  for (const Land& land : proposal.lands) take(land.faces);
  for (const Building& building : proposal.buildings)
    for (const Storey& storey : building.storeys) take(storey.faces);
  return extent;
}

Point3 middle_of(const std::vector<geometry::PlateFace>& faces) {
  const auto largest = std::max_element(faces.begin(), faces.end(), [](const auto& a, const auto& b) {
    return std::abs(geometry::signed_area(a.outer)) < std::abs(geometry::signed_area(b.outer));
  });
  if (largest == faces.end() || largest->outer.empty()) return {};
  const geometry::Ring& ring = largest->outer;
  const Point3 first = ring.front();
  Vector3 sum;
  double twice = 0;
  for (std::size_t k = 1; k + 1 < ring.size(); ++k) {
    const double part = geometry::turn(first, ring[k], ring[k + 1]);
    sum = sum + part * ((ring[k] - first) + (ring[k + 1] - first));
    twice += part;
  }
  return twice == 0 ? first : first + sum / (3 * twice);
}

}  // namespace bl::exporting
