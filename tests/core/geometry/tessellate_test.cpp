// Meshes of cells: closed, outward, and closing in on the closed form as the depth grows.
#include "core/geometry/tessellate.h"

#include <cmath>

#include "tests/core/geometry/geometry_support.h"

namespace bl::test {
namespace {

TEST(Tessellate, VolumesApproachTheClosedForm) {
  const auto sites = random_sites(40, 61, 0.005, 0.15);
  const geometry::ConvexDomain domain = unit_cube();
  double last_error = 1e9;
  for (int depth = 0; depth <= 4; ++depth) {
    const auto cells = cells_of(domain, sites, depth);
    double error = 0;
    for (const geometry::CellMeasure& cell : cells) {
      if (!cell.mesh) continue;
      EXPECT_TRUE(is_closed(*cell.mesh));
      const double volume = enclosed_volume(*cell.mesh);
      EXPECT_GT(volume, 0);
      EXPECT_LE(volume, cell.volume * (1 + 1e-9));  // every vertex lies in the convex shape
      error += cell.volume - volume;
    }
    error /= totals_of(cells).volume;
    if (depth > 0) { EXPECT_LT(error, 0.4 * last_error) << depth; }
    last_error = error;
  }
  EXPECT_LT(last_error, 2e-3);
}

TEST(Tessellate, SitesOutsideTheirOwnCellsAreWrappedWithoutFolds) {
  // Heavy neighbours push the light sites' cells away from them.
  const std::vector<geometry::PowerSite> sites{
      {{2, 5, 5}, 9}, {{3, 5, 5}, 7}, {{-0.5, 2, 2}, 4}, {{8, 8, 8}, 4}, {{8.8, 8.8, 8.8}, 1.7}};
  const auto cells = cells_of(box({0, 0, 0}, {10, 10, 10}), sites, 4);
  for (std::size_t i = 0; i < sites.size(); ++i) {
    ASSERT_NE(cells[i].mesh, nullptr) << i << " " << cells[i].reason;
    EXPECT_TRUE(is_closed(*cells[i].mesh));
    EXPECT_NEAR(enclosed_volume(*cells[i].mesh), cells[i].volume, 0.03 * cells[i].volume) << i;
    for (const Point3& v : cells[i].mesh->vertices) EXPECT_LE(power(sites[i], v), 1e-9 * sites[i].weight);
  }
}

TEST(Tessellate, CellsInsideTheirBallKeepFlatFacets) {
  const auto cells = cells_of(box({0, 0, 0}, {2, 3, 4}), std::vector<geometry::PowerSite>{{{1, 1, 1}, 1000}}, 2);
  EXPECT_NEAR(enclosed_volume(*cells[0].mesh), 24, 1e-12);
  // Six faces of four fan triangles, each in 16; Euler: V = 2 + E - F = 2 + F / 2.
  EXPECT_EQ(cells[0].mesh->triangles.size(), 6u * 4 * 16);
  EXPECT_EQ(cells[0].mesh->vertices.size(), 2u + 6 * 4 * 16 / 2);
}

}  // namespace
}  // namespace bl::test
