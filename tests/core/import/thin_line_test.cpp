// Lines with fewer points: what is kept, how far the rest lies aside, and that nothing happens to a line that is short enough.
#include "core/import/thin_line.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace bl::importing {
namespace {

std::vector<Point3> circle(std::size_t count, double radius) {
  std::vector<Point3> points;
  for (std::size_t k = 0; k <= count; ++k) {
    const double angle = 2 * std::numbers::pi * static_cast<double>(k) / static_cast<double>(count);
    points.push_back({radius * std::cos(angle), radius * std::sin(angle), 0});
  }
  points.back() = points.front();
  return points;
}

double distance_to(const Point3& p, const std::vector<Point3>& line) {
  double nearest = 1e300;
  for (std::size_t i = 1; i < line.size(); ++i) {
    const Vector3 along = line[i] - line[i - 1];
    const double whole = squared_norm(along), share = whole > 0 ? std::clamp(dot(p - line[i - 1], along) / whole, 0.0, 1.0) : 0;
    nearest = std::min(nearest, distance(p, line[i - 1] + share * along));
  }
  return nearest;
}

TEST(ThinLine, IsTheSameWhereItIsShortEnough) {
  const std::vector<Point3> line{{0, 0, 0}, {1, 0.001, 0}, {2, 0, 0}, {3, 0, 0}};
  const ThinLine thin = thin_line(line, 2);
  EXPECT_EQ(thin.points, line) << "also what is nearly straight: it costs little";
  EXPECT_EQ(thin.aside, 0);
}

TEST(ThinLine, KeepsWhatBendsMost) {
  const std::vector<Point3> line{{0, 0, 0}, {10, 0.5, 0}, {20, 9, 0}, {30, 0.3, 0}, {40, 0, 0}};
  EXPECT_EQ(thin_line(line, 1).points, (std::vector<Point3>{{0, 0, 0}, {20, 9, 0}, {40, 0, 0}}));
  EXPECT_NEAR(thin_line(line, 1).aside, 4.2 * 20 / std::hypot(20, 9), 1e-9);
  EXPECT_EQ(thin_line(line, 0).points.size(), 2u);
  EXPECT_EQ(thin_line(line, 0).aside, 9);
}

TEST(ThinLine, ARoundStaysRoundAndTheRestLiesAsNearAsItSays) {
  const std::vector<Point3> round = circle(5000, 100);
  const ThinLine thin = thin_line(round, 60);
  EXPECT_EQ(thin.points.size(), 62u);
  EXPECT_EQ(thin.points.front(), thin.points.back());
  double most = 0;
  for (const Point3& p : round) most = std::max(most, distance_to(p, thin.points));
  EXPECT_NEAR(most, thin.aside, 1e-9);
  EXPECT_LT(most, 0.6);
  // With room for more it stops where the rest lies within a centimetre.
  const ThinLine fine = thin_line(round, 4000);
  EXPECT_LT(fine.points.size(), 600u);
  EXPECT_LE(fine.aside, 0.01);
  EXPECT_GT(fine.aside, 0.001);
}

TEST(ThinLine, AStraightLineOfManyPointsNeedsNone) {
  std::vector<Point3> line;
  for (int k = 0; k < 1000; ++k) line.push_back({static_cast<double>(k), 0, 0});
  EXPECT_EQ(thin_line(line, 500).points.size(), 2u);
  const std::vector<Point3> still(700, Point3{3, 4, 0});
  EXPECT_EQ(thin_line(still, 500).points.size(), 2u);
}

}  // namespace
}  // namespace bl::importing
