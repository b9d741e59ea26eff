// Steps of a district by hand: what is left out and why, several ways of access, and steps that lead where a long run leads.
#include "core/traffic/district.h"

#include <cmath>

#include <gtest/gtest.h>

namespace bl {
namespace {

// west - east along two streets of 300 m; 10 m/s.
struct Town {
  std::vector<DistrictJunction> junctions{{"east", {300, 0, 0}, 0}, {"west", {0, 0, 0}, 0}};
  std::vector<DistrictStreet> streets{{"high", "west", "east", 0, 10, 1000, 0, false, true, true},
                                      {"low", "west", "east", 400, 10, 1000, 0, false, true, true}};
  std::vector<DistrictZone> zones{{"east", {300, 0, 0}, 0, 100, {}}, {"home", {0, 134, 0}, 2500, 0, {"west"}}};
  DistrictSettings settings{.gap = 1e-10, .steps = 20};
  DistrictState state;

  DistrictResult step() {
    auto result = step_district(junctions, streets, zones, settings, state);
    EXPECT_TRUE(result.ok()) << result.error().text();
    state = result->state;
    return *result;
  }
};

TEST(District, TwoStreetsShareTheTripsByHand) {
  Town town;
  const DistrictResult result = town.step();
  const double high = result.streets[0].flow_forth, low = result.streets[1].flow_forth;
  EXPECT_NEAR(high + low, 2500, 1e-9);
  EXPECT_NEAR(result.streets[0].time_forth, 30 * (1 + 0.15 * std::pow(high / 1000, 4)), 1e-9);
  EXPECT_GT(low, 0);
  EXPECT_NEAR(result.streets[0].time_forth, result.streets[1].time_forth, 1e-6) << "nobody gains by the other street";
  EXPECT_NEAR(result.streets[0].delay, result.streets[0].time_forth - 30, 1e-12);
  EXPECT_EQ(result.streets[0].length, 300);
  EXPECT_EQ(result.streets[1].length, 400);
  EXPECT_NEAR(result.zones[1].mean_time, 100 + result.streets[0].time_forth, 1e-6) << "134 m on foot take 100 s";
  EXPECT_NEAR(result.zones[1].accessibility, 100 * std::exp(-result.zones[1].mean_time / 600), 1e-9);
  EXPECT_EQ(result.junctions[0].streets, 2);
  EXPECT_NEAR(result.junctions[0].flow, 2500, 1e-9);
  EXPECT_NEAR(result.junctions[1].load, high / 1000, 1e-12);
}

TEST(District, DelaysAtJunctionsAndTollsCount) {
  Town town;
  town.junctions[0].delay = 7;
  town.zones[1].leaving = 1;
  EXPECT_NEAR(town.step().streets[0].time_forth, 37, 1e-6);
  town.streets[0].toll = 2;
  town.settings.toll_factor = 10;
  EXPECT_NEAR(town.step().streets[1].flow_forth, 1, 1e-9) << "20 s of toll are more than 10 s of way";
  town.settings.toll_factor = 0;
  town.settings.distance_factor = 1;
  EXPECT_NEAR(town.step().streets[0].flow_forth, 1, 1e-9);
}

TEST(District, WhatIsLeftOutSaysWhy) {
  Town town;
  town.streets.push_back({"stub", "west", "nowhere", 0, 10, 1000, 0, false, true, true});
  town.streets.push_back({"loop", "west", "west", 0, 10, 1000, 0, false, true, true});
  town.streets.push_back({"path", "west", "east", 0, 10, 1000, 0, false, true, false});
  town.streets.push_back({"works", "west", "east", 0, 10, 0, 0, false, false, true});
  town.streets.push_back({"unset", "", "east", 0, 10, 1000, 0, false, true, true});
  town.zones.push_back({"island", {0, 0, 0}, 20, 30, {}});
  town.zones.push_back({"typo", {0, 0, 0}, 5, 0, {"wset"}});
  const DistrictResult result = town.step();
  EXPECT_EQ(result.streets[2].reason, "its end `nowhere` is no junction of this network");
  EXPECT_EQ(result.streets[3].reason, "it begins and ends at the same junction");
  EXPECT_EQ(result.streets[4].reason, "it is for walking only");
  EXPECT_EQ(result.streets[5].reason, "it is closed");
  EXPECT_EQ(result.streets[6].reason, "its start names no junction");
  EXPECT_EQ(result.zones[2].reason, "it has no access: lay a link to a junction");
  EXPECT_EQ(result.zones[2].lost, 20);
  EXPECT_EQ(result.zones[3].reason, "its access `wset` is no junction of this network");
  EXPECT_EQ(result.lost, 25);
  EXPECT_NEAR(result.trips, 2500, 1e-9) << "all others travel";
}

TEST(District, AZoneThatIsCutOffLosesItsTripsAndGetsThemBack) {
  Town town;
  town.step();
  for (auto& street : town.streets) street.is_open = false;
  const DistrictResult closed = town.step();
  EXPECT_EQ(closed.zones[1].lost, 2500);
  EXPECT_EQ(closed.zones[1].served, 0);
  EXPECT_EQ(closed.zones[1].reason, "no other zone that trips could end in can be reached");
  for (auto& street : town.streets) street.is_open = true;
  EXPECT_NEAR(town.step().zones[1].served, 2500, 1e-9);
}

TEST(District, SmallStepsLeadWhereALongRunLeads) {
  Town one, many;
  for (Town* town : {&one, &many}) {
    town->zones.push_back({"shops", {600, 0, 0}, 200, 400, {"mid"}});
    town->junctions.push_back({"mid", {600, 50, 0}, 0});
    town->streets.push_back({"east_mid", "east", "mid", 0, 8, 300, 0, false, true, true});
    town->streets.push_back({"west_mid", "west", "mid", 900, 20, 500, 0, true, true, true});
  }
  many.settings.steps = 1;
  DistrictResult a, b;
  for (int i = 0; i < 100; ++i) a = one.step();
  for (int i = 0; i < 300; ++i) b = many.step();
  EXPECT_LT(a.restlessness, 1e-9);
  EXPECT_LT(b.gap, 1e-9);
  for (std::size_t s = 0; s < a.streets.size(); ++s) EXPECT_NEAR(a.streets[s].flow_forth, b.streets[s].flow_forth, 1e-3);
}

TEST(District, AStateOfAnotherDistrictDoesNoHarm) {
  Town town;
  town.state.flows = {
      {"home", "gone:forth", 5}, {"nobody", "high:forth", 7}, {"home", "high:back", 1e6}, {"home", "high:forth", -3}};
  town.state.trips = {{"home", "gone", 5}, {"home", "east", -1}, {"home", "home", 4}};
  for (int i = 0; i < 30; ++i) town.step();
  Town fresh;
  EXPECT_NEAR(town.step().streets[0].flow_forth, fresh.step().streets[0].flow_forth, 1e-3);
}

TEST(District, NothingAtAllIsNoError) {
  const auto empty = step_district({}, {}, {}, {}, {});
  ASSERT_TRUE(empty.ok());
  EXPECT_EQ(empty->trips, 0);
  EXPECT_EQ(empty->gap, 0);
}

TEST(District, TheSteepestDelaysStayNumbers) {
  Town town;
  town.settings.alpha = 100;
  town.settings.beta = 20;
  for (auto& street : town.streets) street.capacity = 1e-9;
  for (int i = 0; i < 3; ++i) {
    const DistrictResult result = town.step();
    EXPECT_TRUE(std::isfinite(result.gap) && std::isfinite(result.total_time) && std::isfinite(result.objective));
    EXPECT_NEAR(result.trips, 2500, 1e-6);
  }
}

TEST(District, ImpossibleNumbersHaveTheirPlace) {
  Town town;
  town.streets[0].toll = -1000;
  town.settings.toll_factor = 1;
  const auto result = step_district(town.junctions, town.streets, town.zones, town.settings, town.state);
  ASSERT_FALSE(result.ok());
  EXPECT_EQ(result.error().place, "high:back");
}

}  // namespace
}  // namespace bl
