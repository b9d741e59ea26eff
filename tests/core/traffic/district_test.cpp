// Steps of a district by hand: what is left out and why, several ways of access, and steps that lead where a long run leads.
#include "core/traffic/district.h"

#include <cmath>

#include <gtest/gtest.h>

namespace bl::traffic {
namespace {

// west - east along two streets of 300 m; 10 m/s.
struct Town {
  std::vector<DistrictJunction> junctions{{"east", {300, 0, 0}, 0}, {"west", {0, 0, 0}, 0}};
  std::vector<DistrictStreet> streets{{"high", "west", "east", 0, 10, 1000, 0, false, true, true},
                                      {"low", "west", "east", 400, 10, 1000, 0, false, true, true}};
  std::vector<DistrictZone> zones{{"east", {300, 0, 0}, 0, 100, {}}, {"home", {0, 134, 0}, 2500, 0, {"west"}}};
  std::vector<DistrictRules> rules;
  DistrictSettings settings{.gap = 1e-10, .steps = 20};
  DistrictState state;

  DistrictResult step() {
    auto result = step_district({junctions, streets, rules, zones, settings}, state);
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

TEST(District, TollsDecideTheWayAndAreNoTime) {
  Town town;
  town.zones[1].leaving = 1;
  town.zones[1].wants_reach = true;
  town.streets[0].toll = 2;
  town.settings.toll_factor = 3;  // 30 s and 6 s of toll against 40 s
  DistrictResult result = town.step();
  EXPECT_NEAR(result.streets[0].flow_forth, 1, 1e-9);
  EXPECT_NEAR(result.zones[1].mean_time, 130, 1e-6);
  EXPECT_NEAR(result.zones[1].reach[0].driving, 130, 1e-6);
  EXPECT_NEAR(result.zones[1].accessibility, 100 * std::exp(-130.0 / 600), 1e-6);
  EXPECT_NEAR(result.total_time, 130, 1e-6);
  town.settings.toll_factor = 10;  // 20 s: the way round it is cheaper, and takes longer
  result = town.step();
  result = town.step();
  EXPECT_NEAR(result.streets[1].flow_forth, 1, 1e-9);
  EXPECT_NEAR(result.zones[1].mean_time, 140, 1e-6);
  EXPECT_NEAR(result.zones[1].reach[0].driving, 140, 1e-6);
  town.settings.toll_factor = 5;  // both cost the same: the quicker one is told
  EXPECT_NEAR(town.step().zones[1].reach[0].driving, 130, 1e-6);
}

TEST(District, TheTimeAtAJunctionDoesNotGrowWithTheStreetsTraffic) {
  Town town;
  town.streets.pop_back();
  town.junctions[0].delay = 7;
  const DistrictResult result = town.step();
  EXPECT_NEAR(result.streets[0].time_forth, 30 * (1 + 0.15 * std::pow(2.5, 4)) + 7, 1e-9);
  EXPECT_NEAR(result.streets[0].delay, 30 * 0.15 * std::pow(2.5, 4), 1e-9);
}

TEST(District, AStreetThatIsNearlyClosedLosesItsTraffic) {
  for (const double capacity : {0.008, 1e-9, 1e-300}) {
    Town town;
    town.step();
    town.streets[0].capacity = capacity;
    DistrictResult result = town.step();
    for (int i = 0; i < 3; ++i) result = town.step();
    EXPECT_LT(result.streets[0].flow_forth, 1) << capacity;
    EXPECT_NEAR(result.streets[0].flow_forth + result.streets[1].flow_forth, 2500, 1e-6) << capacity;
    EXPECT_LT(result.gap, 1e-6) << capacity;
    EXPECT_TRUE(std::isfinite(result.streets[0].time_forth) && std::isfinite(result.streets[0].load)) << capacity;
  }
}

TEST(District, TripsToWhereNobodyCanGoEndElsewhereAtOnce) {
  Town town;
  town.junctions.push_back({"north", {0, 300, 0}, 0});
  town.streets.push_back({"up", "west", "north", 0, 10, 1000, 0, false, true, true});
  town.zones.push_back({"north", {0, 300, 0}, 0, 100, {}});
  town.step();
  ASSERT_GT(town.step().streets[2].flow_forth, 0);
  town.streets[2].is_open = false;
  const DistrictResult result = town.step();
  EXPECT_EQ(result.lost, 0);
  EXPECT_EQ(result.zones[1].reason, "");
  EXPECT_NEAR(result.zones[1].served, 2500, 1e-9);
  EXPECT_EQ(result.state.trips("home", "north"), 0);
}

TEST(District, RestIsExactAndEndsWithAnyChange) {
  Town town;
  DistrictResult result = town.step();
  for (int i = 0; i < 60 && !result.is_at_rest; ++i) result = town.step();
  ASSERT_TRUE(result.is_at_rest);
  const DistrictResult again = town.step();
  EXPECT_TRUE(again.is_at_rest);
  EXPECT_EQ(again.streets[0].flow_forth, result.streets[0].flow_forth);
  EXPECT_EQ(again.zones[1].mean_time, result.zones[1].mean_time);
  town.zones[1].leaving += 1;
  EXPECT_FALSE(town.step().is_at_rest);
  town.zones[1].leaving -= 1;
  town.streets[0].is_open = false;
  result = town.step();
  EXPECT_FALSE(result.is_at_rest);
  EXPECT_EQ(result.streets[0].flow_forth, 0);
}

TEST(District, AStreetOfNoLengthIsWalkedToo) {
  Town town;
  town.junctions.push_back({"beside", {300, 0, 0}, 0});
  town.streets.push_back({"step", "east", "beside", 0, 10, 1000, 0, false, true, true});
  town.zones[1].wants_reach = true;
  const DistrictResult result = town.step();
  bool is_reached = false;
  for (const auto& row : result.zones[1].reach)
    if (row.junction == "beside") is_reached = row.walking > 0 && row.driving > 0;
  EXPECT_TRUE(is_reached);
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
  EXPECT_EQ(result.zones[2].reason, "it has no access: lay a link to a junction, or allow a longer walk to one");
  EXPECT_EQ(result.zones[2].lost, 20);
  EXPECT_EQ(result.zones[3].reason, "its access `wset` is no junction of this network");
  EXPECT_EQ(result.lost, 25);
  EXPECT_NEAR(result.trips, 2500, 1e-9) << "all others travel";
}

TEST(District, ACourseMakesAStreetLonger) {
  Town town;
  town.streets[0].course = {{0, 40, 7}, {300, 40, 0}};
  const DistrictResult result = town.step();
  EXPECT_EQ(result.streets[0].length, 380);
  EXPECT_GT(result.streets[1].flow_forth, town.streets[1].capacity * 0.9) << "400 m are hardly longer now";
  town.streets[0].length = 300;
  EXPECT_EQ(town.step().streets[0].length, 300) << "as it is set";
}

TEST(District, ARoundIsDrivenByNobodyAndHasItsTimes) {
  Town town;
  const auto before = town.step();
  town.streets.push_back({"round", "west", "west", 0, 10, 1000, 0, true, true, true, {{0, 30, 0}, {40, 30, 0}}});
  town.junctions[1].delay = 2;
  town.rules = {{"west", {{"round", "high", "no"}}}};
  const DistrictResult result = town.step();
  EXPECT_EQ(result.streets[2].length, 120);
  EXPECT_EQ(result.streets[2].time_forth, 14);
  EXPECT_EQ(result.streets[2].time_back, 0) << "one way";
  EXPECT_EQ(result.streets[2].flow_forth, 0);
  EXPECT_EQ(result.streets[2].reason, "");
  EXPECT_EQ(result.junctions[1].streets, 3);
  EXPECT_NEAR(result.streets[0].flow_forth, before.streets[0].flow_forth, 1e-6);
  EXPECT_EQ(result.rules[0].reason, "turns/0/from: `round` begins and ends at `west`: no way leads over it");
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
  EXPECT_LT(a.restlessness, 1e-7);
  EXPECT_LT(b.gap, 1e-9);
  for (std::size_t s = 0; s < a.streets.size(); ++s) EXPECT_NEAR(a.streets[s].flow_forth, b.streets[s].flow_forth, 1e-3);
}

TEST(District, AStateOfAnotherDistrictDoesNoHarm) {
  Town town;
  town.state.links = {"gone:forth", "high:forth", "low:back", "low:forth"};
  town.state.zones = {
      {"gone", {1}, {5}, {1, 2, 3}}, {"east", {}, {}, {}}, {"home", {0, 1, 1, 99, 2, 3}, {7, 100, 3, 5, -3, 0}, {5, -1, 4}}};
  for (int i = 0; i < 30; ++i) town.step();
  Town fresh;
  EXPECT_NEAR(town.step().streets[0].flow_forth, fresh.step().streets[0].flow_forth, 1e-3);
}

// Three zones along one street; what ends in them holds.
Town doubly() {
  Town town;
  town.settings.constraint = TripConstraint::both;
  town.junctions.push_back({"north", {0, 300, 0}, 0});
  town.streets.push_back({"up", "west", "north", 0, 10, 1000, 0, false, true, true});
  town.zones = {{"east", {300, 0, 0}, 0, 100, {}}, {"home", {0, 134, 0}, 120, 0, {"west"}}, {"north", {0, 300, 0}, 0, 20, {}}};
  return town;
}

TEST(District, SumsThatAgreeMissNothing) {
  Town town = doubly();
  DistrictResult result = town.step();
  EXPECT_TRUE(result.arrivals.empty());
  EXPECT_EQ(result.missing, 0);
  EXPECT_NEAR(result.zones[0].ending, 100, 1e-6);
  EXPECT_NEAR(result.zones[2].ending, 20, 1e-6);
}

TEST(District, SumsThatDoNotAgreeAreToldZoneByZone) {
  Town town = doubly();
  town.zones[1].leaving = 60;
  DistrictResult result = town.step();
  ASSERT_EQ(result.arrivals.size(), 2u);
  EXPECT_NEAR(result.arrivals[0].missing, 50, 1e-6);
  EXPECT_NEAR(result.arrivals[1].missing, 10, 1e-6);
  EXPECT_NEAR(result.missing, 60, 1e-6);
  EXPECT_NE(result.arrivals[0].reason.find("fewer trips leave"), std::string::npos);
  town.zones[1].leaving = 240;
  result = town.step();
  ASSERT_EQ(result.arrivals.size(), 2u);
  EXPECT_NEAR(result.arrivals[0].missing, -100, 1e-6);
  EXPECT_EQ(result.missing, 0);
  EXPECT_NE(result.arrivals[1].reason.find("more trips leave"), std::string::npos);
}

TEST(District, DestinationsOutOfReachAreToldAndSoIsWhoGetsTheirTrips) {
  Town town = doubly();
  town.streets[2].is_open = false;
  const DistrictResult result = town.step();
  ASSERT_EQ(result.arrivals.size(), 2u);
  EXPECT_EQ(result.arrivals[0].zone, 0u);
  EXPECT_NEAR(result.arrivals[0].missing, -20, 1e-6);
  EXPECT_NE(result.arrivals[0].reason.find("cannot get to other zones"), std::string::npos);
  EXPECT_EQ(result.arrivals[1].zone, 2u);
  EXPECT_NEAR(result.arrivals[1].missing, 20, 1e-6);
  EXPECT_NEAR(result.missing, 20, 1e-6);
  EXPECT_NE(result.arrivals[1].reason.find("no trips can get here"), std::string::npos);
  double ending = 0;
  for (const auto& zone : result.zones) ending += zone.ending;
  EXPECT_NEAR(ending + result.lost, 120, 1e-6) << "nobody is lost without a word";
}

TEST(District, NothingAtAllIsNoError) {
  const auto empty = step_district({}, {});
  ASSERT_TRUE(empty.ok());
  EXPECT_EQ(empty->trips, 0);
  EXPECT_EQ(empty->gap, 0);
}

TEST(District, TheSteepestDelaysStayNumbers) {
  Town town;
  town.settings.alpha = 100;
  town.settings.beta = 20;
  for (auto& street : town.streets) street.capacity = 2e-3;
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
  const auto result = step_district({town.junctions, town.streets, town.rules, town.zones, town.settings}, town.state);
  ASSERT_FALSE(result.ok());
  EXPECT_EQ(result.error().place, "high:back");
}

// home - west - x - east, and x - north; east - north goes round. Every street takes 30 s but the way round, which takes 100.
struct Crossing : Town {
  Crossing() {
    junctions = {{"east", {600, 0, 0}, 0}, {"north", {300, 300, 0}, 0}, {"west", {0, 0, 0}, 0}, {"x", {300, 0, 0}, 0}};
    streets = {{"arm_east", "x", "east", 300, 10, 1000, 0, false, true, true},
               {"arm_north", "x", "north", 300, 10, 1000, 0, false, true, true},
               {"arm_west", "west", "x", 300, 10, 1000, 0, false, true, true},
               {"round", "east", "north", 1000, 10, 1000, 0, false, true, true}};
    zones = {{"home", {0, 0, 0}, 1, 0, {"west"}, true}, {"work", {300, 300, 0}, 0, 1, {"north"}}};
    settings.alpha = 0;
  }
  double time_to_work() { return step().zones[0].mean_time; }
  double driving_to(const std::string& junction) {
    const DistrictResult result = step();
    for (const auto& row : result.zones[0].reach)
      if (row.junction == junction) return row.driving;
    return -2;
  }
};

TEST(District, ForbiddenTurnsByHand) {
  Crossing town;
  EXPECT_NEAR(town.time_to_work(), 60, 1e-9);
  town.rules = {{"x", {{"arm_west", "arm_north"}}}};
  EXPECT_NEAR(town.time_to_work(), 120, 1e-9) << "on to the east, back, and to the right";
  DistrictResult result = town.step();
  EXPECT_EQ(result.rules[0].forbidden, 1);
  EXPECT_EQ(result.rules[0].reason, "");
  EXPECT_EQ(result.streets[0].flow_forth, 1);
  EXPECT_EQ(result.streets[0].flow_back, 1);
  EXPECT_EQ(result.junctions[3].flow, 2) << "who comes by twice is counted twice";
  town.rules.push_back({"east", {{"arm_east", "arm_east"}}});
  EXPECT_NEAR(town.time_to_work(), 160, 1e-9) << "nobody turns round in the east: 30 + 30 + 100";
  EXPECT_EQ(town.driving_to("x"), 30);
  EXPECT_EQ(town.driving_to("north"), 160);
  result = town.step();
  const auto& north = result.zones[0].reach[1];
  EXPECT_EQ(north.junction, "north");
  EXPECT_NEAR(north.walking, 600 / 1.34, 1e-9) << "on foot one may turn";
  town.rules.push_back({"east", {{"arm_east", "round"}}});
  result = town.step();
  EXPECT_EQ(result.zones[0].lost, 1);
  EXPECT_EQ(result.zones[0].reason, "no other zone that trips could end in can be reached");
  town.rules.clear();
  EXPECT_NEAR(town.time_to_work(), 60, 1e-9) << "the rules are lifted";
}

TEST(District, OnlyOneWayOnLeavesNoOther) {
  Crossing town;
  town.rules = {{"x", {{"arm_west", "arm_east", "only"}}}};
  EXPECT_NEAR(town.time_to_work(), 120, 1e-9);
  EXPECT_EQ(town.step().rules[0].forbidden, 2) << "to the north, and back";
  town.rules.push_back({"east", {{"arm_east", "round", "only"}}});
  EXPECT_NEAR(town.time_to_work(), 160, 1e-9) << "turning round is no longer allowed either";
  town.rules[0].turns.push_back({"arm_west", "arm_north", "only"});
  EXPECT_NEAR(town.time_to_work(), 60, 1e-9) << "two rules of this kind leave the choice between both";
  town.rules = {{"x", {{"arm_west", "arm_east", "only"}}}};
  town.streets[0].is_open = false;
  EXPECT_EQ(town.step().zones[0].lost, 1) << "the only way on is closed";
}

TEST(District, ZonesAtSplitJunctionsAreReachedFromAllSides) {
  Crossing town;
  town.rules = {{"x", {{"arm_west", "arm_north"}}}, {"x", {{"arm_east", "arm_west"}}}};
  town.zones[1].access = {"x"};
  EXPECT_NEAR(town.time_to_work(), 30 + 300 / 1.34, 1e-9);
  std::swap(town.zones[0].leaving, town.zones[1].leaving);
  std::swap(town.zones[0].arriving, town.zones[1].arriving);
  EXPECT_NEAR(town.step().zones[1].mean_time, 30 + 300 / 1.34, 1e-9) << "who sets out at the junction may go anywhere";
}

TEST(District, RulesThatCannotHoldSayWhyAndForbidNothing) {
  Crossing town;
  town.streets[1].is_one_way = true;
  town.rules = {{"x", {{"arm_west", "arm_nroth"}}},
                {"x", {{"round", "arm_north"}}},
                {"x", {{"", "arm_north"}}},
                {"x", {{"arm_north", "arm_east"}}},
                {"north", {{"round", "arm_north"}}},
                {"nowhere", {{"arm_west", "arm_north"}}},
                {"x", {{"arm_west", "arm_nroth", "only"}}},
                {"x", {{"arm_west", "arm_north", "never"}}}};
  const DistrictResult result = town.step();
  const auto said = [&](std::size_t r) { return result.rules[r].reason; };
  EXPECT_EQ(said(0), "turns/0/to: `arm_nroth` is no street of this network");
  EXPECT_EQ(said(1), "turns/0/from: `round` neither begins nor ends at `x`");
  EXPECT_EQ(said(2), "turns/0/from: it names no street");
  EXPECT_EQ(said(3), "turns/0/from: `arm_north` is one-way and leads away: nobody arrives by it");
  EXPECT_EQ(said(4), "turns/0/to: `arm_north` is one-way and leads here: nobody leaves by it");
  EXPECT_EQ(said(5), "turns/0/from: `arm_west` neither begins nor ends at `nowhere`");
  EXPECT_EQ(said(6), said(0));
  EXPECT_EQ(said(7), "turns/0/rule: `never` is no rule; write `no` or `only`");
  EXPECT_NEAR(result.zones[0].mean_time, 60, 1e-9);
  for (const auto& rules : result.rules) EXPECT_EQ(rules.forbidden, 0);
}

TEST(District, ASettledDistrictWithRulesStaysAsItIs) {
  Crossing town;
  town.settings.alpha = 0.15;
  town.zones[0].leaving = 1800;
  town.rules = {{"x", {{"arm_west", "arm_north"}}}};
  for (int i = 0; i < 20; ++i) town.step();
  const DistrictResult one = town.step(), two = town.step();
  EXPECT_LT(one.gap, 1e-10);
  EXPECT_GT(one.streets[3].flow_forth, 100) << "some go round";
  EXPECT_GT(one.streets[0].flow_back, 100) << "others turn round";
  EXPECT_NEAR(one.streets[3].flow_forth + one.streets[0].flow_back, 1800, 1e-9);
  for (std::size_t s = 0; s < one.streets.size(); ++s) EXPECT_NEAR(one.streets[s].flow_forth, two.streets[s].flow_forth, 1e-9);
  for (const DistrictState::Zone& zone : town.state.zones)
    for (const double flow : zone.flows) EXPECT_GT(flow, 0);
}

}  // namespace
}  // namespace bl::traffic
