// Faces parted into what others lie on and the rest.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/geometry/plan_split.h"

namespace bl::geometry {
namespace {

double area_of(const std::vector<PlateFace>& faces) {
  double area = 0;
  for (const PlateFace& face : faces) {
    area += signed_area(face.outer);
    for (const Ring& hole : face.holes) area += signed_area(hole);
  }
  return area;
}

Ring square(double left, double low, double side, bool is_turned = false) {
  Ring ring = {{left, low, 0}, {left + side, low, 0}, {left + side, low + side, 0}, {left, low + side, 0}};
  if (is_turned) std::reverse(ring.begin(), ring.end());
  return ring;
}

// By hand: a square with a court, and another square over one of its corners and over a part of the court.
TEST(PlanSplit, CoveredAndFreePartsAreTheFace) {
  const PlateFace face{square(0, 0, 20), {square(5, 5, 10, true)}}, other{square(12, 12, 10), {}};
  const SplitFace split = split_face(face, {&other, 1}, 1e-4);
  EXPECT_EQ(split.rings.size(), 2u);
  EXPECT_NEAR(area_of(split.covered), 64 - 9, 1e-9);
  EXPECT_NEAR(area_of(split.free), 300 - 55, 1e-9);
  // The crossings lie on the sides of the face.
  EXPECT_EQ(split.on_sides[0][1], (Ring{{20, 12, 0}}));
  EXPECT_EQ(split.on_sides[0][2], (Ring{{12, 20, 0}}));
  EXPECT_TRUE(split.on_sides[0][0].empty());
}

TEST(PlanSplit, WhatMeetsNothingStaysWhole) {
  const PlateFace face{square(0, 0, 20), {square(5, 5, 10, true)}}, court{square(6, 6, 8), {}}, roof{square(-1, -1, 30), {}};
  const SplitFace open = split_face(face, {&court, 1}, 1e-4), under = split_face(face, {&roof, 1}, 1e-4);
  EXPECT_TRUE(open.covered.empty());
  EXPECT_NEAR(area_of(open.free), 300, 1e-9);
  EXPECT_TRUE(under.free.empty());
  EXPECT_NEAR(area_of(under.covered), 300, 1e-9);
  EXPECT_TRUE(split_face({square(0, 0, 1e-6), {}}, {}, 1e-4).is_empty());
}

// Whatever crosses: both parts together have the corners of the face, and are as large.
TEST(PlanSplit, PartsOfTurnedSquaresAddUp) {
  for (int k = 0; k < 200; ++k) {
    const double turn = 0.031 * k, x = 7 * std::sin(1.7 * k), y = 7 * std::cos(2.3 * k);
    PlateFace face{square(-10, -10, 20), {}}, other{{}, {}};
    for (const Point3& p : square(-8, -8, 16))
      other.outer.push_back(
          {x + std::cos(turn) * p.x - std::sin(turn) * p.y, y + std::sin(turn) * p.x + std::cos(turn) * p.y, 0});
    const SplitFace split = split_face(face, {&other, 1}, 1e-4);
    EXPECT_NEAR(area_of(split.covered) + area_of(split.free), 400, 0.02) << k;
    EXPECT_LE(area_of(split.covered), 256.02) << k;
    EXPECT_GT(area_of(split.covered), 20) << k;
  }
}

}  // namespace
}  // namespace bl::geometry
