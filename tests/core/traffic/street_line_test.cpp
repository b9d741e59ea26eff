// Lines of streets by hand: lengths, heights, parts, and the places between.
#include "core/traffic/street_line.h"

#include <gtest/gtest.h>

namespace bl::traffic {
namespace {

using Points = std::vector<Point3>;

TEST(StreetLine, WithoutACourseItIsStraight) {
  EXPECT_EQ(street_line({1, 2, 3}, {}, {4, 5, 6}), (Points{{1, 2, 3}, {4, 5, 6}}));
  const Point3 a{0.1, 0.2, 0.3}, b{1e3 / 7, -2e3 / 3, 11};
  EXPECT_EQ(street_length(a, {}, b), distance(a, b)) << "bit for bit";
}

TEST(StreetLine, RisesEvenlyAlongItsPlan) {
  const Points course{{30, 0, 77}, {30, 40, -5}};
  EXPECT_EQ(street_line({0, 0, 10}, course, {0, 40, 20}), (Points{{0, 0, 10}, {30, 0, 13}, {30, 40, 17}, {0, 40, 20}}));
  EXPECT_EQ(street_length({0, 0, 0}, course, {0, 40, 0}), 100);
  EXPECT_NEAR(street_length({0, 0, 0}, course, {0, 40, 75}), 125, 1e-12);
  // All in one place in plan, as where somebody stands a junction on the other.
  EXPECT_EQ(street_line({0, 0, 0}, Points{{0, 0, 0}}, {0, 0, 8}), (Points{{0, 0, 0}, {0, 0, 4}, {0, 0, 8}}));
}

TEST(StreetLine, PartsKeepTheBendsBetweenTheirEnds) {
  const Points line{{0, 0, 0}, {30, 0, 0}, {30, 40, 0}, {0, 40, 0}};  // 30 + 40 + 30 m
  EXPECT_EQ(part_of_line(line, 0, 1), line);
  EXPECT_EQ(part_of_line(line, 0.1, 0.5), (Points{{10, 0, 0}, {30, 0, 0}, {30, 20, 0}}));
  EXPECT_EQ(part_of_line(line, 0.3, 0.7), (Points{{30, 0, 0}, {30, 40, 0}})) << "from bend to bend";
  EXPECT_EQ(part_of_line(line, 0.4, 0.6), (Points{{30, 10, 0}, {30, 30, 0}}));
  EXPECT_EQ(point_on_line(line, 0.5), (Point3{30, 20, 0}));
  EXPECT_EQ(point_on_line(line, -1), line.front());
  EXPECT_EQ(point_on_line(line, 2), line.back());
  const Points still{{5, 5, 5}, {5, 5, 5}};
  EXPECT_EQ(point_on_line(still, 0.5), still.front());
  EXPECT_EQ(part_of_line({}, 0, 1), Points{});
}

}  // namespace
}  // namespace bl::traffic
