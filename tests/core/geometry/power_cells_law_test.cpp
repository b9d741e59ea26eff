// Laws of the power cells: what has to hold for any sites.
#include <cmath>

#include "tests/core/geometry/geometry_support.h"

namespace bl::test {
namespace {

// A bounded domain without symmetry, so that nothing holds by luck.
geometry::ConvexDomain skew_domain() {
  const std::vector<Point3> points{{0, 0, 0},     {1, 0.1, 0},     {1.1, 1, 0.1}, {0, 0.9, -0.1},
                                   {0.2, 0.1, 1}, {0.9, 0.8, 1.2}, {0.1, 1, 0.9}};
  return geometry::convex_hull(points).value();
}

double relative_error(double got, double wanted) { return std::abs(got - wanted) / std::max(1e-300, std::abs(wanted)); }

TEST(PowerCellLaws, CellsTileTheDomain) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const geometry::ConvexDomain domain = seed % 2 ? unit_cube() : skew_domain();
    const auto cells = cells_of(domain, random_sites(1 + 7 * seed, seed, -0.01, 0.02 * static_cast<double>(seed % 5)));
    EXPECT_LT(relative_error(totals_of(cells).cell_volume, domain.volume), 1e-12) << seed;
    EXPECT_LE(totals_of(cells).volume, domain.volume * (1 + 1e-12));
  }
}

TEST(PowerCellLaws, SharedFacetsAreSeenAlikeFromBothSides) {
  // Balls large enough to hold every cell: the facets are then the full ones.
  const auto sites = random_sites(80, 5, 9, 9.02);
  const auto cells = cells_of(unit_cube(), sites);
  for (std::uint32_t i = 0; i < cells.size(); ++i) {
    for (const geometry::FacetArea& facet : cells[i].facets) {
      if (facet.kind != geometry::FacetArea::Kind::site || facet.area < 1e-10) continue;
      const auto& others = cells[facet.index].facets;
      const auto back = std::find_if(others.begin(), others.end(),
                                     [&](const geometry::FacetArea& f) { return f.kind == facet.kind && f.index == i; });
      ASSERT_NE(back, others.end());
      EXPECT_NEAR(back->area, facet.area, 1e-12);
    }
  }
}

// With the ball, too: a shared facet lies in both balls or in neither, because both powers are equal on it.
TEST(PowerCellLaws, SharedFacetsAreSeenAlikeInsideTheBalls) {
  const auto sites = random_sites(60, 6, 0.01, 0.05);
  const auto cells = cells_of(unit_cube(), sites);
  for (std::uint32_t i = 0; i < cells.size(); ++i) {
    for (const geometry::FacetArea& facet : cells[i].facets) {
      if (facet.kind != geometry::FacetArea::Kind::site || facet.area < 1e-10) continue;
      const auto& others = cells[facet.index].facets;
      const auto back = std::find_if(others.begin(), others.end(),
                                     [&](const geometry::FacetArea& f) { return f.kind == facet.kind && f.index == i; });
      ASSERT_NE(back, others.end());
      EXPECT_NEAR(back->area, facet.area, 1e-12);
    }
  }
}

// The meshes hold exactly the sample points that the distances assign to them (checked by winding of rays: convex, so by planes).
TEST(PowerCellLaws, SamplesCountTheVolumes) {
  const auto sites = random_sites(12, 9, 0.02, 0.12);
  const geometry::ConvexDomain domain = unit_cube();
  const auto cells = cells_of(domain, sites);
  std::vector<int> hits(sites.size(), 0);
  std::vector<Vector3> sums(sites.size());
  Random random(3);
  constexpr int kSamples = 400000;
  for (int s = 0; s < kSamples; ++s) {
    const Point3 x = random_point(random, {0, 0, 0}, {1, 1, 1});
    std::size_t best = 0;
    for (std::size_t i = 1; i < sites.size(); ++i) {
      if (power(sites[i], x) < power(sites[best], x)) best = i;
    }
    if (power(sites[best], x) > 0) continue;
    ++hits[best];
    sums[best] += x;
  }
  for (std::size_t i = 0; i < sites.size(); ++i) {
    const double v = cells[i].volume, share = hits[i] / static_cast<double>(kSamples);
    EXPECT_NEAR(share, v, 5 * std::sqrt(v * (1 - v) / kSamples) + 1e-6) << i;
    if (hits[i] < 1000) continue;
    const double spread = 5 * 0.3 / std::sqrt(static_cast<double>(hits[i]));
    EXPECT_LT(distance(sums[i] / hits[i], cells[i].centroid), spread) << i;
  }
}

TEST(PowerCellLaws, ResponseToWeightsIsTheDerivative) {
  auto sites = random_sites(30, 11, 0.01, 0.06);
  const auto cells = cells_of(skew_domain(), sites);
  for (std::size_t i = 0; i < sites.size(); ++i) {
    if (cells[i].state != geometry::SiteState::alive) continue;
    const double h = 1e-6 * sites[i].weight, before = sites[i].weight;
    sites[i].weight = before + h;
    const double more = cells_of(skew_domain(), sites)[i].volume;
    sites[i].weight = before - h;
    const double less = cells_of(skew_domain(), sites)[i].volume;
    sites[i].weight = before;
    EXPECT_NEAR((more - less) / (2 * h), cells[i].volume_by_own_weight, 1e-5 * cells[i].volume_by_own_weight) << i;
  }
}

std::vector<Point3> moved_points(const geometry::ConvexDomain& domain, auto&& map) {
  std::vector<Point3> points;
  for (const Point3& p : domain.vertices) points.push_back(map(p));
  return points;
}

void expect_alike(std::span<const geometry::CellMeasure> a, std::span<const geometry::CellMeasure> b, double scale,
                  double tolerance) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double cube = scale * scale * scale, square = scale * scale;
    EXPECT_EQ(a[i].state, b[i].state) << i;
    EXPECT_NEAR(b[i].volume, a[i].volume * cube, tolerance * cube) << i;
    EXPECT_NEAR(b[i].cell_volume, a[i].cell_volume * cube, tolerance * cube) << i;
    EXPECT_NEAR(b[i].surface_area, a[i].surface_area * square, tolerance * square) << i;
    EXPECT_NEAR(b[i].spherical_area, a[i].spherical_area * square, tolerance * square) << i;
  }
}

TEST(PowerCellLaws, ScaleByTheCube) {
  const auto sites = random_sites(50, 21, 0.0, 0.05);
  const geometry::ConvexDomain domain = skew_domain();
  const auto cells = cells_of(domain, sites);
  for (const double scale : {0.25, 1024.0, 3.0}) {
    const geometry::ConvexDomain big =
        geometry::convex_hull(moved_points(domain, [&](const Point3& p) { return scale * p; })).value();
    std::vector<geometry::PowerSite> moved;
    for (const geometry::PowerSite& s : sites) moved.push_back({scale * s.position, scale * scale * s.weight});
    const auto after = cells_of(big, moved);
    expect_alike(cells, after, scale, 1e-12);
    for (std::size_t i = 0; i < cells.size(); ++i)
      EXPECT_NEAR(after[i].footprint, scale * scale * cells[i].footprint, 1e-12 * scale * scale);
  }
}

TEST(PowerCellLaws, StayTheSameFarFromTheOrigin) {
  const auto sites = random_sites(50, 22, 0.0, 0.05);
  // Whole eighths and a power of two, so that moving is exact and only the arithmetic is tested.
  const auto round = [](const Point3& p) {
    return Point3{std::round(p.x * 4096) / 4096, std::round(p.y * 4096) / 4096, std::round(p.z * 4096) / 4096};
  };
  const Vector3 shift{16384, -8192, 128};
  std::vector<geometry::PowerSite> here, there;
  for (const geometry::PowerSite& s : sites) {
    here.push_back({round(s.position), s.weight});
    there.push_back({round(s.position) + shift, s.weight});
  }
  const auto cells = cells_of(box({0, 0, 0}, {1, 1, 1}), here);
  const auto after = cells_of(box(shift, shift + Vector3{1, 1, 1}), there);
  expect_alike(cells, after, 1, 1e-14);
}

TEST(PowerCellLaws, StayTheSameUnderRotation) {
  const auto sites = random_sites(50, 23, 0.0, 0.05);
  const geometry::ConvexDomain domain = unit_cube();
  const double c = 0.6, s = 0.8;
  const auto turn = [&](const Point3& p) {
    const Point3 q{c * p.x - s * p.y, s * p.x + c * p.y, p.z};
    return Point3{q.x, c * q.y - s * q.z, s * q.y + c * q.z};
  };
  const auto turned_domain = geometry::convex_hull(moved_points(domain, turn));
  ASSERT_TRUE(turned_domain.ok()) << turned_domain.error().text();
  EXPECT_EQ(turned_domain->planes.size(), 6u);
  std::vector<geometry::PowerSite> turned;
  for (const geometry::PowerSite& site : sites) turned.push_back({turn(site.position), site.weight});
  expect_alike(cells_of(domain, sites), cells_of(*turned_domain, turned), 1, 1e-12);
}

TEST(PowerCellLaws, StayTheSameUnderRelabelling) {
  const auto sites = random_sites(70, 24, -0.01, 0.05);
  const auto cells = cells_of(unit_cube(), sites);
  std::vector<std::uint32_t> order(sites.size());
  for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = (i * 27u + 13u) % 70u;
  std::vector<geometry::PowerSite> shuffled;
  for (const std::uint32_t i : order) shuffled.push_back(sites[i]);
  const auto after = cells_of(unit_cube(), shuffled);
  std::vector<geometry::CellMeasure> back(cells.size());
  for (std::size_t k = 0; k < order.size(); ++k) back[order[k]] = after[k];
  expect_alike(cells, back, 1, 1e-13);
}

bool same_bits_of_cells(const geometry::CellMeasure& a, const geometry::CellMeasure& b) {
  return a.state == b.state && a.reason == b.reason && a.volume == b.volume && a.cell_volume == b.cell_volume &&
         a.surface_area == b.surface_area && a.spherical_area == b.spherical_area && a.floor_area == b.floor_area &&
         a.footprint == b.footprint && a.height == b.height && a.bottom == b.bottom && a.centroid == b.centroid &&
         a.facets == b.facets && a.volume_by_own_weight == b.volume_by_own_weight && (a.mesh == nullptr) == (b.mesh == nullptr) &&
         (a.mesh == nullptr || *a.mesh == *b.mesh);
}

TEST(PowerCellLaws, ThreadsAndHistoryChangeNoBit) {
  const auto sites = random_sites(300, 25, -0.01, 0.03), others = random_sites(40, 26, 0, 0.1);
  ThreadPool two(2), five(5);
  geometry::CellOptions options;
  options.tessellation_depth = 1;
  options.storey_height = 0.05;
  const auto once = power_cells(unit_cube(), sites, options);
  ASSERT_TRUE(once.ok());
  geometry::PowerDiagram diagram;
  ASSERT_TRUE(diagram.set_domain(unit_cube()).ok());
  for (ThreadPool* pool : {&two, &five, static_cast<ThreadPool*>(nullptr)}) {
    options.pool = pool;
    ASSERT_TRUE(diagram.update(others, options).ok());
    const auto cells = diagram.update(sites, options);
    ASSERT_TRUE(cells.ok());
    for (std::size_t i = 0; i < sites.size(); ++i) EXPECT_TRUE(same_bits_of_cells((*cells)[i], (*once)[i])) << i;
  }
}

// A site that grows or jumps may swallow others whole, which then border on nobody.
TEST(PowerCellLaws, LocalChangesEndWhereMakingAnewEnds) {
  for (const bool is_whole : {true, false}) {
    geometry::CellOptions options;
    options.with_shape = is_whole;
    Random random(61);
    auto sites = random_sites(60, 62, 0.001, 0.02);
    geometry::PowerDiagram diagram;
    ASSERT_TRUE(diagram.set_domain(unit_cube()).ok());
    std::size_t made = 0;
    for (int step = 0; step < 400; ++step) {
      geometry::PowerSite& site = sites[random.below(sites.size())];
      if (step % 2 == 0) site.position = random_point(random, {-0.1, -0.1, -0.1}, {1.1, 1.1, 1.1});
      else site.weight = random.uniform(-0.01, step % 3 == 0 ? 0.2 : 0.02);
      ASSERT_TRUE(diagram.update(sites, options).ok());
      made += diagram.made().size();
      const auto anew = power_cells(unit_cube(), sites, options).value();
      for (std::size_t i = 0; i < sites.size(); ++i) {
        ASSERT_TRUE(same_bits_of_cells(diagram.cells()[i], anew[i])) << is_whole << " " << step << " " << i;
      }
    }
    EXPECT_LT(made, 400u * 45u);
  }
}

// Radii chosen exactly at the distance of a vertex, an edge or a plane, where a topological formula would stumble.
TEST(PowerCellLaws, TangentBallsAreContinuous) {
  const geometry::ConvexDomain domain = skew_domain();
  Random random(31);
  for (int round = 0; round < 400; ++round) {
    const Point3 p = random_point(random, {0.1, 0.2, 0}, {0.9, 0.8, 0.9});
    std::vector<double> radii;
    for (const Point3& v : domain.vertices) radii.push_back(distance(p, v));
    for (const geometry::Plane& plane : domain.planes) radii.push_back(std::abs(plane.offset - dot(plane.normal, p)));
    for (const auto& face : domain.faces) {
      const Point3 a = domain.vertices[face[0]], b = domain.vertices[face[1]];
      radii.push_back(norm(cross(b - a, p - a)) / distance(a, b));
    }
    const double r = radii[random.below(radii.size())];
    if (!(r > 0)) continue;
    const auto volume = [&](double radius) {
      return cells_of(domain, std::vector<geometry::PowerSite>{{p, radius * radius}})[0];
    };
    const geometry::CellMeasure less = volume(r * (1 - 1e-7)), at = volume(r), more = volume(r * (1 + 1e-7));
    const double rim = 4 * 3.15 * r * r * r * 1e-7;
    EXPECT_LE(less.volume, at.volume + 1e-14);
    EXPECT_LE(at.volume, more.volume + 1e-14);
    EXPECT_LE(more.volume - less.volume, 2 * rim + 1e-14);
    EXPECT_NEAR(at.spherical_area, less.spherical_area, 1e-2 * r * r);
    EXPECT_NEAR(at.height, less.height, 1e-3);
    EXPECT_NEAR(at.footprint, less.footprint, 1e-3);
  }
}

// Area of the plan convex hull of points (monotone chain).
double plan_hull_area(std::vector<Point3> points) {
  std::sort(points.begin(), points.end(), [](const Point3& a, const Point3& b) { return a.x != b.x ? a.x < b.x : a.y < b.y; });
  std::vector<Point3> hull;
  for (int side = 0; side < 2; ++side) {
    const std::size_t first = hull.size();
    for (const Point3& p : points) {
      const auto turns_right = [&] {
        const Point3 &a = hull[hull.size() - 2], &b = hull.back();
        return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x) <= 0;
      };
      while (hull.size() >= first + 2 && turns_right()) hull.pop_back();
      hull.push_back(p);
    }
    hull.pop_back();
    std::reverse(points.begin(), points.end());
  }
  double doubled = 0;
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const Point3 &a = hull[i], &b = hull[(i + 1) % hull.size()];
    doubled += a.x * b.y - a.y * b.x;
  }
  return 0.5 * doubled;
}

// Height and footprint against the mesh of the same shape, whose vertices all lie in it.
TEST(PowerCellLaws, ExtentAndFootprintBoundTheMesh) {
  for (std::uint64_t seed = 41; seed < 49; ++seed) {
    const auto sites = random_sites(25, seed, 0.005, 0.2);
    const auto cells = cells_of(skew_domain(), sites, 4);
    for (std::size_t i = 0; i < cells.size(); ++i) {
      if (!cells[i].mesh) continue;
      double low = 1e9, high = -1e9;
      for (const Point3& v : cells[i].mesh->vertices) {
        low = std::min(low, v.z);
        high = std::max(high, v.z);
      }
      const double shadow = plan_hull_area(cells[i].mesh->vertices);
      EXPECT_GE(cells[i].bottom + cells[i].height, high - 1e-9) << seed << " " << i;
      EXPECT_LE(cells[i].bottom, low + 1e-9);
      EXPECT_NEAR(cells[i].height, high - low, 0.05 * cells[i].height);
      EXPECT_GE(cells[i].footprint, shadow - 1e-12) << seed << " " << i;
      EXPECT_NEAR(cells[i].footprint, shadow, 0.04 * cells[i].footprint) << seed << " " << i;
      EXPECT_GE(cells[i].footprint * cells[i].height, cells[i].volume * (1 - 1e-12));
      EXPECT_LE(cells[i].volume, cells[i].cell_volume);
    }
  }
}

// Fine storeys add up to the volume (Cavalieri).
TEST(PowerCellLaws, FloorsOfThinStoreysAddUpToTheVolume) {
  const auto sites = random_sites(25, 51, 0.005, 0.2);
  geometry::CellOptions options;
  options.storey_height = 0.0005;
  const auto cells = power_cells(skew_domain(), sites, options).value();
  for (const geometry::CellMeasure& cell : cells)
    EXPECT_NEAR(cell.floor_area * options.storey_height, cell.volume, 2e-3 * cell.volume + 1e-9);
}

}  // namespace
}  // namespace bl::test
