// A district with and without what it keeps from step to step: the same bits, whatever changes in between.
#include "core/traffic/district.h"

#include <bit>
#include <limits>

#include <gtest/gtest.h>

#include "core/base/random.h"

namespace bl::traffic {
namespace {

struct SmallTown : DistrictParts {
  DistrictState state;

  DistrictResult step(DistrictMemo* memo = nullptr) {
    auto result = step_district(*this, state, memo);
    EXPECT_TRUE(result.ok()) << result.error().text();
    return *result;
  }
};

// A grid of streets with zones at random junctions.
SmallTown grid_town(std::uint64_t seed, int side, std::size_t zones) {
  Random random(seed);
  SmallTown town;
  const auto name = [](int x, int y) { return "j" + std::to_string(x) + "_" + std::to_string(y); };
  const auto street = [&](const std::string& id, const std::string& from, const std::string& to) {
    town.streets.push_back(
        {id, from, to, 0, random.uniform(5, 15), random.uniform(200, 900), 0, random.below(6) == 0, true, true});
  };
  for (int x = 0; x < side; ++x)
    for (int y = 0; y < side; ++y) {
      town.junctions.push_back({name(x, y), {100.0 * x, 100.0 * y, 0}, random.uniform(0, 5)});
      if (x > 0) street("e" + name(x, y), name(x - 1, y), name(x, y));
      if (y > 0) street("n" + name(x, y), name(x, y), name(x, y - 1));
    }
  for (std::size_t j = 0; town.zones.size() < zones; j += 2)
    town.zones.push_back({town.junctions[j].id, town.junctions[j].position, random.uniform(0, 300), random.uniform(0, 300), {}});
  town.settings = {.gap = 1e-5, .steps = 2};
  return town;
}

// Trips move, streets get other capacities, close and open, gain tolls, and a zone comes and goes.
void change(SmallTown& town, Random& random, int tick) {
  for (DistrictZone& zone : town.zones) zone.leaving *= random.uniform(0.9, 1.1);
  if (tick % 3 == 1) town.streets[random.below(town.streets.size())].capacity *= random.uniform(0.5, 1.5);
  if (tick % 4 == 2) {
    DistrictStreet& street = town.streets[random.below(town.streets.size())];
    street.is_open = !street.is_open;
  }
  if (tick == 9) town.settings.toll_factor = 10;
  if (tick > 9) town.streets[random.below(town.streets.size())].toll = random.uniform(0, 3);
  if (tick == 13) town.zones.pop_back();
  if (tick == 16) town.zones.push_back({"late", {150, 150, 0}, 100, 100, {"j1_1"}});
}

void expect_same(const DistrictResult& a, const DistrictResult& b, int tick) {
  EXPECT_EQ(a.state, b.state) << tick;
  EXPECT_EQ(a.gap, b.gap) << tick;
  EXPECT_EQ(a.restlessness, b.restlessness) << tick;
  EXPECT_EQ(a.is_at_rest, b.is_at_rest) << tick;
  EXPECT_EQ(a.total_time, b.total_time) << tick;
  ASSERT_EQ(a.zones.size(), b.zones.size());
  for (std::size_t z = 0; z < a.zones.size(); ++z) {
    EXPECT_EQ(a.zones[z].mean_time, b.zones[z].mean_time) << tick;
    EXPECT_EQ(a.zones[z].accessibility, b.zones[z].accessibility) << tick;
    ASSERT_EQ(a.zones[z].reach.size(), b.zones[z].reach.size());
    for (std::size_t r = 0; r < a.zones[z].reach.size(); ++r) {
      EXPECT_EQ(a.zones[z].reach[r].driving, b.zones[z].reach[r].driving) << tick;
      EXPECT_EQ(a.zones[z].reach[r].walking, b.zones[z].reach[r].walking) << tick;
    }
  }
}

TEST(DistrictMemo, WhatIsKeptFromStepToStepChangesNoBit) {
  int iterations = 0, rests = 0;
  for (const std::uint64_t seed : {1u, 2u, 3u}) {
    SmallTown town = grid_town(seed, 6, 12);
    town.zones[3].wants_reach = true;
    Random random(seed, 7);
    DistrictMemo memo;
    for (int tick = 0; tick < 40; ++tick) {
      if (tick < 20) change(town, random, tick);
      const DistrictResult with = town.step(&memo), without = town.step();
      expect_same(with, without, tick);
      town.state = without.state;
      iterations += without.iterations;
      rests += without.is_at_rest ? 1 : 0;
      if (tick % 7 == 3) {  // another district in between leaves nothing behind
        SmallTown other = grid_town(seed + 10, 5, 9);
        (void)other.step(&memo);
      }
    }
  }
  EXPECT_GT(iterations, 20);
  EXPECT_GT(rests, 3);
}

TEST(DistrictMemo, ATownThatMovesStaysNearItsEquilibrium) {
  SmallTown town = grid_town(4, 6, 12);
  Random random(4);
  DistrictMemo memo;
  for (int tick = 0; tick < 30; ++tick) {
    for (DistrictZone& zone : town.zones) zone.leaving *= random.uniform(0.95, 1.05);
    const DistrictResult result = town.step(&memo);
    town.state = result.state;
    double trips = 0, flows = 0;
    for (const DistrictZone& zone : town.zones) trips += zone.leaving;
    for (const auto& zone : result.zones) flows += zone.served + zone.lost;
    EXPECT_NEAR(flows, trips, 1e-9 * trips) << tick;
    if (tick > 3) { EXPECT_LT(result.gap, 1e-4) << tick; }
  }
}

}  // namespace
}  // namespace bl::traffic
