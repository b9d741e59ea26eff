// Balls that share a facet: hand cases, and the law that the solver's own cells have the facet at that distance.
#include "core/geometry/touching_balls.h"

#include <cmath>
#include <numbers>

#include "core/base/random.h"
#include "tests/core/geometry/geometry_support.h"

namespace bl::test {
namespace {

constexpr double kTouchPi = std::numbers::pi;

TEST(TouchingBalls, RadiusOfABall) {
  EXPECT_NEAR(geometry::ball_radius(4 * kTouchPi / 3), 1, 1e-15);
  EXPECT_NEAR(geometry::ball_radius(36 * kTouchPi * 1e-9), 3e-3, 1e-17);
  EXPECT_NEAR(geometry::ball_radius(36 * kTouchPi * 1e9), 3e3, 1e-9);
  EXPECT_EQ(geometry::ball_radius(0), 0);
  EXPECT_EQ(geometry::ball_radius(-5), 0);
}

TEST(TouchingBalls, WithoutAFacetTheyTouch) {
  EXPECT_NEAR(geometry::touching_distance(4 * kTouchPi / 3, 36 * kTouchPi, 0), 4, 1e-12);
  EXPECT_NEAR(geometry::touching_distance(4 * kTouchPi / 3, 0, 50), 1, 1e-12);
  EXPECT_EQ(geometry::touching_distance(0, 0, 50), 0);
}

// Two balls of radius 2 at distance 2: each keeps all but a cap of height 1, pi (3·2 - 1) / 3, and the facet has radius sqrt(3).
TEST(TouchingBalls, EqualBallsCutToHalfTheirRadius) {
  const double volume = 32 * kTouchPi / 3 - 5 * kTouchPi / 3;
  EXPECT_NEAR(geometry::touching_distance(volume, volume, 3 * kTouchPi), 2, 1e-12);
  // No larger facet is to be had: the distance stays.
  EXPECT_NEAR(geometry::touching_distance(volume, volume, 1000 * kTouchPi), 2, 1e-12);
}

TEST(TouchingBalls, LawTheCellsAtThatDistanceHaveTheVolumesAndTheFacet) {
  Random random(14, 3);
  for (int round = 0; round < 200; ++round) {
    const double volume = 10 + 5000 * random.uniform(), other = volume * (0.01 + 2 * random.uniform());
    // Within what the smaller one can offer.
    const double area = 1.2 * random.uniform() * std::pow(std::min(volume, other), 2.0 / 3) * 0.8;
    const double distance = geometry::touching_distance(volume, other, area);
    EXPECT_GE(distance, geometry::touching_distance(volume, other, area * 1.1));
    // The radii follow from the volumes alone: w = t² + a², t the distance of a centre from the facet.
    double low = 0, high = distance;
    const auto volume_at = [&](double t) {
      const double r = std::sqrt(t * t + area / kTouchPi);
      return kTouchPi * (2 * r * r * r / 3 + t * (r * r - t * t / 3));
    };
    for (int k = 0; k < 200; ++k) (volume_at((low + high) / 2) < volume ? low : high) = (low + high) / 2;
    const double rest = distance - low;
    const std::vector<geometry::PowerSite> sites{{{0, 0, 0}, low * low + area / kTouchPi},
                                                 {{distance, 0, 0}, rest * rest + area / kTouchPi}};
    const auto cells = cells_of(box({-100, -100, -100}, {150, 100, 100}), sites);
    EXPECT_NEAR(cells[0].volume, volume, 1e-6 * volume);
    EXPECT_NEAR(cells[1].volume, other, 1e-6 * other);
    ASSERT_FALSE(cells[0].facets.empty());
    EXPECT_NEAR(cells[0].facets.back().area, area, 1e-6 * area + 1e-9);
    // No centre is nearer to the facet than half of its radius.
    EXPECT_GE(low, 0.5 * std::sqrt(sites[0].weight) - 1e-9);
    EXPECT_GE(rest, 0.5 * std::sqrt(sites[1].weight) - 1e-9);
  }
}

}  // namespace
}  // namespace bl::test
