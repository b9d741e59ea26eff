// The coarse mesh of a cell: what make_mesh divides and wraps, told apart so that others can do it.
#include "core/geometry/cell_mesh.h"

#include <optional>

#include <gtest/gtest.h>

#include "core/base/random.h"
#include "core/geometry/inside/cell_trim.h"
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

// The meshes as they come about when everything is at hand: what is measured of the outlines, and nothing that was kept.
struct MadeAtOnce {
  Mesh fine, coarse;
  std::optional<Mesh> whole;

  MadeAtOnce(const CellMeasure& cell, const PowerSite& site, int depth) {
    const std::vector<Polyhedron>& parts = *cell.outlines;
    std::vector<ShapeMeasure> shapes(parts.size());
    double volume = 0;
    Vector3 moment;
    for (std::size_t k = 0; k < parts.size(); ++k) {
      measure_shape(parts[k], site.weight, measure_whole(parts[k]), true, shapes[k]);
      if (shapes[k].is_empty || !(shapes[k].volume > 0)) continue;
      if (!holds(parts[k], site.weight, shapes[k].centroid, 0)) shapes[k].centroid = shapes[k].point_inside;
      volume += shapes[k].volume;
      moment += shapes[k].volume * shapes[k].centroid;
    }
    const Point3 centroid = parts.size() == 1 ? shapes[0].centroid : moment / volume;
    const auto trimmed = trimmed_parts(parts, shapes, site, centroid);
    const auto open = [&](const std::vector<Polyhedron>& of) {
      return of.size() > 1 ? open_parts(of, shapes, site.weight) : std::vector<OpenPart>{};
    };
    const std::vector<Polyhedron>& near = trimmed ? *trimmed : parts;
    fine = make_mesh(near, shapes, open(near), site, depth, centroid);
    coarse = make_coarse_mesh(near, shapes, open(near), site, centroid);
    if (trimmed) whole = make_coarse_mesh(parts, shapes, open(parts), site, centroid);
  }
};

bool is_same(const Mesh& a, const Mesh& b) {
  return a.vertices == b.vertices && a.triangles == b.triangles && (a.wrap == nullptr) == (b.wrap == nullptr) &&
         (a.wrap == nullptr || *a.wrap == *b.wrap);
}

TEST(CellMesh, IsTheSameWhetherItIsMadeAtOnceOrWhenTheDiagramHasLongGone) {
  const auto angle = site_domain({{{0, 0, 0}, {60, 0, 0}, {60, 25, 0}, {25, 25, 0}, {25, 60, 0}, {0, 60, 0}}, {}, 0, 20, {}, {}});
  ASSERT_TRUE(angle.ok());
  Random random(4);
  std::size_t in_parts = 0, whole = 0, one = 0;
  for (int round = 0; round < 40; ++round) {
    CellOptions options = with_both_meshes();
    options.with_outlines = true;
    options.tessellation_depth = round % 4;
    std::vector<PowerSite> sites;
    for (int k = 0; k < 12; ++k)
      sites.push_back({{random.uniform(0, 60), random.uniform(0, 60), random.uniform(0, 20)}, random.uniform(0, 150)});
    std::vector<CellMeasure> cells;
    {
      PowerDiagram diagram;
      ASSERT_TRUE(diagram.set_domain(*angle).ok());
      ASSERT_TRUE(diagram.update(sites, options).ok());
      cells.assign(diagram.cells().begin(), diagram.cells().end());
      std::vector<PowerSite> others = sites;
      for (PowerSite& site : others) site.weight += 1;
      ASSERT_TRUE(diagram.update(others, options).ok());
    }
    for (std::size_t k = 0; k < cells.size(); ++k) {
      if (!cells[k].mesh) continue;
      const MadeAtOnce expected(cells[k], sites[k], options.tessellation_depth);
      // In both orders: the coarse one alone first, or all at once.
      if (round % 2 == 0) { ASSERT_TRUE(is_same(*cells[k].mesh.coarse(), expected.coarse)); }
      EXPECT_TRUE(is_same(*cells[k].mesh, expected.fine));
      EXPECT_TRUE(is_same(*cells[k].mesh->coarse, expected.coarse));
      EXPECT_TRUE(cells[k].mesh.has_depth(options.tessellation_depth));
      EXPECT_EQ(expected.fine.triangles.size(), expected.coarse.triangles.size() << (2 * options.tessellation_depth));
      ASSERT_EQ(cells[k].mesh->coarse->whole != nullptr, expected.whole.has_value());
      if (expected.whole) { EXPECT_TRUE(is_same(*cells[k].mesh->coarse->whole, *expected.whole)); }
      in_parts += cells[k].outlines->size() > 1 ? 1 : 0;
      whole += expected.whole ? 1 : 0;
      ++one;
    }
  }
  EXPECT_GT(in_parts, 20u);
  EXPECT_GT(whole, 20u);
  EXPECT_GT(one, 200u);
}

TEST(CellMesh, OfAnotherDepthLeavesTheDisplayedOneUnmade) {
  const auto box = site_domain({{{0, 0, 0}, {10, 0, 0}, {10, 10, 0}, {0, 10, 0}}, {}, 0, 10, {}, {}});
  ASSERT_TRUE(box.ok());
  CellOptions options = with_both_meshes();
  options.tessellation_depth = 2;
  const auto cells = power_cells(*box, std::vector<PowerSite>{{{2, 5, 5}, 9}}, options);
  ASSERT_TRUE(cells.ok());
  const MeshPointer& mesh = (*cells)[0].mesh;
  EXPECT_EQ(mesh_of_depth(mesh, 2), mesh);
  const MeshPointer study = study_mesh(mesh);
  EXPECT_FALSE(mesh.is_made());
  EXPECT_EQ(study->triangles.size(), mesh->triangles.size() / 4);
  EXPECT_EQ(mesh_of_depth(nullptr, 1), nullptr);
}

}  // namespace
}  // namespace bl::geometry
