// Who stands on what: by hand in a box, on a step, on a pile, between two others.
#include "core/geometry/standing.h"

#include "core/geometry/site_domain.h"
#include "tests/core/geometry/geometry_support.h"

namespace bl::test {
namespace {

std::vector<geometry::Stance> stances(const geometry::Domain& domain, const std::vector<geometry::PowerSite>& sites,
                                      std::vector<geometry::Standing> rules = {}) {
  rules.resize(sites.size(), geometry::Standing::stack);
  return stances_of(domain, sites, power_cells(domain, sites).value(), rules);
}

const geometry::Domain kStandingRoom = box({0, 0, 2}, {60, 20, 40});

TEST(Standing, TheGroundUnderAPoint) {
  EXPECT_NEAR(ground_under(kStandingRoom, {5, 5, 10}), 2, 1e-12);
  EXPECT_NEAR(ground_under(kStandingRoom, {5, 5, -10}), 2, 1e-12);
  EXPECT_NEAR(ground_under(kStandingRoom, {-5, 5, 10}), 2, 1e-12);
}

// A ball of radius 4 at 9 m over a floor at 2 m hangs 3 m above it, and has 3 m to sink.
TEST(Standing, ABallInTheAirHangs) {
  const auto found = stances(kStandingRoom, {{{10, 10, 9}, 16}});
  EXPECT_NEAR(found[0].hang, 3, 1e-9);
  EXPECT_NEAR(found[0].drop, 3, 1e-9);
  EXPECT_EQ(found[0].stands_on, geometry::Stance::kNothing);
}

TEST(Standing, ABallInTheFloorStands) {
  const auto found = stances(kStandingRoom, {{{10, 10, 5}, 16}});
  EXPECT_EQ(found[0].hang, 0);
  EXPECT_NEAR(found[0].drop, -1, 1e-9);
  EXPECT_EQ(found[0].stands_on, geometry::Stance::kGround);
}

// Radius 4 on radius 4, 7 m above each other: sunk in by a metre. The third touches nothing: its way down is to the second.
TEST(Standing, APileStandsAndWhatIsAboveItHangs) {
  const std::vector<geometry::PowerSite> sites{{{10, 10, 5}, 16}, {{10, 10, 12}, 16}, {{10, 10, 25}, 16}};
  const auto found = stances(kStandingRoom, sites);
  EXPECT_EQ(found[1].stands_on, 0);
  EXPECT_EQ(found[1].hang, 0);
  EXPECT_NEAR(found[1].drop, -1, 1e-9);
  EXPECT_EQ(found[2].stands_on, geometry::Stance::kNothing);
  EXPECT_NEAR(found[2].hang, 19, 1e-9);
  EXPECT_NEAR(found[2].drop, 5, 1e-9);
}

// A pile without a foot hangs as a whole: its lowest ball has a way to go, and what is above it presses on by a tenth of its
// radius at most.
TEST(Standing, APileInTheAirHangsAsAWhole) {
  const auto found = stances(kStandingRoom, {{{10, 10, 12}, 16}, {{10, 10, 19}, 16}});
  EXPECT_NEAR(found[0].hang, 6, 1e-9);
  EXPECT_GT(found[1].hang, 12);
  EXPECT_NEAR(found[0].drop, 6, 1e-9);
  EXPECT_GT(found[1].drop, 0);
  EXPECT_LE(found[1].drop, 0.4);
}

TEST(Standing, WhoMustStandOnTheGroundDoesNotStandOnOthers) {
  const auto found =
      stances(kStandingRoom, {{{10, 10, 5}, 16}, {{10, 10, 12}, 16}}, {geometry::Standing::stack, geometry::Standing::ground});
  EXPECT_EQ(found[1].stands_on, 0);
  // Its lowest point is the facet half way between the two, 6.5 m above the floor.
  EXPECT_NEAR(found[1].hang, 6.5, 1e-9);
  EXPECT_NEAR(found[1].drop, 6, 1e-9);
}

// Beside each other is not on each other; but two that stand may hold a bridge between them.
TEST(Standing, ABridgeIsHeldByTwo) {
  const std::vector<geometry::PowerSite> sites{{{10, 10, 8}, 64}, {{20, 10, 8}, 9}, {{30, 10, 8}, 64}};
  EXPECT_NEAR(stances(kStandingRoom, sites)[1].hang, 3, 1e-9);
  const auto held = stances(kStandingRoom, sites, {geometry::Standing::stack, geometry::Standing::bridge});
  EXPECT_EQ(held[1].hang, 0);
  EXPECT_LT(held[1].drop, 0);
  const auto alone = stances(kStandingRoom, {sites[0], sites[1]}, {geometry::Standing::stack, geometry::Standing::bridge});
  EXPECT_NEAR(alone[1].hang, 3, 1e-9);
}

TEST(Standing, SitesWithoutVolumeDoNotHang) {
  const auto found = stances(kStandingRoom, {{{10, 10, 9}, -1}, {{30, 10, 9}, 16}});
  EXPECT_EQ(found[0].hang, 0);
  EXPECT_EQ(found[0].drop, 0);
}

// A building of 10 m stays in the right half: its roof is the ground there.
TEST(Standing, ARoofIsGround) {
  const geometry::SitePlan plan{{{0, 0, 0}, {40, 0, 0}, {40, 20, 0}, {0, 20, 0}},
                                {},
                                0,
                                40,
                                {},
                                {{{{20, 0, 0}, {40, 0, 0}, {40, 20, 0}, {20, 20, 0}}, 0, 10}}};
  const auto domain = site_domain(plan);
  ASSERT_TRUE(domain);
  EXPECT_NEAR(ground_under(*domain, {10, 10, 20}), 0, 1e-12);
  EXPECT_NEAR(ground_under(*domain, {30, 10, 20}), 10, 1e-12);
  const auto found = stances(*domain, {{{30, 10, 13}, 16}, {{10, 10, 13}, 16}});
  EXPECT_EQ(found[0].stands_on, geometry::Stance::kGround);
  EXPECT_NEAR(found[1].hang, 9, 1e-9);
}

}  // namespace
}  // namespace bl::test
