// The grid of points: it finds whoever is near, wherever the points lie and go.
#include "core/base/point_grid.h"

#include <gtest/gtest.h>

#include <set>

#include "core/base/random.h"

namespace bl {
namespace {

Point3 anywhere(Random& random) {
  const double wide = random.below(6) == 0 ? 1e9 : 30;
  return {random.uniform(-wide, wide), random.uniform(-wide, wide), random.uniform(-wide, wide)};
}

double length(const PointGrid& grid, std::uint32_t point, const Point3& from) { return norm(grid.way(from, grid[point])); }

TEST(PointGrid, FindsEverybodyWithinADistanceWhileTheyMove) {
  for (const bool in_plan : {false, true})
    for (const double side : {0.5, 5.0, 1e6}) {
      Random random(3, in_plan ? 1 : 0);
      std::vector<Point3> points;
      for (int n = 0; n < 300; ++n) points.push_back(anywhere(random));
      PointGrid grid(points, side, in_plan);
      for (int move = 0; move < 300; ++move) {
        const auto point = static_cast<std::uint32_t>(random.below(points.size()));
        points[point] = anywhere(random);
        grid.move(point, points[point]);
        EXPECT_EQ(grid[point], points[point]);
        // A distance that is just that of somebody: nothing may be lost at the borders of cells.
        const Point3 centre = points[random.below(points.size())];
        const double distance = move % 2 == 0 ? length(grid, point, centre) : random.uniform(0, 20);
        std::set<std::uint32_t> found;
        grid.visit_near(centre, distance, [&](std::uint32_t at) { found.insert(at); });
        for (std::uint32_t at = 0; at < points.size(); ++at) {
          if (length(grid, at, centre) <= distance) { EXPECT_TRUE(found.contains(at)); }
          EXPECT_LE(length(grid, at, centre), grid.farthest(centre) * (1 + 1e-12));
        }
      }
    }
}

TEST(PointGrid, LooksAtFewWhereTheyAreMany) {
  Random random(4);
  std::vector<Point3> points;
  for (int n = 0; n < 10000; ++n) points.push_back({random.uniform(0, 1000), random.uniform(0, 1000), 0});
  points.push_back({1e12, 0, 0});
  const PointGrid grid(points, 10, false);
  std::size_t looked = 0;
  for (std::uint32_t point = 0; point < 1000; ++point) grid.visit_near(points[point], 10, [&](std::uint32_t) { ++looked; });
  EXPECT_LE(looked, 1000u * 30u);
}

TEST(PointGrid, HeightsDoNotCountInPlan) {
  const PointGrid grid({{0, 0, 0}, {1, 0, 500}}, 2, true);
  EXPECT_EQ(norm(grid.way(grid[0], grid[1])), 1);
  EXPECT_EQ(grid.farthest(grid[0]), 1);
  std::set<std::uint32_t> found;
  grid.visit_near(grid[0], 2, [&](std::uint32_t at) { found.insert(at); });
  EXPECT_EQ(found, (std::set<std::uint32_t>{0, 1}));
}

TEST(PointGrid, NumbersBeyondAllCellsAreFoundAsWell) {
  const PointGrid grid({{1e308, -1e308, 0}, {1e308, -1e308, 1}, {0, 0, 0}}, 1, false);
  std::set<std::uint32_t> found;
  grid.visit_near(grid[0], 2, [&](std::uint32_t at) { found.insert(at); });
  EXPECT_TRUE(found.contains(0) && found.contains(1));
}

// Around the largest number of a cell that a processor knows, among so many points that cells are looked at and not all points.
TEST(PointGrid, CellsGoOnWhereNumbersOfCellsEnd) {
  std::vector<Point3> points;
  for (int n = 0; n < 5000; ++n) points.push_back({10.0 * n, 0, 0});
  const double last = 9223372036854774784.0;  // below 2^63
  points.push_back({last, 0, 0});
  points.push_back({-last, 0, 0});
  const PointGrid grid(points, 1, true);
  for (const std::uint32_t point : {5000u, 5001u}) {
    std::set<std::uint32_t> found;
    grid.visit_near(grid[point], 2048, [&](std::uint32_t at) { found.insert(at); });
    EXPECT_TRUE(found.contains(point)) << point;
    EXPECT_LT(found.size(), 5000u) << point;
  }
}

}  // namespace
}  // namespace bl
