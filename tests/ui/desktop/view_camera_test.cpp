// The camera's arithmetic: what is seen where, what keeps its place while zooming, and text forth and back.
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "ui/desktop/view/camera.h"
#include "ui/desktop/view/view_builder.h"
#include "ui/desktop/view/view_scene.h"

namespace bl::desktop {
namespace {

constexpr double kWidth = 800, kHeight = 600;

TEST(Camera, SeesItsTargetInTheMiddle) {
  for (const bool is_parallel : {false, true}) {
    Camera camera;
    camera.target = {10, 20, 5};
    camera.is_parallel = is_parallel;
    const Seen at = camera.project(camera.target, kWidth, kHeight);
    EXPECT_NEAR(at.x, kWidth / 2, 1e-9);
    EXPECT_NEAR(at.y, kHeight / 2, 1e-9);
    EXPECT_NEAR(at.depth, camera.distance, 1e-9);
  }
}

TEST(Camera, LinesOfSightGoThroughWhatIsSeenThere) {
  for (const bool is_parallel : {false, true})
    for (const double elevation : {-1.2, 0.0, 0.7, std::numbers::pi / 2}) {
      Camera camera;
      camera.elevation = elevation;
      camera.is_parallel = is_parallel;
      const Point3 point{12, -7, 9};
      const Seen at = camera.project(point, kWidth, kHeight);
      const Ray ray = camera.ray(at.x, at.y, kWidth, kHeight);
      EXPECT_NEAR(norm(cross(point - ray.origin, ray.direction)), 0, 1e-6);
      EXPECT_NEAR(norm(ray.direction), 1, 1e-12);
    }
}

TEST(Camera, MatrixAgreesWithProject) {
  for (const bool is_parallel : {false, true}) {
    Camera camera;
    camera.is_parallel = is_parallel;
    const Point3 origin{100, 50, 0}, point{20, 30, 8};
    const Matrix m = camera.matrix(origin, kWidth / kHeight, 1, 1000);
    const Vector3 p = point - origin;
    const auto row = [&](std::size_t r) { return m[r] * p.x + m[4 + r] * p.y + m[8 + r] * p.z + m[12 + r]; };
    const Seen at = camera.project(point, kWidth, kHeight);
    EXPECT_NEAR((0.5 * row(0) / row(3) + 0.5) * kWidth, at.x, 0.01);
    EXPECT_NEAR((0.5 - 0.5 * row(1) / row(3)) * kHeight, at.y, 0.01);
    EXPECT_GT(row(2) / row(3), -1);
    EXPECT_LT(row(2) / row(3), 1);
  }
}

TEST(Camera, PlanHasNorthUpAndSouthLooksNorth) {
  Camera plan;
  plan.azimuth = -std::numbers::pi / 2;
  plan.elevation = std::numbers::pi / 2;
  EXPECT_NEAR(distance(plan.up(), {0, 1, 0}), 0, 1e-12);
  EXPECT_NEAR(distance(plan.right(), {1, 0, 0}), 0, 1e-12);
  Camera south;
  south.azimuth = -std::numbers::pi / 2;
  south.elevation = 0;
  EXPECT_NEAR(distance(south.forward(), {0, 1, 0}), 0, 1e-12);
}

TEST(Camera, ZoomKeepsThePlaceUnderTheMouse) {
  for (const bool is_parallel : {false, true}) {
    Camera camera;
    camera.is_parallel = is_parallel;
    const Point3 place{30, -12, 4};
    const Seen before = camera.project(place, kWidth, kHeight);
    camera.zoom(0.6, place);
    const Seen after = camera.project(place, kWidth, kHeight);
    EXPECT_NEAR(before.x, after.x, 1e-6);
    EXPECT_NEAR(before.y, after.y, 1e-6);
  }
}

TEST(Camera, ChangesTakeTheShorterWay) {
  Camera a, b;
  a.azimuth = 3;
  b.azimuth = -3;
  EXPECT_GT(std::abs(between(a, b, 0.5).azimuth), 3);
  EXPECT_EQ(between(a, b, 1), b);
}

TEST(Camera, ComesBackFromItsText) {
  Camera camera;
  camera.target = {1.5, -2.25, 3};
  camera.azimuth = 0.5;
  camera.is_parallel = true;
  const Camera back = camera_from_json_text(to_json_text(camera), Camera());
  EXPECT_NEAR(distance(back.target, camera.target), 0, 1e-12);
  EXPECT_NEAR(back.azimuth, 0.5, 1e-12);
  EXPECT_TRUE(back.is_parallel);
  // Anything else leaves a camera that can be looked through.
  for (const char* text : {"", "[]", "{\"target\": [1, null, 1e999], \"distance\": -5}", "{\"azimuth\": \"north\"}"}) {
    const Camera odd = camera_from_json_text(text, Camera());
    EXPECT_TRUE(is_finite(odd.target)) << text;
    EXPECT_GT(odd.distance, 0) << text;
  }
}

TEST(ViewScene, DividesAsFinelyAsItMay) {
  EXPECT_EQ(depth_within(100, 100, 4), 0);
  EXPECT_EQ(depth_within(100, 1600, 4), 2);
  EXPECT_EQ(depth_within(100, 1000000, 4), 4);
  EXPECT_EQ(depth_within(0, 0, 4), 0);
}

TEST(ViewScene, RoundDistancesAreOneTwoOrFive) {
  EXPECT_DOUBLE_EQ(round_distance(13), 10);
  EXPECT_DOUBLE_EQ(round_distance(21), 20);
  EXPECT_DOUBLE_EQ(round_distance(0.06), 0.05);
  EXPECT_DOUBLE_EQ(round_distance(std::nan("")), 1);
}

}  // namespace
}  // namespace bl::desktop
