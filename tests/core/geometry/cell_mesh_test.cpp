// The coarse mesh of a cell: what make_mesh divides and wraps, told apart so that others can do it.
#include <gtest/gtest.h>

#include "core/geometry/power_cells.h"
#include "core/geometry/site_domain.h"

namespace bl::geometry {
namespace {

CellOptions with_both_meshes() {
  CellOptions options;
  options.with_coarse_mesh = true;
  options.tessellation_depth = 0;
  return options;
}

// The wrap by its words, on the corners of triangle t.
Point3 wrapped(const Mesh& coarse, const MeshWrap::Part& part, std::uint32_t vertex) {
  const MeshWrap& wrap = *coarse.wrap;
  const Point3& at = coarse.vertices[vertex];
  if (distance(at, wrap.ball_centre) <= wrap.radius) return at;
  Point3 centre = part.centre;
  for (std::size_t s = part.seams.size(); s-- > 0;)
    if ((wrap.seams[vertex] >> s & 1u) != 0) centre = part.seams[s];
  // By halving: another way than the closed form that is tested.
  double in = 0, out = 1;
  for (int k = 0; k < 80; ++k) {
    const double middle = 0.5 * (in + out);
    (distance(centre + middle * (at - centre), wrap.ball_centre) <= wrap.radius ? in : out) = middle;
  }
  return centre + in * (at - centre);
}

void expect_same_surface(const CellMeasure& cell) {
  const Mesh &coarse = *cell.mesh->coarse, &mesh = *cell.mesh;
  ASSERT_EQ(coarse.triangles.size(), mesh.triangles.size());
  std::size_t t = 0;
  for (const MeshWrap::Part& part : coarse.wrap->parts)
    for (std::uint32_t k = 0; k < part.triangles; ++k, ++t)
      for (std::size_t i = 0; i < 3; ++i)
        EXPECT_LT(distance(wrapped(coarse, part, coarse.triangles[t][i]), mesh.vertices[mesh.triangles[t][i]]), 1e-9);
  EXPECT_EQ(t, mesh.triangles.size());
}

TEST(CellMesh, CoarseMeshWrapsToTheFineOne) {
  const auto angle = site_domain({{{0, 0, 0}, {60, 0, 0}, {60, 25, 0}, {25, 25, 0}, {25, 60, 0}, {0, 60, 0}}, {}, 0, 20, {}, {}});
  ASSERT_TRUE(angle.ok());
  const std::vector<PowerSite> sites = {{{24, 24, 8}, 300}, {{10, 45, 10}, 160}, {{45, 12, 9}, 200}, {{27, 20, 4}, 60}};
  const auto cells = power_cells(*angle, sites, with_both_meshes());
  ASSERT_TRUE(cells.ok());
  std::size_t compared = 0;
  for (const CellMeasure& cell : *cells) {
    if (!cell.mesh) continue;
    expect_same_surface(cell);
    ++compared;
  }
  EXPECT_GE(compared, 3u);
}

TEST(CellMesh, IsThereOnlyWhereItIsAskedForAndThereIsAShape) {
  const auto box = site_domain({{{0, 0, 0}, {10, 0, 0}, {10, 10, 0}, {0, 10, 0}}, {}, 0, 10, {}, {}});
  ASSERT_TRUE(box.ok());
  const std::vector<PowerSite> sites = {{{2, 5, 5}, 9}, {{8, 5, 5}, 0}};
  const auto with = power_cells(*box, sites, with_both_meshes());
  CellOptions plain;
  plain.tessellation_depth = 0;
  const auto without = power_cells(*box, sites, plain);
  ASSERT_TRUE(with.ok() && without.ok());
  ASSERT_NE((*with)[0].mesh, nullptr);
  EXPECT_NE((*with)[0].mesh->coarse, nullptr);
  EXPECT_EQ((*with)[1].mesh, nullptr) << "no ball, no shape";
  ASSERT_NE((*without)[0].mesh, nullptr);
  EXPECT_EQ((*without)[0].mesh->coarse, nullptr);
}

}  // namespace
}  // namespace bl::geometry
