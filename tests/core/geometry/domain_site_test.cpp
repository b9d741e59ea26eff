// Sites as people give them: plans with holes, steps and what stays, against the general makers and against samples.
#include "core/geometry/plan_ring.h"
#include "core/geometry/site_domain.h"
#include "tests/core/geometry/domain_laws.h"

namespace bl::test {
namespace {

std::vector<Point3> rectangle(double x, double y, double width, double depth) {
  return ring_of({{x, y}, {x + width, y}, {x + width, y + depth}, {x, y + depth}});
}

bool is_in(const geometry::PlanSolid& solid, const Point3& p) {
  return p.z > solid.bottom && p.z < solid.top && geometry::ring_contains(solid.ring, p);
}

bool is_in(const geometry::SitePlan& site, const Point3& p) {
  bool inside = is_in(geometry::PlanSolid{site.plan, site.bottom, site.top}, p);
  for (const auto& hole : site.holes) inside = inside && !geometry::ring_contains(hole, p);
  for (const geometry::PlanSolid& step : site.steps) inside = inside || is_in(step, p);
  for (const geometry::PlanSolid& gone : site.exclusions) inside = inside && !is_in(gone, p);
  return inside;
}

void expect_samples(const geometry::Domain& domain, const geometry::SitePlan& site) {
  Random random(21);
  for (int k = 0; k < 3000; ++k) {
    const Point3 p = random_point(random, domain.minimum, domain.maximum);
    EXPECT_EQ(domain.contains(p), is_in(site, p)) << p.x << " " << p.y << " " << p.z;
  }
}

TEST(DomainSite, WithoutStepsAndExclusionsItIsThePlan) {
  const geometry::SitePlan site{rectangle(0, 0, 30, 20), {rectangle(10, 5, 5, 5)}, 0, 9, {}, {}};
  EXPECT_EQ(site_domain(site).value(), geometry::extrude_plan(site.plan, site.holes, 0, 9).value());
}

TEST(DomainSite, AStepAndABuildingThatStays) {
  const geometry::SitePlan site{
      rectangle(0, 0, 40, 30), {}, 0, 20, {{rectangle(30, 0, 10, 10), 0, 50}}, {{rectangle(10, 10, 10, 8), -5, 12}}};
  const auto domain = site_domain(site);
  ASSERT_TRUE(domain.ok()) << domain.error().text();
  EXPECT_LE(domain->pieces.size(), 16u);
  EXPECT_EQ(domain->side_count, 18u);
  expect_sound(*domain, 24000 + 3000 - 960, 2 * 1200 + 140 * 20 + 40 * 30 - 80 + 36 * 12 + 80);
  EXPECT_NEAR(outer_area(*domain, 1), 1100, 1e-9);
  EXPECT_NEAR(outer_area(*domain, 7), 100, 1e-9);   // the top of the step
  EXPECT_NEAR(outer_area(*domain, 8), 300, 1e-9);   // its wall on the street, above that of the plan
  EXPECT_EQ(outer_area(*domain, 12), 0);            // the building's underside is out of reach
  EXPECT_NEAR(outer_area(*domain, 13), 80, 1e-9);   // over its roof
  EXPECT_NEAR(outer_area(*domain, 14), 120, 1e-9);  // its south wall
  expect_samples(*domain, site);
}

TEST(DomainSite, FullHeightExclusionsAreCourts) {
  const geometry::SitePlan site{rectangle(0, 0, 40, 30), {}, 0, 20, {}, {{rectangle(10, 10, 10, 8), -5, 25}}};
  const auto domain = site_domain(site);
  ASSERT_TRUE(domain.ok()) << domain.error().text();
  EXPECT_LE(domain->pieces.size(), 5u);
  expect_sound(*domain, 24000 - 1600, 2 * 1120 + 140 * 20 + 36 * 20);
}

TEST(DomainSite, AgreesWithTheGeneralMakers) {
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    geometry::SitePlan site{star_ring(random, {0, 0, 0}, 5 + random.below(15), 8, 14), {}, 0, 12, {}, {}};
    if (seed % 2 == 0) site.holes.push_back(star_ring(random, {0, 0, 0}, 3 + random.below(5), 0.5, 2));
    for (std::uint64_t k = 0, n = random.below(3); k < n; ++k)
      site.steps.push_back({star_ring(random, {random.uniform(-9, 9), random.uniform(-9, 9), 0}, 3 + random.below(5), 2, 6), 0,
                            random.uniform(5, 30)});
    for (std::uint64_t k = 0, n = 1 + random.below(3); k < n; ++k)
      site.exclusions.push_back({star_ring(random, {random.uniform(-8, 8), random.uniform(-8, 8), 0}, 3 + random.below(7), 1, 5),
                                 random.uniform(-3, 3), random.uniform(4, 20)});
    const auto domain = site_domain(site);
    ASSERT_TRUE(domain.ok()) << domain.error().text();
    std::vector<geometry::Domain> parts{geometry::extrude_plan(site.plan, site.holes, 0, 12).value()};
    for (const geometry::PlanSolid& step : site.steps)
      parts.push_back(geometry::extrude_plan(step.ring, {}, step.bottom, step.top).value());
    const auto whole = unite(parts);
    ASSERT_TRUE(whole.ok()) << whole.error().text();
    const auto other = without_solids(*whole, site.exclusions);
    ASSERT_TRUE(other.ok()) << other.error().text();
    EXPECT_EQ(domain->side_count, other->side_count);
    expect_sound(*domain, other->volume, outer_area(*other));
    for (std::uint32_t side = 0; side < domain->side_count; ++side)
      EXPECT_NEAR(outer_area(*domain, side), outer_area(*other, side), 1e-6) << "side " << side;
    expect_samples(*domain, site);
    RecordProperty("pieces_" + std::to_string(seed), static_cast<int>(domain->pieces.size()));
    EXPECT_LE(domain->pieces.size(), 200u);
  }
}

TEST(DomainSite, RowsOfHousesThatShareWalls) {
  geometry::SitePlan site{rectangle(0, 0, 100, 50), {}, 0, 30, {}, {}};
  for (int house = 0; house < 10; ++house) site.exclusions.push_back({rectangle(10.0 * house, 0, 10, 12), 0, 6.0 + 0.5 * house});
  const auto domain = site_domain(site);
  ASSERT_TRUE(domain.ok()) << domain.error().text();
  double gone = 0;
  for (const geometry::PlanSolid& house : site.exclusions) gone += 120 * house.top;
  EXPECT_NEAR(domain->volume, 150000 - gone, 1e-4);
  EXPECT_LE(domain->pieces.size(), 40u);
  expect_sound(*domain, domain->volume, outer_area(*domain));
  expect_samples(*domain, site);
}

TEST(DomainSite, RefusesWithPlaces) {
  const auto text = [](const geometry::SitePlan& site) {
    const auto domain = site_domain(site);
    return domain ? std::string("taken") : domain.error().text();
  };
  const auto plan = rectangle(0, 0, 10, 10);
  EXPECT_EQ(text({plan, {}, 0, 5, {{rectangle(2, 2, 4, 4), 0, 9}, {rectangle(2, 2, 4, 4), 3, 3}}, {}}),
            "steps/1: the top of the boundary (3 m) has to lie above its bottom (3 m)");
  EXPECT_EQ(text({plan, {}, 0, 5, {}, {{ring_of({{0, 0}, {4, 4}, {4, 0}, {0, 4}}), 0, 5}}}),
            "exclusions/0: the plan polygon crosses itself: side 0 and side 2 meet at (2.000, 2.000)");
  EXPECT_EQ(text({plan, {}, 0, 5, {}, {{rectangle(-1, -1, 20, 20), -1, 6}}}),
            "exclusions: the exclusions take away the whole boundary");
}

}  // namespace
}  // namespace bl::test
