// Outlines, bodies of shade and envelopes, against rays and against what can be done by hand.
#include "core/sun/shadow_shape.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "core/sun/sun_place.h"
#include "tests/core/sun/boxes.h"

namespace bl::sun {
namespace {

double area_of(const std::vector<Point3>& ring) {
  double twice = 0;
  for (std::size_t i = 0, j = ring.size() - 1; i < ring.size(); j = i++) twice += ring[j].x * ring[i].y - ring[j].y * ring[i].x;
  return twice / 2;
}

bool holds(const std::vector<Point3>& ring, const Point3& p, double margin) {
  for (std::size_t i = 0, j = ring.size() - 1; i < ring.size(); j = i++) {
    const Vector3 edge = ring[i] - ring[j], to = p - ring[j];
    if (edge.x * to.y - edge.y * to.x < margin * norm(edge)) return false;
  }
  return true;
}

TEST(ShadowShape, TenMetresAtFortyFiveDegreesAreTenMetres) {
  const Mesh box = box_mesh({0, 0, 0}, 8, 6, 10);
  for (const double azimuth : {180.0, 90.0, 217.0, 359.0}) {
    const Vector3 toward = scene_direction(SunPlace{}, azimuth, 45);
    const std::vector<Point3> outline = shadow_outline(box, toward, 0);
    const Vector3 away = Vector3{-toward.x, -toward.y, 0} / std::hypot(toward.x, toward.y);
    double box_reach = -1e9, reach = -1e9;
    for (const Point3& corner : box.vertices) box_reach = std::max(box_reach, dot(corner, away));
    for (const Point3& corner : outline) reach = std::max(reach, dot(corner, away));
    EXPECT_NEAR(reach - box_reach, 10, 1e-9) << azimuth;
  }
  // Sun in the south: 8 m wide, 6 m of box and 10 m of shadow deep.
  EXPECT_NEAR(area_of(shadow_outline(box, scene_direction(SunPlace{}, 180, 45), 0)), 8 * 16, 1e-9);
  EXPECT_TRUE(shadow_outline(box, scene_direction(SunPlace{}, 180, 0), 0).empty());
  EXPECT_TRUE(shadow_outline(box, scene_direction(SunPlace{}, 180, 45), 10.5).empty());
  // Ground half way up: half the shadow.
  EXPECT_NEAR(area_of(shadow_outline(box, scene_direction(SunPlace{}, 180, 45), 5)), 8 * 11, 1e-9);
}

TEST(ShadowShape, OutlinesOfRandomBoxesAreWhatRaysSay) {
  Random random(3);
  int inside = 0;
  for (const MeshPointer& box : random_boxes(300, 8, 20)) {
    const Vector3 toward = scene_direction(SunPlace{}, random.uniform(0, 360), random.uniform(3, 88));
    const std::vector<Point3> outline = shadow_outline(*box, toward, 0);
    ASSERT_GE(outline.size(), 4u);
    for (int i = 0; i < 60; ++i) {
      const Point3 near = outline[random.below(outline.size())];
      const Point3 point{near.x + random.uniform(-30, 30), near.y + random.uniform(-30, 30), 0};
      const bool is_shaded = plain_hit(point, toward, *box, 0);
      if (holds(outline, point, 1e-7)) {
        EXPECT_TRUE(is_shaded);
        ++inside;
      } else if (!holds(outline, point, -1e-7)) {
        EXPECT_FALSE(is_shaded);
      }
    }
  }
  EXPECT_GT(inside, 2000);
}

TEST(ShadowShape, TheBodyOfShadeIsClosedAndHasItsVolume) {
  // Below the roof: 8 · 6 · 10; below the south wall at 45 degrees: a wedge of 10 · 10 / 2 over 8 m.
  const Mesh box = box_mesh({0, 0, 0}, 8, 6, 10);
  EXPECT_NEAR(enclosed_volume(shadow_volume(box, scene_direction(SunPlace{}, 180, 45), 0)), 480 + 400, 1e-6);
  // Cut by the ground half way up.
  EXPECT_NEAR(enclosed_volume(shadow_volume(box, scene_direction(SunPlace{}, 180, 45), 5)), 240 + 100, 1e-6);
  EXPECT_TRUE(shadow_volume(box, scene_direction(SunPlace{}, 180, 0), 0).triangles.empty());
  Random random(11);
  for (const MeshPointer& each : random_boxes(100, 12, 50)) {
    const Vector3 toward = scene_direction(SunPlace{}, random.uniform(0, 360), random.uniform(3, 88));
    const Mesh shade = shadow_volume(*each, toward, 0);
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
    for (const auto& [a, b, c] : shade.triangles) { ++edges[{a, b}], ++edges[{b, c}], ++edges[{c, a}]; }
    for (const auto& [edge, count] : edges) {
      const auto back = edges.find({edge.second, edge.first});
      ASSERT_NE(back, edges.end());
      EXPECT_EQ(back->second, count);
    }
    double low = 1e9;
    for (const Point3& corner : shade.vertices) low = std::min(low, corner.z);
    EXPECT_EQ(low, 0);
  }
}

TEST(ShadowShape, AnEnvelopeByHand) {
  // The neighbour's edge lies north of the plot at y = 0, 2 m high; the sun stands in the south at 45 degrees.
  const Point3 west{-20, 0, 2}, east{20, 0, 2}, plot{0, -10, 0};
  const Vector3 noon = scene_direction(SunPlace{}, 180, 45), north = scene_direction(SunPlace{}, 0, 30),
                night = scene_direction(SunPlace{}, 180, -5);
  const auto planes = solar_envelope(west, east, plot, std::vector<Vector3>{noon, north, night});
  ASSERT_EQ(planes.size(), 1u);
  const auto allowed = [&](double y) { return (planes[0].offset - planes[0].normal.y * y) / planes[0].normal.z; };
  EXPECT_NEAR(allowed(0), 2, 1e-9);
  EXPECT_NEAR(allowed(-10), 12, 1e-9);
}

// A building whose top follows the lowest of the planes takes no sun from the edge; one that is higher does.
TEST(ShadowShape, WhatStaysUnderTheEnvelopeTakesNoSun) {
  Random random(21);
  int limited = 0;
  for (int i = 0; i < 200; ++i) {
    const Point3 a{random.uniform(-40, -20), random.uniform(20, 50), random.uniform(0, 3)},
        b{random.uniform(20, 40), random.uniform(20, 50), a.z};
    std::vector<Vector3> suns;
    for (int k = 0; k < 4; ++k) suns.push_back(scene_direction(SunPlace{}, random.uniform(90, 270), random.uniform(5, 60)));
    const Mesh flat = box_mesh({0, 0, -50}, 20, 12, 50, random.uniform(0, 3));
    const auto planes = solar_envelope(a, b, {0, 0, 0}, suns);
    const auto takes = [&](double more) {
      Mesh built = flat;
      for (std::size_t v = 4; v < 8; ++v) {
        double top = 1e3;
        for (const SunPlane& plane : planes)
          top = std::min(
              top, (plane.offset - plane.normal.x * built.vertices[v].x - plane.normal.y * built.vertices[v].y) / plane.normal.z);
        built.vertices[v].z = top + more;
      }
      for (const Vector3& sun : suns)
        for (int s = 0; s <= 400; ++s)
          if (plain_hit(a + (b - a) * (s / 400.0), sun, built, 0)) return true;
      return false;
    };
    if (planes.empty()) continue;
    EXPECT_FALSE(takes(-1e-6)) << i;
    limited += takes(1) ? 1 : 0;
  }
  EXPECT_GT(limited, 100);
}

// A building of 40 m with the sun a hair above the horizon: no outline rather than one of 20 000 km.
TEST(ShadowShape, IsEmptyWhereItWouldBeLongerThanTheEarthIsLevel) {
  const Mesh tower = box_mesh({0, 0, 0}, 10, 10, 40);
  for (const auto& [rise, is_there] : {std::pair{2e-6, false}, {3.9e-4, false}, {4.1e-4, true}}) {
    const Vector3 toward{0, std::sqrt(1 - rise * rise), rise};
    EXPECT_EQ(!shadow_outline(tower, toward, 0).empty(), is_there) << rise;
    EXPECT_EQ(!shadow_volume(tower, toward, 0).triangles.empty(), is_there) << rise;
  }
}

}  // namespace
}  // namespace bl::sun
