// Plans that are not convex, with holes: exact sums, few pieces, sides in their promised order, and what is refused.
#include "core/geometry/plan_ring.h"
#include "tests/core/geometry/domain_laws.h"

namespace bl::test {
namespace {

using Rings = std::vector<std::vector<Point3>>;

const std::vector<Point3> kEllPlan = ring_of({{0, 0}, {20, 0}, {20, 10}, {10, 10}, {10, 20}, {0, 20}});

void expect_plan(const std::vector<Point3>& plan, const Rings& holes, double bottom, double top) {
  const auto domain = geometry::extrude_plan(plan, holes, bottom, top);
  ASSERT_TRUE(domain.ok()) << domain.error().text();
  double area = std::abs(geometry::signed_area(plan)), length = geometry::perimeter(plan);
  for (const auto& hole : holes) {
    area -= std::abs(geometry::signed_area(hole));
    length += geometry::perimeter(hole);
  }
  const double height = top - bottom;
  expect_sound(*domain, area * height, 2 * area + length * height);
  EXPECT_NEAR(area_in_plan(*domain), area, 1e-7 * area);
  Random random(5);
  for (int k = 0; k < 1000; ++k) {
    const Point3 p = random_point(random, domain->minimum, domain->maximum);
    bool is_inside = geometry::ring_contains(plan, p);
    for (const auto& hole : holes) is_inside = is_inside && !geometry::ring_contains(hole, p);
    EXPECT_EQ(domain->contains(p), is_inside) << p.x << " " << p.y;
  }
}

TEST(DomainPlan, AnEllIsTwoPieces) {
  const auto domain = geometry::extrude_plan(kEllPlan, {}, 0, 5);
  ASSERT_TRUE(domain.ok());
  EXPECT_EQ(domain->pieces.size(), 2u);
  EXPECT_EQ(domain->side_count, 8u);
  const double lengths[] = {20, 10, 10, 10, 10, 20};
  EXPECT_NEAR(outer_area(*domain, 0), 300, 1e-9);
  EXPECT_NEAR(outer_area(*domain, 1), 300, 1e-9);
  for (std::uint32_t wall = 0; wall < 6; ++wall) EXPECT_NEAR(outer_area(*domain, 2 + wall), 5 * lengths[wall], 1e-9);
  expect_plan(kEllPlan, {}, 0, 5);
}

TEST(DomainPlan, AConvexPlanIsWhatItWas) {
  const auto plan = ring_of({{3, 0}, {9, 1}, {8, 7}, {2, 6}});
  const auto domain = geometry::extrude_plan(plan, {}, -2, 5);
  ASSERT_TRUE(domain.ok());
  EXPECT_EQ(*domain, geometry::Domain(geometry::extrude(plan, -2, 5).value()));
}

TEST(DomainPlan, WallsOfHolesFollowThoseOfTheRing) {
  const auto square = ring_of({{0, 0}, {12, 0}, {12, 12}, {0, 12}});
  const auto court = ring_of({{4, 5}, {8, 5}, {8, 9}, {4, 9}});
  const auto domain = geometry::extrude_plan(square, Rings{court}, 0, 10);
  ASSERT_TRUE(domain.ok());
  EXPECT_EQ(domain->side_count, 10u);
  EXPECT_LE(domain->pieces.size(), 5u);
  // Clockwise from (4, 5): the west wall of the court comes first, and its surface looks east.
  for (const geometry::Domain::Piece& piece : domain->pieces)
    for (std::size_t k = 0; k < piece.sides.size(); ++k)
      if (piece.sides[k] == 6) { EXPECT_NEAR(piece.shape.planes[k].normal.x, 1, 1e-12); }
  expect_plan(square, {court}, 0, 10);
}

TEST(DomainPlan, RandomPlansWithHolesAddUp) {
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    Random random(seed);
    const auto plan = star_ring(random, {1000, -500, 0}, 5 + random.below(30), 7, 14);
    Rings holes;
    const double turn = 6.28 * random.uniform();
    for (std::uint64_t h = 0, n = random.below(4); h < n; ++h) {
      const double angle = turn + 2.0943951 * static_cast<double>(h);
      holes.push_back(
          star_ring(random, {1000 + 3 * std::cos(angle), -500 + 3 * std::sin(angle), 0}, 3 + random.below(9), 0.4, 1.6));
      if (random.below(2) == 0) std::reverse(holes.back().begin(), holes.back().end());
    }
    SCOPED_TRACE(seed);
    expect_plan(plan, holes, 3, 15);
  }
}

TEST(DomainPlan, PiecesDoNotDependOnWhereTheRingBegins) {
  Random random(3);
  const auto plan = star_ring(random, {0, 0, 0}, 17, 5, 12);
  auto turned = plan;
  std::rotate(turned.begin(), turned.begin() + 5, turned.end());
  const auto domain = geometry::extrude_plan(plan, {}, 0, 4).value(), other = geometry::extrude_plan(turned, {}, 0, 4).value();
  ASSERT_EQ(domain.pieces.size(), other.pieces.size());
  for (std::size_t p = 0; p < domain.pieces.size(); ++p) EXPECT_EQ(domain.pieces[p].shape, other.pieces[p].shape);
  std::reverse(turned.begin(), turned.end());
  const auto reversed = geometry::extrude_plan(turned, {}, 0, 4).value();
  for (std::size_t p = 0; p < domain.pieces.size(); ++p) EXPECT_EQ(domain.pieces[p].shape, reversed.pieces[p].shape);
}

TEST(DomainPlan, ACombNeedsOnePieceForEachToothAndOneMore) {
  std::vector<Point3> comb{{0, 0, 0}, {90, 0, 0}};
  for (int tooth = 8; tooth >= 0; --tooth) {
    comb.push_back({10.0 * tooth + 6, 20, 0});
    comb.push_back({10.0 * tooth + 3, 20, 0});
    if (tooth > 0) comb.push_back({10.0 * tooth, 5, 0});
  }
  const auto domain = geometry::extrude_plan(comb, {}, 0, 3);
  ASSERT_TRUE(domain.ok()) << domain.error().text();
  EXPECT_LE(domain->pieces.size(), 18u);
  expect_plan(comb, {}, 0, 3);
}

TEST(DomainPlan, RefusesWithPlaces) {
  const auto text = [](const std::vector<Point3>& plan, const Rings& holes) {
    const auto domain = geometry::extrude_plan(plan, holes, 0, 3);
    return domain ? std::string("taken") : domain.error().text();
  };
  const auto square = ring_of({{0, 0}, {10, 0}, {10, 10}, {0, 10}});
  const auto hole = [](double x, double y, double side) {
    return ring_of({{x, y}, {x + side, y}, {x + side, y + side}, {x, y + side}});
  };
  EXPECT_EQ(text(square, {hole(2, 2, 2), hole(6, 6, 2)}), "taken");
  EXPECT_EQ(text(ring_of({{0, 0}, {10, 10}, {10, 0}, {0, 10}}), {}),
            "plan: the plan polygon crosses itself: side 0 and side 2 meet at (5.000, 5.000)");
  EXPECT_EQ(text(ring_of({{0, 0}, {10, 0}}), {}), "plan: a plan polygon needs at least 3 corners at different places, 2 found");
  EXPECT_EQ(text(ring_of({{0, 0}, {5, 0}, {10, 0}}), {}), "plan: the plan polygon has no area: its corners lie on one line");
  EXPECT_EQ(text(square, {hole(2, 2, 2), hole(20, 2, 2)}),
            "holes/1: the hole lies outside the plan polygon: its first corner is at (20.000, 2.000)");
  EXPECT_EQ(text(square, {hole(8, 3, 4)}),
            "holes/0: the hole meets the plan polygon at (10.000, 7.000): side 2 of the hole and side 1 of the plan polygon");
  EXPECT_EQ(text(square, {hole(0, 3, 4)}).substr(0, 37), "holes/0: the hole meets the plan poly");
  EXPECT_EQ(text(square, {hole(2, 2, 3), hole(4, 4, 3)}).substr(0, 32), "holes/1: the hole meets hole 0 a");
  EXPECT_EQ(text(square, {hole(2, 2, 5), hole(3, 3, 1)}),
            "holes/1: the hole and hole 0 lie one within the other: keep the larger");
  EXPECT_EQ(text(square, {ring_of({{2, 2}, {3, 3}})}), "holes/0: a hole needs at least 3 corners at different places, 2 found");
}

// A ball around a corner reaches into pieces that its site does not see: its shape is drawn inside the domain all the same.
TEST(DomainPlan, MeshesStayInTheDomainAndInTheirBalls) {
  const auto domain = geometry::extrude_plan(kEllPlan, Rings{ring_of({{2, 2}, {8, 2}, {8, 8}, {2, 8}})}, 0, 10).value();
  Random random(71);
  for (int round = 0; round < 30; ++round) {
    std::vector<geometry::PowerSite> sites;
    for (int i = 0; i < 4; ++i) sites.push_back({random_point(random, {-2, -2, 0}, {20, 20, 10}), random.uniform(9, 150)});
    geometry::CellOptions options;
    options.tessellation_depth = 3;
    const auto cells = power_cells(domain, sites, options).value();
    for (std::size_t i = 0; i < cells.size(); ++i) {
      if (!cells[i].mesh) continue;
      for (const Point3& v : cells[i].mesh->vertices) {
        ASSERT_TRUE(domain.contains(v, 1e-6)) << "round " << round << ", site " << i << ": " << v.x << ", " << v.y << ", " << v.z;
        ASSERT_LE(distance(v, sites[i].position), std::sqrt(sites[i].weight) * (1 + 1e-9)) << round;
      }
    }
  }
}

}  // namespace
}  // namespace bl::test
