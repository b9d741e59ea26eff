// Laws of the cell engine on thousands of random sets: two routes, two depths of measure, any threads, any history.
#include <cmath>

#include "core/geometry/inside/cell_maker.h"
#include "core/geometry/inside/coincidence.h"
#include "core/geometry/inside/shape_measure.h"
#include "tests/core/geometry/site_zoo.h"

namespace bl::test {
namespace {

constexpr std::uint32_t kNone = 0xffffffffu;

geometry::CellOptions plain(bool with_shape = false, ThreadPool* pool = nullptr) {
  geometry::CellOptions options;
  options.with_shape = options.with_centroid = with_shape;
  options.pool = pool;
  return options;
}

std::vector<geometry::CellMeasure> measure(const geometry::Domain& domain, std::span<const geometry::PowerSite> sites,
                                           const geometry::CellOptions& options) {
  auto cells = power_cells(domain, sites, options);
  EXPECT_TRUE(cells.ok()) << (cells.ok() ? "" : cells.error().text());
  return cells.ok() ? *cells : std::vector<geometry::CellMeasure>{};
}

bool same_bits(const geometry::CellMeasure& a, const geometry::CellMeasure& b) {
  return a.state == b.state && a.volume == b.volume && a.cell_volume == b.cell_volume && a.surface_area == b.surface_area &&
         a.spherical_area == b.spherical_area && a.centroid == b.centroid && a.facets == b.facets &&
         a.volume_by_own_weight == b.volume_by_own_weight && a.reason == b.reason;
}

std::size_t first_difference(std::span<const geometry::CellMeasure> a, std::span<const geometry::CellMeasure> b) {
  if (a.size() != b.size()) return 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (!same_bits(a[i], b[i])) return i;
  }
  return a.size();
}

const geometry::FacetArea* find_facet(const geometry::CellMeasure& cell, std::uint32_t site) {
  for (const geometry::FacetArea& facet : cell.facets) {
    if (facet.kind == geometry::FacetArea::Kind::site && facet.index == site) return &facet;
  }
  return nullptr;
}

// What close sites cost: a bisector is known to about the rounding of a position over the distance of its two sites.
double rounding(const SiteSet& set) { return set.name.starts_with("clu") || set.name.starts_with("clo") ? 1e-9 : 1e-12; }

// Calls check(set) for so many sets of the zoo, small ones, each kind in turn.
void for_zoo(int sets, std::uint64_t seed, auto&& check) {
  Random random(seed);
  for (int k = 0; k < sets && !testing::Test::HasFailure(); ++k) {
    const std::size_t count = 5 + random.below(k % 10 == 0 ? 120 : 40);
    const SiteSet set = zoo_set(k % kZooKinds, count, seed + static_cast<std::uint64_t>(k));
    SCOPED_TRACE(set.name + ", " + std::to_string(set.sites.size()) + " sites");
    check(set);
  }
}

TEST(CellEngine, WholeCellsTileTheDomainAndBallsStayWithinThem) {
  for_zoo(rounds(3000), 1000, [](const SiteSet& set) {
    const auto cells = measure(set.domain, set.sites, plain(true));
    const geometry::CellTotals totals = totals_of(cells);
    EXPECT_EQ(totals.alive + totals.hidden + totals.outside + totals.coincident + totals.starved, set.sites.size());
    EXPECT_NEAR(totals.cell_volume, set.domain.volume, 2 * rounding(set) * set.domain.volume);
    for (const geometry::CellMeasure& cell : cells) {
      EXPECT_LE(cell.volume, cell.cell_volume);
      EXPECT_EQ(cell.volume > 0, cell.surface_area > 0);
    }
  });
}

// What a fit asks for is made in another way than what people look at: as far as the ball reaches, no further.
TEST(CellEngine, LimitedCellsAreWholeCellsWithinTheBall) {
  for_zoo(rounds(2500), 2000, [](const SiteSet& set) {
    const auto whole = measure(set.domain, set.sites, plain(true)), limited = measure(set.domain, set.sites, plain(false));
    for (std::uint32_t i = 0; i < set.sites.size(); ++i) {
      const double nothing = 1e-14 * set.domain.volume, wide = std::max(1e-300, set.sites[i].weight);
      EXPECT_NEAR(limited[i].volume, whole[i].volume, 1e-12 * whole[i].volume + nothing) << i << " of weight " << wide;
      EXPECT_NEAR(limited[i].spherical_area, whole[i].spherical_area, 1e-11 * (std::min(wide, 1.0) + wide * 1e-3) + 1e-14) << i;
      for (const geometry::FacetArea& facet : whole[i].facets) {
        if (facet.kind != geometry::FacetArea::Kind::site || facet.area < 1e-10) continue;
        const geometry::FacetArea* same = find_facet(limited[i], facet.index);
        ASSERT_NE(same, nullptr) << i << " " << facet.index;
        EXPECT_NEAR(same->area, facet.area, 1e-11) << i << " " << facet.index;
      }
    }
  });
}

// Both directions of the search for neighbours: blocks of sites, and the triangulation.
TEST(CellEngine, TheGridFindsWhatTheTriangulationFinds) {
  for_zoo(rounds(1500), 3000, [](const SiteSet& set) {
    std::vector<std::uint32_t> twin, participants;
    find_coincident(set.sites, geometry::kCoincidenceShare * set.domain.size(), twin);
    for (std::uint32_t i = 0; i < twin.size(); ++i) {
      if (twin[i] == kNone) participants.push_back(i);
    }
    geometry::CellInput by_grid, by_triangles;
    for (geometry::CellInput* ground : {&by_grid, &by_triangles}) {
      ground->set_domain(set.domain);
      ASSERT_TRUE(ground->set_sites(set.sites, participants).ok());
    }
    by_grid.is_triangulated = false;
    by_triangles.is_triangulated = true;
    ASSERT_TRUE(find_power_neighbours(set.sites, participants, by_triangles.neighbours).ok());
    geometry::CellMaker a, b;
    geometry::ShapeMeasure shape;
    const auto volume = [&](geometry::CellMaker& maker, const geometry::CellInput& ground, std::uint32_t i, bool whole) {
      maker.make(ground, i, whole);
      double sum = 0;
      for (const geometry::Polyhedron& part : maker.parts()) {
        if (!whole) measure_shape(part, std::max(0.0, set.sites[i].weight), {}, false, shape);
        sum += whole ? geometry::measure_whole(part).volume : shape.volume;
      }
      return sum;
    };
    for (const std::uint32_t i : participants) {
      for (const bool whole : {true, false}) {
        const double first = volume(a, by_grid, i, whole), second = volume(b, by_triangles, i, whole);
        EXPECT_NEAR(first, second, 1e-12 * first + 1e-14 * set.domain.volume) << i << (whole ? " whole" : " in its ball");
      }
    }
  });
}

// The triangulation's own route, as it is taken: hundreds of sites in a few tiny clusters.
TEST(CellEngine, UnevenSetsTileTheDomainToo) {
  for (int k = 0; k < rounds(20); ++k) {
    SiteSet set = zoo_set(13, 900, 77 + static_cast<std::uint64_t>(k));
    for (int i = 0; i < 20; ++i) set.sites.push_back(random_sites(1, 900 + static_cast<std::uint64_t>(i), 0, 0.01)[0]);
    geometry::CellInput ground;
    ground.set_domain(set.domain);
    std::vector<std::uint32_t> all(set.sites.size());
    for (std::uint32_t i = 0; i < all.size(); ++i) all[i] = i;
    ASSERT_TRUE(ground.set_sites(set.sites, all).ok());
    EXPECT_TRUE(ground.is_triangulated);
    const auto cells = measure(set.domain, set.sites, plain(true)), limited = measure(set.domain, set.sites, plain(false));
    EXPECT_NEAR(totals_of(cells).cell_volume, set.domain.volume, 1e-11 * set.domain.volume);
    for (std::size_t i = 0; i < cells.size(); ++i) {
      EXPECT_NEAR(cells[i].volume, limited[i].volume, 1e-12 * cells[i].volume + 1e-14) << i;
    }
  }
}

// A few clusters make a grid of many blocks in one direction: neighbours lie many blocks apart.
TEST(CellEngine, ClustersFarApartFindEachOther) {
  for (int k = 0; k < rounds(400) && !HasFailure(); ++k) {
    Random random(static_cast<std::uint64_t>(k));
    std::vector<geometry::PowerSite> sites;
    const int clusters = 2 + static_cast<int>(random.below(3));
    std::vector<Point3> centres;
    for (int c = 0; c < clusters; ++c) centres.push_back({random.uniform(), random.uniform(0, 0.2), random.uniform(0, 0.2)});
    for (int i = 0; i < 60; ++i) {
      const Point3 p = centres[random.below(centres.size())] + 0.02 * random_point(random, {0, 0, 0}, {1, 1, 1});
      sites.push_back({p, 0.01 + 1e-4 * random.uniform()});
    }
    const auto cells = measure(unit_cube(), sites, plain(true));
    EXPECT_NEAR(totals_of(cells).cell_volume, 1, 1e-10) << "set " << k;
  }
}

TEST(CellEngine, ThreadsChangeNoBit) {
  ThreadPool two(2), three(3), eight(8);
  for_zoo(rounds(400), 4000, [&](const SiteSet& given) {
    SiteSet set = given;
    for (const geometry::PowerSite& more : zoo_set(static_cast<int>(set.sites.size() % 4), 60, 5).sites)
      set.sites.push_back(more);
    for (const bool with_shape : {true, false}) {
      const auto alone = measure(set.domain, set.sites, plain(with_shape));
      for (ThreadPool* pool : {&two, &three, &eight}) {
        const auto together = measure(set.domain, set.sites, plain(with_shape, pool));
        EXPECT_EQ(first_difference(alone, together), alone.size()) << pool->threads() << " threads, shape " << with_shape;
      }
    }
  });
}

TEST(CellEngine, SharedFacetsAreSeenAlikeFromBothSides) {
  for_zoo(rounds(1000), 5000, [](const SiteSet& set) {
    for (const bool with_shape : {true, false}) {
      const auto cells = measure(set.domain, set.sites, plain(with_shape));
      for (std::uint32_t i = 0; i < cells.size(); ++i) {
        for (const geometry::FacetArea& facet : cells[i].facets) {
          if (facet.kind != geometry::FacetArea::Kind::site || facet.area < 1e-9) continue;
          const geometry::FacetArea* back = find_facet(cells[facet.index], i);
          ASSERT_NE(back, nullptr) << i << " " << facet.index << " area " << facet.area;
          EXPECT_NEAR(back->area, facet.area, 1e-11 + 1e-9 * facet.area) << i << " " << facet.index;
        }
      }
    }
  });
}

// Area vectors of a closed surface add up to nothing; the spherical part's follows from the centroid of the ball's own part,
// which is why the volume is tested by the divergence theorem on the flat facets and the sphere together:
// 3 V = sum of A_k h_k + r S, with h_k the distance of the facet's plane from the site.
TEST(CellEngine, FacetsAndSphereEncloseTheVolume) {
  for_zoo(rounds(600), 6000, [](const SiteSet& set) {
    if (!set.domain.is_convex()) return;
    const geometry::ConvexDomain& room = set.domain.pieces[0].shape;
    const auto cells = measure(set.domain, set.sites, plain(false));
    for (std::uint32_t i = 0; i < cells.size(); ++i) {
      const geometry::PowerSite& own = set.sites[i];
      if (!(cells[i].volume > 0) || own.weight > 100) continue;
      double sum = std::sqrt(own.weight) * cells[i].spherical_area, size = sum;
      for (const geometry::FacetArea& facet : cells[i].facets) {
        double h = 0;
        if (facet.kind == geometry::FacetArea::Kind::plane) {
          h = room.planes[facet.index].offset - dot(room.planes[facet.index].normal, own.position);
        } else {
          const geometry::PowerSite& other = set.sites[facet.index];
          const double d = distance(own.position, other.position);
          h = (d * d + own.weight - other.weight) / (2 * d);
        }
        sum += h * facet.area;
        size += std::abs(h) * facet.area;
      }
      EXPECT_NEAR(sum / 3, cells[i].volume, 1e-11 * size + 1e-13) << i;
    }
  });
}

TEST(CellEngine, OrderOfTheSitesChangesRoundingOnly) {
  for_zoo(rounds(500), 7000, [](const SiteSet& set) {
    if (set.name.starts_with("coincident")) return;  // of equals at one place the first lives: the order decides
    std::vector<geometry::PowerSite> reversed(set.sites.rbegin(), set.sites.rend());
    const auto cells = measure(set.domain, set.sites, plain(true)), back = measure(set.domain, reversed, plain(true));
    for (std::size_t i = 0; i < cells.size(); ++i) {
      const geometry::CellMeasure& other = back[cells.size() - 1 - i];
      EXPECT_NEAR(cells[i].volume, other.volume, rounding(set) * cells[i].volume + 1e-14) << i;
      EXPECT_NEAR(cells[i].cell_volume, other.cell_volume, rounding(set) * cells[i].cell_volume + 1e-14) << i;
    }
  });
}

TEST(CellEngine, ScaledAndMovedSetsHaveScaledVolumes) {
  for_zoo(rounds(500), 8000, [](const SiteSet& set) {
    // Whole 2^-20ths and powers of two: moving and scaling are then exact, and only the arithmetic is tested.
    const auto round = [](const Point3& p) {
      return Point3{std::round(p.x * 0x1p20), std::round(p.y * 0x1p20), std::round(p.z * 0x1p20)} * 0x1p-20;
    };
    std::vector<geometry::PowerSite> here, there;
    for (const geometry::PowerSite& s : set.sites) {
      here.push_back({round(s.position), s.weight});
      there.push_back({4 * round(s.position) + Vector3{4096, -2048, 64}, 16 * s.weight});
    }
    const geometry::Domain cube = unit_cube(), moved = box({4096, -2048, 64}, {4100, -2044, 68});
    for (const bool with_shape : {true, false}) {
      const auto cells = measure(cube, here, plain(with_shape)), after = measure(moved, there, plain(with_shape));
      for (std::size_t i = 0; i < cells.size(); ++i) {
        EXPECT_NEAR(after[i].volume, 64 * cells[i].volume, 64e-12 * cells[i].volume + 64e-14) << i;
        EXPECT_NEAR(after[i].spherical_area, 16 * cells[i].spherical_area, 16e-11 * (1 + here[i].weight)) << i;
      }
    }
  });
}

TEST(CellEngine, SamplesCountTheVolumes) {
  for_zoo(rounds(60), 9000, [](const SiteSet& set) {
    const auto cells = measure(set.domain, set.sites, plain(false));
    std::vector<int> hits(cells.size(), 0);
    Random random(17);
    constexpr int kSamples = 20000;
    const Vector3 extent = set.domain.maximum - set.domain.minimum;
    for (int s = 0; s < kSamples; ++s) {
      const Point3 x = random_point(random, set.domain.minimum, set.domain.maximum);
      std::size_t best = 0;
      for (std::size_t i = 1; i < cells.size(); ++i) {
        if (power(set.sites[i], x) < power(set.sites[best], x)) best = i;
      }
      if (power(set.sites[best], x) <= 0 && set.domain.contains(x)) ++hits[best];
    }
    const double all = extent.x * extent.y * extent.z;
    for (std::size_t i = 0; i < cells.size(); ++i) {
      if (set.name.starts_with("coincident") || set.name.starts_with("clusters")) continue;
      const double share = cells[i].volume / all;
      EXPECT_NEAR(hits[i] / static_cast<double>(kSamples), share,
                  6 * std::sqrt(share * std::max(0.0, 1 - share) / kSamples) + 4e-4)
          << i;
    }
  });
}

}  // namespace
}  // namespace bl::test
