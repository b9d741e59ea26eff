// Volumes on the roofs of others: clipped to the plate that carries them, exact as on the ground, and lost nowhere.
#include "core/geometry/standing_tick.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "core/base/random.h"
#include "core/geometry/domain_makers.h"
#include "core/geometry/site_domain.h"
#include "core/geometry/standing_text.h"

namespace bl::geometry {
namespace {

Domain plot(double width, double depth, double height = 60) {
  const std::vector<Point3> ring{{0, 0, 0}, {width, 0, 0}, {width, depth, 0}, {0, depth, 0}};
  return extrude_plan(ring, {}, 0, height).value();
}

StandingWish wish(FootprintForm form, Point3 at, int storeys, double floor_area, std::int32_t base = StandingWish::kGround) {
  StandingWish made;
  made.site.site.position = at;
  made.site.form = form;
  made.site.storey_height = 3;
  made.volume = 3 * floor_area;
  made.storeys = storeys;
  made.base = base;
  return made;
}

// Ticks until nothing is missed any more; the weights go on as ports do.
StandingTick::Outcome run(const Domain& domain, std::vector<StandingWish>& wishes, StandingTick::Cache& kept, int ticks = 6) {
  StandingTick::Outcome outcome;
  const StandingTick tick{.steps = 20, .tolerance = 1e-9};
  for (int k = 0; k < ticks; ++k) {
    outcome = tick.run(domain, wishes, kept).value();
    for (std::size_t i = 0; i < wishes.size(); ++i) {
      wishes[i].site.site.weight = outcome.results[i].weight;
      wishes[i].built = outcome.results[i].storeys.count;
      wishes[i].least_room = outcome.results[i].storeys.least_room;
    }
  }
  return outcome;
}

TEST(StandingTick, ATowerStandsOnAPodium) {
  std::vector<StandingWish> wishes{wish(FootprintForm::block, {30, 20, 0}, 2, 1200),
                                   wish(FootprintForm::block, {34, 20, 0}, 6, 1800, 0)};
  StandingTick::Cache kept;
  const auto outcome = run(plot(60, 40), wishes, kept);
  const StandingResult &podium = outcome.results[0], &tower = outcome.results[1];
  // 600 m² in two storeys; 300 m² in six, on a roof 6 m above the ground.
  EXPECT_NEAR(podium.footprint, 600, 1e-5);
  EXPECT_NEAR(tower.footprint, 300, 1e-5);
  EXPECT_NEAR(tower.floor_area, 1800, 1e-5);
  EXPECT_DOUBLE_EQ(tower.bottom, 6);
  EXPECT_DOUBLE_EQ(tower.height, 18);
  EXPECT_TRUE(podium.walls.empty()) << "they do not compete";
  EXPECT_NEAR(tower.free_facade_area, tower.facade_area, 1e-9);
  EXPECT_TRUE(outcome.on_roofs.empty());
}

// One has a set-back that only most of the plot, or not even all of it, would leave a plate: the others get what they want, from
// the first tick and from any later one, and nobody gets more.
TEST(StandingTick, WhoCanHaveNothingTakesNothingFromOthers) {
  for (const double setback : {26.0, 40.0}) {
    SCOPED_TRACE(setback);
    std::vector<StandingWish> wishes;
    for (const double x : {12.0, 36.0, 60.0})
      for (const double y : {12.0, 36.0}) wishes.push_back(wish(FootprintForm::block, {x, y, 0}, 3, 900));
    StandingTick::Cache kept;
    const auto expect_the_others = [&](const StandingTick::Outcome& outcome) {
      EXPECT_EQ(outcome.results[2].floor_area, 0);
      EXPECT_NE(outcome.message.find("1 of the demands can have nothing"), std::string::npos) << outcome.message;
      for (std::size_t i = 0; i < wishes.size(); ++i)
        if (i != 2) { EXPECT_NEAR(outcome.results[i].floor_area, 900, 1e-4) << i; }
      ASSERT_EQ(outcome.losses.size(), 1u);
      EXPECT_EQ(outcome.losses[0].demand, 2u);
    };
    wishes[2].setback = setback;
    expect_the_others(run(plot(72, 48), wishes, kept, 10));
    wishes[2].setback = 0;
    EXPECT_NEAR(run(plot(72, 48), wishes, kept, 10).results[2].floor_area, 900, 1e-4) << "it comes back";
    wishes[2].setback = setback;
    expect_the_others(run(plot(72, 48), wishes, kept, 10));
  }
}

// The same of five among twenty: within their set-back the plot has no ground, or so little that only the largest part of the
// plot would do, or they stand 200 m outside it. In each tick the other fifteen have what they want, also after one of them has
// moved.
TEST(StandingTick, FiveWhoCanHaveNothingStopNobody) {
  for (const int why : {0, 1, 2}) {
    SCOPED_TRACE(why);
    std::vector<StandingWish> wishes;
    for (int i = 0; i < 20; ++i)
      wishes.push_back(wish(FootprintForm::block, {7.2 + 14.4 * (i % 5), 6.0 + 12 * (i / 5), 0}, 3, 360));
    for (std::size_t i = 0; i < 20; i += 4) {
      if (why == 2) wishes[i].site.site.position.x += 300;
      else wishes[i].setback = why == 0 ? 26 : 20;
    }
    StandingTick::Cache kept;
    for (int move = 0; move < 3; ++move) {
      const auto outcome = run(plot(72, 48), wishes, kept, move == 0 ? 8 : 2);
      EXPECT_NE(outcome.message.find("5 of the demands can have nothing"), std::string::npos) << outcome.message;
      for (std::size_t i = 0; i < 20; ++i) {
        if (i % 4 == 0) {
          EXPECT_EQ(outcome.results[i].floor_area, 0) << i;
        } else {
          EXPECT_NEAR(outcome.results[i].floor_area, 360, 1e-4) << i << ", move " << move;
        }
      }
      EXPECT_EQ(outcome.losses.size(), 5u);
      wishes[7].site.site.position.x += 0.4;
    }
  }
}

// The boundary reaches from 0 to 20 m: a ground in it counts, one below it is its underside, and a storey is always left.
TEST(StandingTick, EachStandsAtTheHeightOfItsGround) {
  std::vector<StandingWish> wishes;
  for (const double x : {10.0, 30.0, 50.0, 70.0}) wishes.push_back(wish(FootprintForm::block, {x, 20, 0}, 4, 400));
  wishes.push_back(wish(FootprintForm::block, {30, 20, 0}, 2, 60, 1));
  wishes[0].ground = -3;
  wishes[1].ground = 2.5;
  wishes[2].ground = 12.5;
  wishes[3].ground = 90;
  wishes[4].ground = 7;  // on a roof it is without effect
  StandingTick::Cache kept;
  const auto outcome = run(plot(80, 40, 20), wishes, kept);
  const std::vector<double> bottoms{0, 2.5, 12.5, 17, 14.5};
  const std::vector<int> storeys{4, 4, 2, 1, 1};
  for (std::size_t i = 0; i < wishes.size(); ++i) {
    EXPECT_DOUBLE_EQ(outcome.results[i].bottom, bottoms[i]) << i;
    EXPECT_EQ(outcome.results[i].storeys.count, storeys[i]) << i;
    EXPECT_NEAR(outcome.results[i].floor_area, wishes[i].volume / 3, 1e-5) << i;
    EXPECT_DOUBLE_EQ(outcome.results[i].body->stacks.front().bottom, bottoms[i]) << i;
  }
  // The ground of one volume alone moves.
  wishes[2].ground = 11;
  const auto moved = StandingTick{.steps = 20, .tolerance = 1e-9}.run(plot(80, 40, 20), wishes, kept).value();
  EXPECT_TRUE(std::binary_search(moved.differing.begin(), moved.differing.end(), 2u));
  EXPECT_DOUBLE_EQ(moved.results[2].bottom, 11);
  EXPECT_EQ(moved.results[2].storeys.count, 3);
  EXPECT_NEAR(moved.results[2].floor_area, 400, 1e-5);
  EXPECT_DOUBLE_EQ(moved.results[1].bottom, 2.5);
}

// Two cells of 40 by 80 m, with wings of 10 m: they share 80 m of wall, and the courtyards of 20 by 60 m have walls of their own.
TEST(StandingTick, WallsOfCourtyardsAreSharedWithNobody) {
  std::vector<StandingWish> wishes;
  for (const double x : {20.0, 60.0}) {
    wishes.push_back(wish(FootprintForm::cell, {x, 40, 0}, 2, 2 * (40 * 80 - 20 * 60)));
    wishes.back().site.depth = 10;
    wishes.back().site.has_party_walls = true;
  }
  StandingTick::Cache kept;
  const auto outcome = run(plot(80, 80), wishes, kept);
  for (std::uint32_t i = 0; i < 2; ++i) {
    const StandingResult& house = outcome.results[i];
    EXPECT_NEAR(house.footprint, 40 * 80 - 20 * 60, 1e-6);
    ASSERT_EQ(house.walls.size(), 1u);
    EXPECT_NEAR(house.walls[0].second, 6 * 80, 1e-4);
    EXPECT_NEAR(house.free_facade_area, 6 * (80 + 2 * 40 + 2 * (20 + 60)), 1e-4);
    EXPECT_NEAR(house.facade_area, 6 * (2 * 40 + 2 * 80 + 2 * (20 + 60)), 1e-4);
  }
}

// A cell fills the roof: where it is clipped, half of it is beyond the edge, and the rest is what the roof has.
TEST(StandingTick, FootprintsOnARoofAreClippedToIt) {
  std::vector<StandingWish> wishes{wish(FootprintForm::block, {30, 20, 0}, 1, 400),
                                   wish(FootprintForm::block, {40, 20, 0}, 4, 600, 0)};
  StandingTick::Cache kept;
  const auto outcome = run(plot(60, 40), wishes, kept);
  const StandingResult& tower = outcome.results[1];
  EXPECT_NEAR(tower.footprint, 150, 1e-6);
  for (const PlateStack& stack : tower.body->stacks)
    for (const PlateRing& ring : stack.outlines)
      for (const PlateRing::Corner& corner : ring.corners) {
        EXPECT_LE(corner.at.x, 40 + 1e-7);
        EXPECT_NE(corner.beyond, PlateRing::kPlot);
      }
  // It stands at the edge, so half of its block would hang in the air: its weight is that of a larger block.
  EXPECT_GT(4 * tower.weight, 150 * 1.5);
}

TEST(StandingTick, TwoOnOneRoofShareItExactly) {
  std::vector<StandingWish> wishes{
      wish(FootprintForm::round, {30, 25, 0}, 3, 2400), wish(FootprintForm::cell, {26, 25, 0}, 3, 900, 0),
      wish(FootprintForm::cell, {34, 25, 0}, 3, 1500, 0), wish(FootprintForm::block, {10, 10, 0}, 4, 400)};
  StandingTick::Cache kept;
  const auto outcome = run(plot(60, 50), wishes, kept);
  // Of a round roof they get the chords, which lack next to nothing.
  EXPECT_NEAR(outcome.results[1].floor_area, 900, 0.05);
  EXPECT_NEAR(outcome.results[2].floor_area, 1500, 0.05);
  ASSERT_EQ(outcome.results[1].walls.size(), 1u);
  EXPECT_EQ(outcome.results[1].walls.front().first, 2u) << "neighbours are told by the numbers of all volumes";
  EXPECT_NEAR(outcome.results[0].floor_area, 2400, 1e-5);
}

TEST(StandingTick, LevelsFollowOneAnother) {
  std::vector<StandingWish> wishes{wish(FootprintForm::block, {30, 20, 0}, 4, 300, 2),
                                   wish(FootprintForm::block, {30, 20, 0}, 2, 1000),
                                   wish(FootprintForm::block, {30, 20, 0}, 3, 600, 1)};
  StandingTick::Cache kept;
  const auto outcome = run(plot(60, 40), wishes, kept);
  EXPECT_DOUBLE_EQ(outcome.results[2].bottom, 6);
  EXPECT_DOUBLE_EQ(outcome.results[0].bottom, 15);
  EXPECT_NEAR(outcome.results[0].floor_area, 300, 1e-5);
  // The boundary leaves the uppermost what is left of its height.
  const auto low = run(plot(60, 40, 21), wishes, kept);
  EXPECT_EQ(low.results[0].storeys.count, 2);
  EXPECT_NEAR(low.results[0].floor_area, 300, 1e-5);
}

TEST(StandingTick, TooMuchForARoofIsSaidOfThatRoof) {
  std::vector<StandingWish> wishes{wish(FootprintForm::block, {30, 20, 0}, 1, 300),
                                   wish(FootprintForm::block, {30, 20, 0}, 2, 900, 0)};
  StandingTick::Cache kept;
  const auto outcome = run(plot(60, 40), wishes, kept);
  ASSERT_EQ(outcome.on_roofs.size(), 1u);
  EXPECT_EQ(outcome.on_roofs.front().base, 0);
  EXPECT_NE(outcome.on_roofs.front().text.find("the demand cannot be met: "), std::string::npos) << outcome.on_roofs.front().text;
  ASSERT_EQ(outcome.losses.size(), 1u);
  EXPECT_EQ(outcome.losses.front().demand, 1u);
  EXPECT_NEAR(outcome.results[0].floor_area, 300, 1e-6) << "those below do not suffer";
}

// Of many volumes the one with an absurd place is named, on the ground and on a roof.
TEST(StandingTick, WhoCannotStandIsNamed) {
  std::vector<StandingWish> wishes{wish(FootprintForm::block, {20, 20, 0}, 2, 300),
                                   wish(FootprintForm::block, {40, 20, 0}, 2, 300),
                                   wish(FootprintForm::block, {2e8, 20, 0}, 2, 300)};
  const StandingTick tick{.steps = 20};
  StandingTick::Cache kept;
  const auto ground = tick.run(plot(60, 40), wishes, kept);
  ASSERT_FALSE(ground);
  EXPECT_EQ(ground.error().text(), "site 2 cannot stand: its position is not a place within 100 000 km");
  wishes[2].base = 1;
  StandingTick::Cache other;
  const auto roof = tick.run(plot(60, 40), wishes, other);
  ASSERT_TRUE(roof);
  ASSERT_EQ(roof->on_roofs.size(), 1u);
  EXPECT_EQ(roof->on_roofs[0].text, "site 2 cannot stand: its position is not a place within 100 000 km");
}

// The right half of the boundary is 30 m high, the left one 9 m: eight storeys stand in the one and reach out of the other, also
// on a roof, and only as long as the boundary is like that.
TEST(StandingTick, WhatReachesOutOfTheBoundaryIsToldByHowMuch) {
  const auto site = [](double left_height) {
    const std::vector<Point3> ring{{0, 0, 0}, {100, 0, 0}, {100, 50, 0}, {0, 50, 0}},
        right{{50, 0, 0}, {100, 0, 0}, {100, 50, 0}, {50, 50, 0}};
    return site_domain({ring, {}, 0, left_height, {{right, 0, 30}}, {}}).value();
  };
  std::vector<StandingWish> wishes{
      wish(FootprintForm::block, {25, 25, 0}, 8, 3200), wish(FootprintForm::block, {75, 25, 0}, 8, 3200),
      wish(FootprintForm::block, {50, 8, 0}, 2, 400), wish(FootprintForm::block, {50, 8, 0}, 2, 200, 2)};
  StandingTick::Cache kept;
  const auto outcome = run(site(9), wishes, kept);
  EXPECT_EQ(outcome.results[0].outside.storey, 4);
  EXPECT_DOUBLE_EQ(outcome.results[0].outside.height, 12);
  EXPECT_NEAR(outcome.results[0].outside.area, 400, 1e-3);
  EXPECT_EQ(outcome.results[1].outside, BoundaryReach());
  EXPECT_EQ(outcome.results[2].outside, BoundaryReach());
  EXPECT_EQ(outcome.results[3].outside.storey, 2) << "of its own storeys";
  EXPECT_NEAR(outcome.results[3].outside.area, 50, 1e-3) << "half of its plate";
  const std::vector<std::string> names{"left", "right", "podium", "tower"};
  EXPECT_EQ(
      other_storeys_text(wishes, outcome.results, kept.results, site(9), 1e-6, names),
      "; `left` reaches out of the boundary from storey 4 on, 12.0 m high, by up to 400.0 m² of a plate: lower its `storeys`, "
      "or move it; `tower` reaches out of the boundary from storey 2 on, 12.0 m high, by up to 50.0 m² of a plate: lower its "
      "`storeys`, or move it");
  const auto high = run(site(26), wishes, kept, 1);
  for (const StandingResult& result : high.results) EXPECT_EQ(result.outside, BoundaryReach());
  EXPECT_EQ(run(site(10), wishes, kept, 1).results[3].outside.storey, 2) << "it did not move";
  EXPECT_EQ(run(plot(100, 50, 30), wishes, kept, 1).results[3].outside, BoundaryReach());
}

// A street of 6 m parts a bar that lies across it: the sentence says how the bar is moved, with its name.
TEST(StandingTick, AFootprintInPiecesIsToldAndHowToMoveIt) {
  const std::vector<Point3> ring{{0, 0, 0}, {100, 0, 0}, {100, 50, 0}, {0, 50, 0}},
      street{{47, -5, 0}, {53, -5, 0}, {53, 55, 0}, {47, 55, 0}};
  const Domain parted = site_domain({ring, {}, 0, 30, {}, {{street, 0, 30}}}).value();
  std::vector<StandingWish> wishes{wish(FootprintForm::block, {50, 25, 0}, 2, 2400)};
  StandingTick::Cache kept;
  const auto outcome = run(parted, wishes, kept);
  const std::string text =
      other_storeys_text(wishes, outcome.results, kept.results, parted, 1e-6, std::vector<std::string>{"bar"});
  EXPECT_NE(text.find("`bar` stands in 2 pieces of "), std::string::npos) << text;
  EXPECT_NE(text.find("run SCENE --set bar/node.position='[x,y,0]' --save SCENE"), std::string::npos) << text;
}

// A depth that no footprint on the site can reach is told; 1000 m is how people say none.
TEST(StandingTick, ADepthLargerThanTheGroundIsTold) {
  std::vector<StandingWish> wishes{wish(FootprintForm::block, {25, 25, 0}, 2, 800),
                                   wish(FootprintForm::block, {75, 25, 0}, 2, 800)};
  wishes[0].site.depth = 60;
  wishes[1].site.depth = 1000;
  StandingTick::Cache kept;
  const Domain ground = plot(100, 50, 30);
  const auto text = [&] {
    const auto outcome = run(ground, wishes, kept);
    return other_storeys_text(wishes, outcome.results, kept.results, ground, 1e-6, std::vector<std::string>{"wide", "other"});
  };
  EXPECT_EQ(text(),
            "; the `depth` of `wide`, 60 m, is larger than the ground of the site, 50.0 m: it leaves no courtyard anywhere, "
            "and changes nothing");
  wishes[0].site.depth = 40;
  EXPECT_EQ(text(), "");
}

// What a street leaves of a bar beyond it is no piece of a building: a quarter of a square metre is not told, and not counted.
TEST(StandingTick, SliversAreNoPieces) {
  const std::vector<Point3> ring{{0, 0, 0}, {100, 0, 0}, {100, 50, 0}, {0, 50, 0}};
  const auto told = [&](const std::vector<double>& streets) {
    std::vector<PlanSolid> parts;
    for (const double x : streets) parts.push_back({{{x, -5, 0}, {x + 1, -5, 0}, {x + 1, 55, 0}, {x, 55, 0}}, 0, 30});
    const Domain parted = site_domain({ring, {}, 0, 30, {}, parts}).value();
    std::vector<StandingWish> wishes{wish(FootprintForm::cell, {50, 25, 0}, 2, 9000)};
    StandingTick::Cache kept;
    const auto outcome = run(parted, wishes, kept);
    return other_storeys_text(wishes, outcome.results, kept.results, parted, 1e-6, std::vector<std::string>{"bar"});
  };
  EXPECT_EQ(told({98.995}), "") << "beyond the street lies a strip of half a centimetre by fifty metres";
  const std::string two = told({50, 98.995});
  EXPECT_NE(two.find("`bar` stands in 2 pieces of 2400 to 2500 m²"), std::string::npos) << two;
}

// The sides of a boundary lean inwards by 45°: a cell as large as its ground reaches out of it everywhere.
TEST(StandingTick, ALeaningBoundaryIsReachedOutOf) {
  const std::vector<Point3> corners{{0, 0, 0},    {40, 0, 0},   {40, 40, 0},  {0, 40, 0},
                                    {15, 15, 15}, {25, 15, 15}, {25, 25, 15}, {15, 25, 15}};
  const Domain domain(convex_hull(corners).value());
  std::vector<StandingWish> wishes{wish(FootprintForm::round, {20, 20, 0}, 3, 300)};
  StandingTick::Cache kept;
  EXPECT_EQ(run(domain, wishes, kept).results[0].outside, BoundaryReach()) << "a disc of 5.6 m below 9 m";
  wishes[0].volume = 3 * 3 * 1200;
  const StandingResult& wide = run(domain, wishes, kept).results[0];
  // 1200 m² of a ground of 1600 m²; at 9 m the section is a square of 22 m. Chords of the disc lack a little.
  EXPECT_EQ(wide.outside.storey, 1);
  EXPECT_NEAR(wide.outside.area, wide.footprint - 22 * 22, 1);
}

// A podium that vanishes, and comes back.
TEST(StandingTick, WithoutARoofNothingIsLost) {
  std::vector<StandingWish> wishes{wish(FootprintForm::block, {30, 20, 0}, 2, 1200),
                                   wish(FootprintForm::block, {30, 20, 0}, 6, 1800, 0)};
  StandingTick::Cache kept;
  run(plot(60, 40), wishes, kept);
  const double weight = wishes[1].site.site.weight;
  const double demand = wishes[0].volume;
  wishes[0].volume = 0;
  const auto gone = run(plot(60, 40), wishes, kept);
  EXPECT_EQ(gone.results[1].state, SiteState::starved);
  EXPECT_EQ(gone.results[1].floor_area, 0);
  EXPECT_EQ(gone.results[1].weight, weight);
  ASSERT_EQ(gone.on_roofs.size(), 1u);
  EXPECT_NE(gone.on_roofs.front().text.find("has no roof"), std::string::npos);
  wishes[0].volume = demand;
  const auto back = run(plot(60, 40), wishes, kept, 12);
  EXPECT_NEAR(back.results[1].floor_area, 1800, 1e-5);
  EXPECT_TRUE(back.on_roofs.empty());
}

TEST(StandingTick, WhoWouldStandUponItselfStandsOnTheGround) {
  std::vector<StandingWish> wishes{
      wish(FootprintForm::block, {15, 20, 0}, 2, 400, 1), wish(FootprintForm::block, {45, 20, 0}, 2, 400, 0),
      wish(FootprintForm::block, {45, 20, 0}, 2, 200, 1), wish(FootprintForm::block, {30, 8, 0}, 1, 50, 3)};
  StandingTick::Cache kept;
  const auto outcome = run(plot(60, 40), wishes, kept);
  EXPECT_EQ(outcome.in_circles, (std::vector<std::uint32_t>{0, 1, 3}));
  for (const std::uint32_t i : outcome.in_circles) EXPECT_EQ(outcome.results[i].bottom, 0);
  EXPECT_DOUBLE_EQ(outcome.results[2].bottom, 6) << "what stands on one of them stays there";
  for (std::size_t i = 0; i < wishes.size(); ++i) EXPECT_NEAR(outcome.results[i].volume, wishes[i].volume, 1e-4);
}

// What is kept between ticks saves work and changes nothing: the same bits with an empty cache, whatever stands on whom.
TEST(StandingTickLaws, KeepingChangesNothing) {
  Random random(5);
  const Domain ground = plot(90, 70);
  std::vector<StandingWish> wishes;
  for (int i = 0; i < 6; ++i)
    wishes.push_back(wish(i % 2 == 0 ? FootprintForm::block : FootprintForm::round, {15 + 30.0 * (i % 3), 18 + 34.0 * (i / 3), 0},
                          2, random.uniform(300, 900)));
  for (int i = 0; i < 8; ++i) {
    const int base = i % 6;
    wishes.push_back(
        wish(FootprintForm::block,
             wishes[static_cast<std::size_t>(base)].site.site.position + Vector3{random.uniform(-4, 4), random.uniform(-4, 4), 0},
             4, random.uniform(100, 300), base));
  }
  StandingTick::Cache kept;
  const StandingTick tick{.steps = 3, .tolerance = 1e-6};
  for (int k = 0; k < 30; ++k) {
    StandingTick::Cache fresh;
    const auto again = tick.run(ground, wishes, fresh).value();
    const auto now = tick.run(ground, wishes, kept).value();
    for (std::size_t i = 0; i < wishes.size(); ++i) {
      const StandingResult &a = now.results[i], &b = again.results[i];
      ASSERT_EQ(a.weight, b.weight) << "tick " << k << ", volume " << i;
      ASSERT_EQ(a.floor_area, b.floor_area);
      ASSERT_EQ(a.bottom, b.bottom);
      ASSERT_TRUE(*a.body == *b.body) << "tick " << k << ", volume " << i;
      ASSERT_EQ(a.walls, b.walls);
      wishes[i].site.site.weight = a.weight;
      wishes[i].built = a.storeys.count;
    }
    const auto who = static_cast<std::size_t>(random.uniform(0, 14));
    if (k % 3 == 0) wishes[who].site.site.position += Vector3{random.uniform(-2, 2), random.uniform(-2, 2), 0};
    if (k % 5 == 0) wishes[who].storeys = 1 + static_cast<int>(random.uniform(0, 5));
    if (k % 7 == 6) wishes[6 + who % 8].base = static_cast<std::int32_t>(who % 6);
    if (k == 15) std::swap(wishes[0].volume, wishes[1].volume);
    if (k == 20) wishes[2].volume = 0;
  }
}

}  // namespace
}  // namespace bl::geometry
