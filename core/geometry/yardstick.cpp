// One range insertion into CGAL's Regular_triangulation_3, and nothing else.
#include "core/geometry/yardstick.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Regular_triangulation_3.h>

#include <vector>

namespace bl::geometry {

std::size_t plain_triangulation(std::span<const PowerSite> sites) {
  using Predicates = CGAL::Exact_predicates_inexact_constructions_kernel;
  using Triangulation = CGAL::Regular_triangulation_3<Predicates>;
  std::vector<Triangulation::Weighted_point> points;
  points.reserve(sites.size());
  for (const PowerSite& site : sites)
    points.emplace_back(Triangulation::Bare_point(site.position.x, site.position.y, site.position.z), site.weight);
  const Triangulation triangulation(points.begin(), points.end());
  return triangulation.number_of_vertices();
}

}  // namespace bl::geometry
