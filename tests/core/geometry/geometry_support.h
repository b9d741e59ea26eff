// What the geometry tests share: domains, site sets and checks of meshes.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include "core/base/random.h"
#include "core/geometry/power_cells.h"
#include "tests/support/reference_files.h"

namespace bl::test {

inline geometry::ConvexDomain box(const Vector3& low, const Vector3& high) {
  const std::vector<Point3> plan{{low.x, low.y, 0}, {high.x, low.y, 0}, {high.x, high.y, 0}, {low.x, high.y, 0}};
  return geometry::extrude(plan, low.z, high.z).value();
}
inline geometry::ConvexDomain unit_cube() { return box({0, 0, 0}, {1, 1, 1}); }

inline Point3 random_point(Random& random, const Vector3& low, const Vector3& high) {
  const double x = random.uniform(low.x, high.x), y = random.uniform(low.y, high.y);
  return {x, y, random.uniform(low.z, high.z)};
}

inline std::vector<geometry::PowerSite> random_sites(std::size_t count, std::uint64_t seed, double weight_low,
                                                     double weight_high) {
  Random random(seed);
  std::vector<geometry::PowerSite> sites;
  for (std::size_t i = 0; i < count; ++i) {
    const Point3 p = random_point(random, {0, 0, 0}, {1, 1, 1});
    sites.push_back({p, random.uniform(weight_low, weight_high)});
  }
  return sites;
}

/// Every directed edge has its twin exactly once.
inline bool is_closed(const Mesh& mesh) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> edges, twins;
  for (const auto& t : mesh.triangles) {
    for (unsigned i = 0; i < 3; ++i) {
      edges.emplace_back(t[i], t[(i + 1) % 3]);
      twins.emplace_back(t[(i + 1) % 3], t[i]);
    }
  }
  std::sort(edges.begin(), edges.end());
  std::sort(twins.begin(), twins.end());
  return edges == twins && std::adjacent_find(edges.begin(), edges.end()) == edges.end();
}

/// In a box of ten metres: 0 lives, 1 lies at its place and is lighter, 2 is swallowed by it, 3 lies outside and out of reach,
/// 4 reaches in from outside, 5 has no ball.
inline std::vector<geometry::PowerSite> sites_in_every_state() {
  return {{{5, 5, 5}, 4}, {{5, 5, 5}, 1}, {{5.1, 5, 5}, 0.01}, {{20, 5, 5}, 1}, {{10.5, 9, 9}, 1}, {{1, 1, 1}, 0}};
}

/// Power distance of a point to a site.
inline double power(const geometry::PowerSite& site, const Point3& x) { return squared_norm(x - site.position) - site.weight; }

inline std::vector<geometry::CellMeasure> cells_of(const geometry::ConvexDomain& domain,
                                                   std::span<const geometry::PowerSite> sites, int depth = -1) {
  geometry::CellOptions options;
  options.tessellation_depth = depth;
  auto cells = power_cells(domain, sites, options);
  EXPECT_TRUE(cells.ok()) << (cells.ok() ? "" : cells.error().text());
  return cells.ok() ? *cells : std::vector<geometry::CellMeasure>{};
}

}  // namespace bl::test
