// Shadows of boxes by rays, against a loop over all triangles of another make; sun hours and losses that can be done by hand.
#include "core/sun/shadow_scene.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "core/sun/sun_hours.h"
#include "tests/core/sun/boxes.h"

namespace bl::sun {
namespace {

Vector3 random_sun(Random& random) {
  SunPlace place;
  return scene_direction(place, random.uniform(0, 360), random.uniform(0.5, 89));
}

TEST(ShadowScene, AThousandRandomBoxesAgainstEveryTriangle) {
  const auto boxes = random_boxes(1000, 1);
  const auto scene = ShadowScene::build(boxes);
  ASSERT_TRUE(scene.ok());
  EXPECT_EQ(scene->triangles(), 12000u);
  Random random(2);
  int shaded = 0, differences = 0, casters = 0;
  std::vector<std::uint32_t> found;
  constexpr int kRays = 4000;
  for (int i = 0; i < kRays; ++i) {
    const Point3 origin{random.uniform(-520, 520), random.uniform(-520, 520), i % 3 == 0 ? 0 : random.uniform(0, 40)};
    const Vector3 toward = random_sun(random);
    std::vector<std::uint32_t> wanted;
    for (std::uint32_t k = 0; k < boxes.size(); ++k)
      if (plain_hit(origin, toward, *boxes[k], ShadowScene::kStart)) wanted.push_back(k);
    scene->blockers(origin, toward, found);
    differences += found != wanted ? 1 : 0;
    shaded += wanted.empty() ? 0 : 1;
    casters += static_cast<int>(wanted.size());
  }
  std::printf("%d rays among 1000 boxes: %d shaded by %d casters in all, %d differ from the loop over all triangles\n", kRays,
              shaded, casters, differences);
  EXPECT_GT(shaded, kRays / 5);
  EXPECT_EQ(differences, 0);
}

// Rays through diagonals, edges and corners that are not on the outline, exactly or by a rounding: a crack would let the sun
// through.
TEST(ShadowScene, NoSunThroughEdgesAndCorners) {
  const Mesh box = box_mesh({0, 0, 0}, 10, 10, 10);
  const auto scene = ShadowScene::build(std::vector<MeshPointer>{std::make_shared<const Mesh>(box)});
  for (int x = -4; x <= 4; ++x)
    for (int y = -4; y <= 4; ++y)
      for (const Vector3& toward : {Vector3{0, 0, 1}, Vector3{1, 0, 0}, Vector3{0, -1, 0}}) {
        const Point3 inside{x * 1.0, y * 1.0, y + 5.0};  // on the diagonals of all faces where x = ± y
        EXPECT_TRUE(is_shaded(*scene, inside - toward * 100.0, toward)) << x << " " << y;
      }
  Random random(4);
  for (int i = 0; i < 20000; ++i) {
    // Seen from below, west and south, the corner 0 and its three edges lie in the middle.
    Vector3 toward{random.uniform(0.1, 1), random.uniform(0.1, 1), random.uniform(0.1, 1)};
    toward = toward / norm(toward);
    const Point3 corner = box.vertices[0], other = box.vertices[i % 3 == 0 ? 1 : i % 3 == 1 ? 3 : 4];
    const Point3 aim = i % 5 == 0 ? corner : corner + (other - corner) * random.uniform(0, 0.9);
    EXPECT_TRUE(is_shaded(*scene, aim - toward * random.uniform(1, 300), toward)) << i;
  }
}

TEST(ShadowScene, FarFromTheOriginNothingIsLost) {
  Random random(5);
  const Point3 far{155000.25, 463000.5, 10};
  std::vector<MeshPointer> near_boxes = random_boxes(60, 6, 80), far_boxes;
  for (const MeshPointer& box : near_boxes) {
    Mesh moved = *box;
    for (Point3& vertex : moved.vertices) vertex += far;
    far_boxes.push_back(std::make_shared<const Mesh>(std::move(moved)));
  }
  const auto here = ShadowScene::build(near_boxes), there = ShadowScene::build(far_boxes);
  int differences = 0;
  for (int i = 0; i < 20000; ++i) {
    const Point3 origin{random.uniform(-90, 90), random.uniform(-90, 90), 0};
    const Vector3 toward = random_sun(random);
    differences += is_shaded(*here, origin, toward) != is_shaded(*there, origin + far, toward) ? 1 : 0;
    // A point far outside looks back through the whole scene.
    const Point3 outside = origin - toward * 1e6;
    differences += is_shaded(*here, outside, toward) !=
                           [&] {
                             for (const MeshPointer& box : near_boxes)
                               if (plain_hit(outside, toward, *box, 0)) return true;
                             return false;
                           }()
                       ? 1
                       : 0;
  }
  EXPECT_LE(differences, 2);  // what moving the corners itself rounds away
}

TEST(ShadowScene, MasksLeaveCastersOut) {
  const std::vector<MeshPointer> boxes = {std::make_shared<const Mesh>(box_mesh({0, 10, 0}, 4, 4, 20)),
                                          std::make_shared<const Mesh>(box_mesh({0, 20, 0}, 4, 4, 40)), nullptr};
  const auto scene = ShadowScene::build(boxes);
  EXPECT_EQ(scene->casters(), 3u);
  const Vector3 toward = Vector3{0, 1, 1} / std::sqrt(2.0);
  std::vector<std::uint32_t> found;
  scene->blockers({0, 0, 0}, toward, found);
  EXPECT_EQ(found, (std::vector<std::uint32_t>{0, 1}));
  const std::vector<std::uint8_t> second{0, 1, 1}, none{0, 0, 0};
  scene->blockers({0, 0, 0}, toward, found, second);
  EXPECT_EQ(found, (std::vector<std::uint32_t>{1}));
  EXPECT_TRUE(is_shaded(*scene, {0, 0, 0}, toward, second));
  EXPECT_FALSE(is_shaded(*scene, {0, 0, 0}, toward, none));
  EXPECT_FALSE(is_shaded(*ShadowScene::build({}), {0, 0, 0}, toward));
  Mesh broken = *boxes[0];
  broken.vertices[3].x = std::nan("");
  EXPECT_EQ(ShadowScene::build(std::vector<MeshPointer>{boxes[1], std::make_shared<const Mesh>(broken)}).error().place, "1");
}

TEST(ShadowScene, TheShadowOfTenMetresIsTenMetresLong) {
  // Sun in the south at 45 degrees; the box stands with its north face at y = 0, so its shadow ends at y = 10.
  const auto scene = ShadowScene::build(std::vector<MeshPointer>{std::make_shared<const Mesh>(box_mesh({0, -2.5, 0}, 8, 5, 10))});
  for (const double azimuth : {180.0, 150.0, 230.0}) {
    const Vector3 toward = scene_direction(SunPlace{}, azimuth, 45);
    // Along the ground, away from the sun, through the middle of the edge that throws the end of the shadow.
    const double reach = 10;
    const Vector3 away = Vector3{-toward.x, -toward.y, 0} / std::sqrt(toward.x * toward.x + toward.y * toward.y);
    const Point3 under{0, 0, 0};  // below the middle of the upper north edge
    EXPECT_TRUE(is_shaded(*scene, under + away * (reach - 0.0005), toward)) << azimuth;
    EXPECT_FALSE(is_shaded(*scene, under + away * (reach + 0.0005), toward)) << azimuth;
  }
}

// --- Sun hours ------------------------------------------------------------------------------------------------------

std::vector<SunMoment> march_day(double lowest = 0, double step = 600) {
  SunPlace place;
  place.utc_offset = 3600;
  const DayNumber day = day_number({2026, 3, 21});
  return sun_moments(place, {.first = day, .last = day, .step = step, .lowest_altitude = lowest}).value();
}

TEST(SunHours, AFreeRoofHasTheWholeDay) {
  const auto scene = ShadowScene::build({});
  const SunGrid roof = sun_grid({0, 0, 10}, {10, 0, 0}, {0, 8, 0}, 4, 1000);
  EXPECT_EQ(roof.columns, 5u);
  EXPECT_EQ(roof.rows, 4u);
  EXPECT_EQ(roof.points.front().place, (Point3{-8, -6, 10}));
  EXPECT_EQ(roof.points.front().normal, (Vector3{0, 0, 1}));
  SunPlace place;
  place.utc_offset = 3600;
  const double day_length = sun_day(place, day_number({2026, 3, 21})).day_length;
  const SunHours all = sun_hours(*scene, roof.points, march_day(kHorizon));
  const SunHours high = sun_hours(*scene, roof.points, march_day(10));
  double below = 0;  // between the horizon and ten degrees
  for (const SunMoment& moment : march_day(kHorizon, 1))
    if (moment.altitude < 10) below += moment.seconds;
  // The sun below the level of the roof, but above the horizon of sunrise, does not reach it: that is the refraction's few
  // minutes.
  double level = 0;
  for (const SunMoment& moment : march_day(kHorizon, 1))
    if (!(moment.toward.z > 0)) level += moment.seconds;
  for (const double seconds : high.seconds) EXPECT_NEAR(seconds, day_length - below, 1);
  for (const double seconds : all.seconds) EXPECT_NEAR(seconds, day_length - level, 600);
  EXPECT_NEAR(high.possible, possible_sun(march_day(10)), 1e-6);
}

TEST(SunHours, ANorthWallHasNoneInMarchAndAWallOfTwoSidesSharesTheDay) {
  const auto scene = ShadowScene::build({});
  const SunGrid north = sun_grid({0, 0, 5}, {-5, 0, 0}, {0, 0, 3}, 1, 1000);
  EXPECT_NEAR(north.points[0].normal.y, 1, 1e-12);
  const SunGrid south = sun_grid({0, 0, 5}, {5, 0, 0}, {0, 0, 3}, 1, 1000);
  const SunHours dark = sun_hours(*scene, north.points, march_day()), bright = sun_hours(*scene, south.points, march_day());
  EXPECT_NEAR(dark.possible + bright.possible, possible_sun(march_day()), 1e-6);
  EXPECT_LT(dark.possible, 900);  // the day after the equinox
}

// A screen without end in the south takes all sun below its edge; two, one behind the other, share what both take.
TEST(SunHours, LossesByHand) {
  const auto screen = [](double y, double height) { return std::make_shared<const Mesh>(box_mesh({0, y, 0}, 1e5, 0.1, height)); };
  const std::vector<SunPoint> point{{{0, 0, 0}, {0, 0, 1}}};
  const auto moments = march_day(5);
  const double all = possible_sun(moments);
  const auto one = ShadowScene::build(std::vector<MeshPointer>{screen(-10, 10)});
  const SunHours alone = sun_hours(*one, point, moments);
  EXPECT_NEAR(alone.seconds[0] + alone.casters[0].lost, all, 1e-6);
  EXPECT_EQ(alone.casters[0].lost, alone.casters[0].shared);
  // The farther one is as high as seen from the point: each takes the same, and neither would give any back alone.
  const auto two = ShadowScene::build(std::vector<MeshPointer>{screen(-10, 10), screen(-20, 20)});
  const SunHours both = sun_hours(*two, point, moments);
  EXPECT_NEAR(both.casters[0].lost + both.casters[1].lost, 0, 700);  // but for the moments between the two edges
  EXPECT_NEAR(both.casters[0].shared + both.casters[1].shared + both.seconds[0], all, 1e-6);
  EXPECT_NEAR(both.casters[0].shared, both.casters[1].shared, 700);
  // A farther one that is lower takes nothing alone, but its part where both stand in the way.
  const auto lower = ShadowScene::build(std::vector<MeshPointer>{screen(-10, 10), screen(-20, 5)});
  const SunHours less = sun_hours(*lower, point, moments);
  EXPECT_EQ(less.casters[1].lost, 0);
  EXPECT_NEAR(less.casters[0].lost + 2 * less.casters[1].shared + less.seconds[0], all, 1e-6);
}

TEST(SunHours, TheSameBitsWithAnyNumberOfThreads) {
  const auto boxes = random_boxes(80, 9, 60);
  const auto scene = ShadowScene::build(boxes), again = ShadowScene::build(boxes);
  const SunGrid grid = sun_grid({0, 0, 0}, {60, 0, 0}, {0, 60, 0}, 5, 10000);
  const auto moments = march_day(5, 1200);
  ThreadPool three(3);
  const SunHours one = sun_hours(*scene, grid.points, moments), many = sun_hours(*again, grid.points, moments, {}, &three);
  EXPECT_EQ(one.seconds, many.seconds);
  EXPECT_EQ(one.possible, many.possible);
  double shared = 0, mean = 0;
  for (std::size_t k = 0; k < one.casters.size(); ++k) {
    EXPECT_EQ(one.casters[k].lost, many.casters[k].lost);
    EXPECT_EQ(one.casters[k].shared, many.casters[k].shared);
    EXPECT_LE(one.casters[k].lost, one.casters[k].shared + 1e-9);
    shared += one.casters[k].shared;
  }
  for (const double seconds : one.seconds) mean += seconds / static_cast<double>(one.seconds.size());
  EXPECT_NEAR(mean + shared, one.possible, 1e-6);
  // Taking one caster away gives back what it was said to take.
  std::size_t worst = 0;
  for (std::size_t k = 0; k < one.casters.size(); ++k)
    if (one.casters[k].lost > one.casters[worst].lost) worst = k;
  std::vector<std::uint8_t> mask(boxes.size(), 1);
  mask[worst] = 0;
  double without = 0;
  for (const double seconds : sun_hours(*scene, grid.points, moments, mask).seconds)
    without += seconds / static_cast<double>(grid.points.size());
  EXPECT_NEAR(without - mean, one.casters[worst].lost, 1e-6);
}

}  // namespace
}  // namespace bl::sun
