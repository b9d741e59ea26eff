// Domains cut by planes, joined, and hollowed: volumes by inclusion and exclusion, surfaces by hand, and what keeps its bits.
#include "core/geometry/plan_ring.h"
#include "tests/core/geometry/domain_laws.h"

namespace bl::test {
namespace {

const std::vector<Point3> kEll = ring_of({{0, 0}, {20, 0}, {20, 10}, {10, 10}, {10, 20}, {0, 20}});

geometry::Domain ell(double height) { return geometry::extrude_plan(kEll, {}, 0, height).value(); }

bool has_piece(const geometry::Domain& domain, const geometry::Domain::Piece& piece) {
  return std::find(domain.pieces.begin(), domain.pieces.end(), piece) != domain.pieces.end();
}

// The share of sample points that are held, times the box.
void expect_same_points(const geometry::Domain& domain, auto&& is_inside) {
  Random random(9);
  for (int k = 0; k < 2000; ++k) {
    const Point3 p = random_point(random, domain.minimum, domain.maximum);
    EXPECT_EQ(domain.contains(p), is_inside(p)) << p.x << " " << p.y << " " << p.z;
  }
}

TEST(DomainCut, ASetbackTakesAWedge) {
  // From 6 m up at the south wall, rising one to one.
  const auto cut = cut_domain(ell(10), std::vector<geometry::Plane>{{{0, -1, 1}, 6}, {{0, 0, 1}, 100}});
  ASSERT_TRUE(cut.ok()) << cut.error().text();
  EXPECT_EQ(cut->side_count, 10u);
  const double wedge = 0.5 * 4 * 4 * 20;
  EXPECT_NEAR(outer_area(*cut, 8), 4 * std::sqrt(2) * 20, 1e-9);
  EXPECT_EQ(outer_area(*cut, 9), 0);
  expect_sound(*cut, 3000 - wedge, 2 * 300 + 80 * 10 - 4 * 20 - 4 * 20 + 4 * std::sqrt(2) * 20 - 2 * 8);
}

TEST(DomainCut, WhatNoPlaneCutsKeepsItsBits) {
  const geometry::Domain before = ell(10);
  EXPECT_EQ(cut_domain(before, std::vector<geometry::Plane>{{{0, 0, 1}, 10}})->pieces, before.pieces);
  EXPECT_EQ(cut_domain(before, std::vector<geometry::Plane>{{{0, 0, 1}, -1}}).error().text(),
            "the planes cut the whole boundary away: nothing is left of it");
  EXPECT_EQ(cut_domain(before, std::vector<geometry::Plane>{{{0, 0, 1}, 9}, {{0, 0, 0}, 1}}).error().place, "1");
}

TEST(DomainCut, APlaneInAnInnerFaceMakesItSurface) {
  // The ell falls into two pieces along the diagonal from (0, 0) to (10, 10).
  const auto cut = cut_domain(ell(10), std::vector<geometry::Plane>{{{-1, 1, 0}, 0}});
  ASSERT_TRUE(cut.ok());
  ASSERT_EQ(cut->pieces.size(), 1u);
  EXPECT_NEAR(outer_area(*cut, 8), 10 * std::sqrt(200), 1e-9);
  expect_sound(*cut, 1500, 2 * 150 + 10 * (20 + 10 + 10 + std::sqrt(200)));
}

TEST(DomainCut, ATowerOnAPodium) {
  const geometry::Domain podium = box({0, 0, 0}, {30, 20, 6}), tower = box({5, 5, 0}, {15, 15, 40});
  const std::vector<geometry::Domain> both{podium, tower};
  const auto domain = unite(both);
  ASSERT_TRUE(domain.ok()) << domain.error().text();
  EXPECT_LE(domain->pieces.size(), 8u);
  EXPECT_EQ(domain->side_count, 12u);
  expect_sound(*domain, 3600 + 3400, 2 * 600 + 100 * 6 + 40 * 34);
  EXPECT_NEAR(outer_area(*domain, 1), 500, 1e-9);
  EXPECT_NEAR(area_in_plan(*domain), 600, 1e-6);
  const std::vector<geometry::Domain> turned{tower, podium};
  const auto other = unite(turned);
  ASSERT_TRUE(other.ok()) << other.error().text();
  expect_sound(*other, 7000, 2 * 600 + 100 * 6 + 40 * 34);
}

TEST(DomainCut, StepsThatShareWalls) {
  // Three terraces side by side, the middle one reaching into both neighbours.
  const std::vector<geometry::Domain> steps{box({0, 0, 0}, {10, 10, 3}), box({5, 0, 0}, {25, 10, 6}),
                                            box({20, 0, 0}, {30, 10, 9})};
  const auto domain = unite(steps);
  ASSERT_TRUE(domain.ok()) << domain.error().text();
  expect_sound(*domain, 150 + 900 + 900, 2 * (15 + 90 + 90) + 2 * 300 + 10 * (3 + 3 + 3 + 9));
  EXPECT_LE(domain->pieces.size(), 7u);
}

TEST(DomainCut, RandomUnionsOfBoxesAddUp) {
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    Random random(seed);
    std::vector<geometry::Domain> boxes;
    for (std::uint64_t k = 0, n = 2 + random.below(4); k < n; ++k) {
      // Whole metres, so that faces often meet.
      const double x = static_cast<double>(random.below(6)), y = static_cast<double>(random.below(6)),
                   z = static_cast<double>(random.below(3));
      boxes.push_back(box({x, y, z}, {x + 1 + static_cast<double>(random.below(5)), y + 1 + static_cast<double>(random.below(5)),
                                      z + 1 + static_cast<double>(random.below(5))}));
    }
    // Unit cubes counted one by one.
    const auto held = [&](int x, int y, int z) {
      return std::any_of(boxes.begin(), boxes.end(), [&](const geometry::Domain& b) {
        return b.contains({x + 0.5, y + 0.5, z + 0.5});
      });
    };
    double volume = 0, surface = 0;
    for (int x = 0; x < 12; ++x)
      for (int y = 0; y < 12; ++y)
        for (int z = 0; z < 12; ++z) {
          if (!held(x, y, z)) continue;
          volume += 1;
          for (const auto& [i, j, k] : {std::array{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}})
            surface += held(x + i, y + j, z + k) ? 0 : 1;
        }
    const auto domain = unite(boxes);
    SCOPED_TRACE(seed);
    ASSERT_TRUE(domain.ok()) << domain.error().text();
    expect_sound(*domain, volume, surface);
    EXPECT_LE(domain->pieces.size(), 60u);
  }
}

TEST(DomainCut, ABuildingThatStaysIsAHole) {
  const geometry::Domain site = box({0, 0, 0}, {40, 30, 20});
  const std::vector<geometry::Domain> standing{box({10, 10, -5}, {20, 18, 12})};
  const auto domain = exclude(site, standing);
  ASSERT_TRUE(domain.ok()) << domain.error().text();
  EXPECT_EQ(domain->side_count, 12u);
  EXPECT_LE(domain->pieces.size(), 13u);
  expect_sound(*domain, 24000 - 80 * 12, 2 * 1200 + 140 * 20 - 80 + 36 * 12 + 80);
  EXPECT_NEAR(outer_area(*domain, 7), 80, 1e-9);  // over its roof
  EXPECT_NEAR(outer_area(*domain, 8), 120, 1e-9);
  EXPECT_EQ(outer_area(*domain, 6), 0);
}

TEST(DomainCut, PiecesOutOfReachKeepTheirBits) {
  const geometry::Domain before = ell(10);
  const std::vector<geometry::Domain> easement{box({14, -5, -5}, {16, 30, 30})};
  const auto domain = exclude(before, easement);
  ASSERT_TRUE(domain.ok()) << domain.error().text();
  int same = 0;
  for (const geometry::Domain::Piece& piece : before.pieces) same += has_piece(*domain, piece) ? 1 : 0;
  EXPECT_EQ(same, 1);
  expect_sound(*domain, 3000 - 200, 2 * 280 + (80 - 4 + 20) * 10);
  expect_same_points(*domain, [&](const Point3& p) { return before.contains(p) && (p.x < 14 || p.x > 16); });
}

TEST(DomainCut, ExclusionsThatFillAnInnerFaceNameIt) {
  // What is taken away is one whole piece of the ell: the face between the pieces becomes a wall of the exclusion.
  const geometry::Domain before = ell(10);
  ASSERT_EQ(before.pieces.size(), 2u);
  const std::vector<geometry::Domain> gone{geometry::Domain(before.pieces[0].shape)};
  const auto domain = exclude(before, gone);
  ASSERT_TRUE(domain.ok()) << domain.error().text();
  ASSERT_EQ(domain->pieces.size(), 1u);
  EXPECT_EQ(domain->pieces[0].shape, before.pieces[1].shape);
  expect_sound(*domain, 1500, 2 * 150 + 10 * (20 + 10 + 10 + std::sqrt(200)));
  EXPECT_FALSE(exclude(before, std::vector<geometry::Domain>{box({-1, -1, -1}, {50, 50, 50})}).ok());
}

TEST(DomainCut, RandomExclusionsAgreeWithSamples) {
  for (std::uint64_t seed = 0; seed < 25; ++seed) {
    Random random(seed);
    SCOPED_TRACE(seed);
    const auto plan = star_ring(random, {0, 0, 0}, 5 + random.below(12), 8, 14);
    const geometry::Domain site = geometry::extrude_plan(plan, {}, 0, 12).value();
    std::vector<geometry::Domain> solids;
    for (int k = 0; k < 2; ++k) {
      const auto ring = star_ring(random, {random.uniform(-6, 6), random.uniform(-6, 6), 0}, 3 + random.below(5), 2, 5);
      solids.push_back(geometry::extrude_plan(ring, {}, random.uniform(-3, 2), random.uniform(4, 15)).value());
    }
    const auto domain = exclude(site, solids);
    ASSERT_TRUE(domain.ok()) << domain.error().text();
    EXPECT_LE(domain->pieces.size(), 150u);
    RecordProperty("pieces_" + std::to_string(seed), static_cast<int>(domain->pieces.size()));
    expect_same_points(*domain,
                       [&](const Point3& p) { return site.contains(p) && !solids[0].contains(p) && !solids[1].contains(p); });
    expect_sound(*domain, domain->volume, outer_area(*domain));
  }
}

}  // namespace
}  // namespace bl::test
