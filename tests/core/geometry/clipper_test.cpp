// The clipper at its limits, against measures that know nothing of it: hundreds of faces, lattices, cuts through corners.
#include <cmath>
#include <numbers>

#include "core/geometry/inside/clipper.h"
#include "core/geometry/inside/site_grid.h"
#include "tests/core/geometry/site_zoo.h"

namespace bl::test {
namespace {

// Directions spread evenly over the sphere.
std::vector<Vector3> directions(std::size_t count) {
  std::vector<Vector3> result;
  for (std::size_t k = 0; k < count; ++k) {
    const double z = 1 - (2 * static_cast<double>(k) + 1) / static_cast<double>(count),
                 turn = 2.399963229728653 * static_cast<double>(k), r = std::sqrt(1 - z * z);
    result.push_back({r * std::cos(turn), r * std::sin(turn), z});
  }
  return result;
}

double volume_of(const geometry::Polyhedron& shape) {
  double six = 0;
  for (const geometry::PolyhedronFace& face : shape.faces) {
    const auto loop = shape.loop(face);
    for (std::size_t i = 2; i < loop.size(); ++i) {
      six += dot(shape.vertices[loop[0]], cross(shape.vertices[loop[i - 1]], shape.vertices[loop[i]]));
    }
  }
  return six / 6;
}

// Every edge of every face is that of one other, the other way round; V - E + F = 2; no vertex beyond any plane.
void expect_body(const geometry::Polyhedron& shape, std::span<const geometry::Plane> planes, double tolerance,
                 const std::string& what) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> edges, twins;
  std::set<std::uint32_t> seen;
  for (const geometry::PolyhedronFace& face : shape.faces) {
    const auto loop = shape.loop(face);
    ASSERT_GE(loop.size(), 3u) << what;
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const std::uint32_t a = loop[i], b = loop[(i + 1) % loop.size()];
      edges.emplace_back(a, b);
      twins.emplace_back(b, a);
      seen.insert(a);
    }
  }
  std::sort(edges.begin(), edges.end());
  std::sort(twins.begin(), twins.end());
  EXPECT_EQ(edges, twins) << what;
  EXPECT_EQ(seen.size() + shape.faces.size(), edges.size() / 2 + 2) << what;
  for (const std::uint32_t v : seen) {
    for (const geometry::Plane& plane : planes) ASSERT_LE(dot(plane.normal, shape.vertices[v]), plane.offset + tolerance) << what;
  }
}

// Far more than 64 vertices, far more than fit into the first room: cuts that take one vertex, and one that takes nearly all.
TEST(Clipper, HundredsOfFacesAndACutThroughAllOfThem) {
  for (const std::size_t count : {60u, 400u, 1500u}) {
    geometry::Clipper clipper;
    clipper.start_box({-2, -2, -2}, {2, 2, 2});
    std::vector<geometry::Plane> planes;
    std::uint32_t index = 0;
    for (const Vector3& n : directions(count)) {
      planes.push_back({n, 1});
      ASSERT_TRUE(clipper.cut(n, 1, geometry::FaceKind::site, index++));
    }
    geometry::Polyhedron shape;
    clipper.finish(shape);
    EXPECT_EQ(shape.faces.size(), count);
    expect_body(shape, planes, 1e-12, std::to_string(count));
    // All faces touch the unit ball: a third of the surface is the volume.
    double surface = 0;
    for (const geometry::PolyhedronFace& face : shape.faces) {
      const auto loop = shape.loop(face);
      Vector3 twice;
      for (std::size_t i = 2; i < loop.size(); ++i) {
        twice += cross(shape.vertices[loop[i - 1]] - shape.vertices[loop[0]], shape.vertices[loop[i]] - shape.vertices[loop[0]]);
      }
      surface += 0.5 * norm(twice);
    }
    EXPECT_NEAR(volume_of(shape), surface / 3, 1e-11);
    EXPECT_GT(volume_of(shape), 4 * std::numbers::pi / 3);
    geometry::Clipper upper, lower;
    upper.copy(clipper);
    lower.copy(clipper);
    const Vector3 n = (1 / std::sqrt(14.0)) * Vector3{1, 2, 3};
    ASSERT_TRUE(upper.cut(-1 * n, -0.31, geometry::FaceKind::site, index));
    ASSERT_TRUE(lower.cut(n, 0.31, geometry::FaceKind::site, index));
    geometry::Polyhedron above, below;
    upper.finish(above);
    lower.finish(below);
    EXPECT_NEAR(volume_of(above) + volume_of(below), volume_of(shape), 1e-11);
    planes.push_back({n, 0.31});
    expect_body(below, planes, 1e-12, "below");
    EXPECT_FALSE(upper.cut(n, 0.2, geometry::FaceKind::site, index + 1));
    EXPECT_TRUE(upper.is_empty());
  }
}

// Cuts through corners, along edges and through faces that are there already, in any order: one body, of the right volume.
TEST(Clipper, PlanesOfALatticeInAnyOrder) {
  Random random(5);
  std::vector<geometry::Plane> planes;
  for (int x = -1; x <= 1; ++x) {
    for (int y = -1; y <= 1; ++y) {
      for (int z = -1; z <= 1; ++z) {
        const int squared = x * x + y * y + z * z;
        const Vector3 n = Vector3{double(x), double(y), double(z)} / std::sqrt(std::max(1.0, double(squared)));
        // Cube, octahedron and rhombic dodecahedron all through the corners of the cube, or through the ends of its axes.
        if (squared == 1) planes.push_back({n, 1});
        if (squared == 2) planes.push_back({n, std::numbers::sqrt2});
        if (squared == 3) planes.push_back({n, std::sqrt(3.0)});
      }
    }
  }
  for (int round = 0; round < 300; ++round) {
    for (std::size_t k = planes.size(); k-- > 1;)
      std::swap(planes[k], planes[static_cast<std::size_t>(random.uniform(0, double(k + 1)))]);
    const bool is_small = round % 2 == 0;
    geometry::Clipper clipper;
    clipper.start_box({-1.5, -1.5, -1.5}, {1.5, 1.5, 1.5});
    for (std::uint32_t k = 0; k < planes.size(); ++k)
      ASSERT_TRUE(clipper.cut(planes[k].normal, planes[k].offset, geometry::FaceKind::site, k));
    if (is_small) {  // the octahedron through the middles of the cube's faces
      for (std::uint32_t k = 0; k < 8; ++k) {
        const Vector3 n = Vector3{(k & 1u) ? 1.0 : -1.0, (k & 2u) ? 1.0 : -1.0, (k & 4u) ? 1.0 : -1.0} / std::sqrt(3.0);
        ASSERT_TRUE(clipper.cut(n, 1 / std::sqrt(3.0), geometry::FaceKind::site, 100 + k));
      }
    }
    geometry::Polyhedron shape;
    clipper.finish_as_cut(shape);
    EXPECT_NEAR(volume_of(shape), is_small ? 4.0 / 3 : 8.0, 1e-11) << round;
  }
}

// A site in the middle of a sphere of others borders all of them: against the volume of the pyramids over its facets, against the
// samples' count in its ball, and the same with any threads.
TEST(Clipper, ASiteInTheMiddleOfASphereOfSites) {
  Random random(6);
  std::vector<geometry::PowerSite> sites{{{0.5, 0.5, 0.5}, 0.04}};
  for (const Vector3& n : directions(400)) sites.push_back({Point3{0.5, 0.5, 0.5} + random.uniform(0.40, 0.401) * n, 0.03});
  geometry::CellOptions options;
  const auto cells = power_cells(unit_cube(), sites, options).value();
  double sum = 0;
  for (const geometry::CellMeasure& cell : cells) sum += cell.cell_volume;
  EXPECT_NEAR(sum, 1, 1e-12);
  // Whole: the ball holds the middle cell when it is heavy enough, and the facets are the bases of pyramids.
  for (geometry::PowerSite& site : sites) site.weight += 4;
  const auto whole = power_cells(unit_cube(), sites, options).value();
  EXPECT_NEAR(whole[0].cell_volume, cells[0].cell_volume, 1e-13);
  EXPECT_NEAR(whole[0].volume, whole[0].cell_volume, 1e-13);
  EXPECT_GT(whole[0].facets.size(), 300u);
  double pyramids = 0;
  for (const geometry::FacetArea& facet : whole[0].facets) {
    const double d = distance(sites[0].position, sites[facet.index].position);
    pyramids += facet.area * (d * d + sites[0].weight - sites[facet.index].weight) / (2 * d) / 3;
  }
  EXPECT_NEAR(pyramids, whole[0].volume, 1e-13);
  ThreadPool pool(3);
  options.pool = &pool;
  const auto again = power_cells(unit_cube(), sites, options).value();
  for (std::size_t i = 0; i < sites.size(); ++i) {
    ASSERT_EQ(again[i].volume, whole[i].volume) << i;
    ASSERT_EQ(again[i].facets, whole[i].facets) << i;
  }
}

// A grid that has seen moves, returns to the old place, insertions and erasures finds what a list finds, at any reach.
TEST(SiteGrid, FindsWhatAListFindsAfterManyChanges) {
  Random random(7);
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  for (int round = 0; round < 40; ++round) {
    std::vector<geometry::PowerSite> sites = random_sites(150, 100 + static_cast<std::uint64_t>(round), -0.01, 0.03);
    std::vector<std::uint32_t> all(sites.size());
    for (std::uint32_t i = 0; i < all.size(); ++i) all[i] = i;
    geometry::SiteGrid grid;
    grid.build(sites, all);
    std::vector<std::uint8_t> is_there(sites.size(), 1);
    for (int k = 0; k < 60; ++k) {
      const auto i = static_cast<std::uint32_t>(random.uniform(0, static_cast<double>(sites.size())));
      const double what = random.uniform();
      if (what < 0.15 && is_there[i]) {
        grid.erase(i);
        is_there[i] = 0;
      } else if (what < 0.3) {
        sites.push_back({random_point(random, {-1, -1, -1}, {2, 2, 2}), random.uniform(0, 0.05)});
        is_there.push_back(1);
        grid.insert(static_cast<std::uint32_t>(sites.size() - 1), sites.back());
      } else if (is_there[i]) {
        const geometry::PowerSite before = sites[i];
        sites[i] = {random_point(random, {-0.5, -0.5, -0.5}, {1.5, 1.5, 1.5}), random.uniform(-0.01, 0.05)};
        grid.change(i, sites[i]);
        if (what < 0.6) grid.change(i, sites[i] = before);
      }
    }
    if (round % 2 == 0) {
      for (geometry::PowerSite& site : sites) site.weight *= 0.5;
      grid.refresh_weights(sites);
    }
    for (std::uint32_t i = 0; i < sites.size(); ++i) {
      if (!is_there[i]) continue;
      EXPECT_EQ(grid.of(i).site, i);
      EXPECT_EQ(grid.of(i).position, sites[i].position);
      EXPECT_EQ(grid.of(i).weight, sites[i].weight);
      for (const double reach : {0.02, 0.2, kInfinity}) {
        std::set<std::uint32_t> found;
        grid.search(
            sites[i].position, sites[i].weight, i, {}, [&] { return reach; },
            [&](const geometry::SiteGrid::Entry& entry) {
              ASSERT_LT(entry.site, sites.size());
              EXPECT_EQ(entry.position, sites[entry.site].position);
              EXPECT_EQ(entry.weight, sites[entry.site].weight);
              EXPECT_TRUE(found.insert(entry.site).second) << "twice";
            });
        for (std::uint32_t j = 0; j < sites.size(); ++j) {
          if (j == i || !is_there[j]) {
            ASSERT_FALSE(found.contains(j)) << round << ": " << j;
            continue;
          }
          const double d = distance(sites[i].position, sites[j].position);
          const double offset = (d * d + sites[i].weight - sites[j].weight) / (2 * d);
          if (offset < reach) {
            ASSERT_TRUE(found.contains(j)) << round << ": " << i << " misses " << j << " at reach " << reach;
          }
        }
      }
    }
  }
}

}  // namespace
}  // namespace bl::test
