// One tick of the solver: what a small change moves, and that nothing kept shows in it.
#include "core/geometry/volume_tick.h"

#include <algorithm>
#include <cmath>

#include "tests/core/geometry/geometry_support.h"

namespace bl::test {
namespace {

constexpr double kTickTolerance = 0.005;

struct TickedCrowd {
  geometry::Domain domain = unit_cube();
  std::vector<geometry::PowerSite> sites;
  std::vector<double> wanted, heights;
  std::vector<geometry::Standing> standing;
  geometry::FitState state;

  TickedCrowd(std::size_t count, double fill) {
    Random random(11);
    double sum = 0;
    for (std::size_t i = 0; i < count; ++i) {
      sites.push_back({random_point(random, {0, 0, 0}, {1, 1, 1}), 0});
      wanted.push_back(random.uniform(0.25, 1.75));
      sum += wanted.back();
    }
    for (double& one : wanted) one *= fill / sum;
    heights.assign(count, 0.05);
    standing.assign(count, geometry::Standing::stack);
  }

  Result<geometry::VolumeTick::Outcome> tick(geometry::VolumeTick::Cache& with) {
    const geometry::VolumeTick now{.tolerance = kTickTolerance, .storey_heights = heights, .standing = standing};
    auto done = now.run(domain, sites, wanted, state, with);
    if (done) state = done->state;
    return done;
  }

  double error(std::span<const geometry::CellMeasure> cells) const {
    double most = 0;
    for (std::size_t i = 0; i < cells.size(); ++i) most = std::max(most, std::abs(cells[i].volume - wanted[i]) / wanted[i]);
    return most;
  }
};

// A site that moves a little makes those around it move their weights, and nobody else: not one bit of theirs.
TEST(VolumeTick, ASmallMoveIsTakenUpByThoseAroundIt) {
  for (const double fill : {0.7, 0.95, 1.0}) {
    TickedCrowd crowd(400, fill);
    geometry::VolumeTick::Cache cache;
    for (int t = 0; t < 40; ++t) ASSERT_TRUE(crowd.tick(cache).ok());
    std::size_t moved = 0, differing = 0;
    for (int t = 0; t < 12; ++t) {
      crowd.sites[200].position += Vector3{0.002, 0, 0};
      const auto before = crowd.sites;
      const auto done = crowd.tick(cache);
      ASSERT_TRUE(done.ok()) << done.error().text();
      EXPECT_LE(crowd.error(done->cells), kTickTolerance) << "fill " << fill << ", tick " << t;
      for (std::size_t i = 0; i < before.size(); ++i) moved += before[i].weight != crowd.sites[i].weight;
      differing += done->differing.size();
    }
    EXPECT_GT(moved, 0u) << fill;
    EXPECT_LT(moved, 12u * 40u) << fill;
    EXPECT_LT(differing, 12u * 200u) << fill;
  }
}

TEST(VolumeTick, WhatIsKeptChangesNoBit) {
  TickedCrowd crowd(150, 0.9);
  geometry::VolumeTick::Cache cache;
  Random random(3);
  for (int t = 0; t < 15; ++t) {
    crowd.sites[random.below(150)].position += 0.02 * random_point(random, {-1, -1, -1}, {1, 1, 1});
    if (t % 4 == 3) crowd.wanted[random.below(150)] *= 0.97;
    TickedCrowd anew = crowd;
    geometry::VolumeTick::Cache nothing;
    const auto mine = crowd.tick(cache);
    const auto other = anew.tick(nothing);
    ASSERT_TRUE(mine.ok() && other.ok());
    EXPECT_EQ(mine->state, other->state) << t;
    EXPECT_EQ(crowd.sites, anew.sites) << t;
    for (std::size_t i = 0; i < crowd.sites.size(); ++i) {
      EXPECT_EQ(mine->cells[i].volume, other->cells[i].volume) << i;
      EXPECT_EQ(mine->cells[i].floor_area, other->cells[i].floor_area) << i;
      EXPECT_EQ(mine->stances[i], other->stances[i]) << i;
    }
  }
}

}  // namespace
}  // namespace bl::test
