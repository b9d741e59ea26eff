// The account of demands: what was asked for, by whoever asked, and who goes short of it; one for all displays.
#include "core/reading/account.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/random.h"
#include "core/reading/report_model.h"
#include "core/report/page.h"
#include "tests/support/world.h"

namespace bl::report {
namespace {

using reading::Accounts;

std::string scene_of(const std::string& nodes, const std::string& links) {
  return R"({"format": "behaviourlinks", "version": 1, "nodes": [{"id": "site", "types": {"boundary": {}}},
    {"id": "solver", "types": {"smart_volumes_solver": {}}})" +
         (nodes.empty() ? "" : ", " + nodes) + R"(], "links": [)" + links + "]}";
}

constexpr const char* kCapped =
    R"({"id": "hand", "name": "Hand", "position": [0, 0, 5], "types": {"smart_volume": {"demand": 1000}}},
  {"id": "total", "types": {"statistics": {"port": "smart_volume.floor_area"}}},
  {"id": "limited", "position": [-9, 0, 5], "types": {"smart_volume": {"demand": 600, "demand_limit": 400}}})";

// What a person has asked for and a limit cuts is short, brief or none.
TEST(Account, WhatPeopleAskForByHandCountsAgainstItsLimit) {
  World world = World::from_text(scene_of(kCapped, ""));
  world.tick(120);
  const reading::Accounts accounts = reading::accounts_of(world.state());
  ASSERT_EQ(accounts.volumes.size(), 2u);
  const reading::VolumeAccount &free = accounts.volumes[0], &cut = accounts.volumes[1];
  EXPECT_EQ(free.asked, 1000);
  EXPECT_FALSE(free.is_short(accounts.tolerance)) << free.short_share();
  EXPECT_EQ(cut.asked, 600);
  EXPECT_EQ(cut.limited, 400);
  EXPECT_NEAR(cut.volume, 400, 8);
  EXPECT_TRUE(cut.is_short(accounts.tolerance));
  EXPECT_NEAR(cut.short_share(), 1.0 / 3, 0.02);
  EXPECT_NE(reading::why_short(world.state(), accounts, cut).find("a limit set by hand leaves 400"), std::string::npos)
      << reading::why_short(world.state(), accounts, cut);
  EXPECT_EQ(reading::why_short(world.state(), accounts, free), "");
  EXPECT_EQ(accounts.worst, "volume limited");
  EXPECT_NEAR(accounts.worst_short, 1.0 / 3, 0.02);
  EXPECT_EQ(accounts.all.short_volumes, 1u);
}

constexpr const char* kBrief = R"({"id": "brief", "types": {"programme": {"rows": [
    {"use": "housing", "floor_area": 250, "storey_height": 3, "count": 2}, {"use": "office", "floor_area": 200, "storey_height": 3}]}}},
  {"id": "home_a", "position": [-8, 0, 5], "types": {"smart_volume": {"use": "housing"}}},
  {"id": "home_b", "position": [8, 0, 5], "types": {"smart_volume": {"use": "housing"}}})";

// A use that no volume has is short as a whole, with what to do; the others are counted on their own.
TEST(Account, AUseWithoutVolumesIsShortOfAllThatTheBriefAsks) {
  World world = World::from_text(scene_of(
      kBrief,
      R"({"id": "deal", "kind": "demand", "from": "brief", "to": {"typification": "smart_volume"}, "parameters": {"every_row": false}})"));
  world.tick(120);
  const reading::Accounts accounts = reading::accounts_of(world.state());
  ASSERT_EQ(accounts.uses.size(), 2u);
  EXPECT_EQ(accounts.uses[0].use, "housing");
  EXPECT_EQ(accounts.uses[0].asked_area, 500);
  EXPECT_EQ(accounts.uses[0].asked, 1500);
  EXPECT_EQ(accounts.uses[1].use, "office");
  EXPECT_EQ(accounts.uses[1].asked_area, 200);
  EXPECT_EQ(accounts.uses[1].short_share(), 1);
  EXPECT_NE(reading::why_short(world.state(), accounts, accounts.uses[1]).find("no volume has this use"), std::string::npos);
  EXPECT_EQ(accounts.all.asked_area, 700);
}

// The brief asks for floor area, and the solver gives floor area, whatever volume that takes; nothing of the volume is missing
// then.
TEST(Account, FloorAreaThatIsAskedForIsThere) {
  World world = World::from_text(scene_of(R"({"id": "brief", "types": {"programme": {"rows": [
      {"use": "theatre", "floor_area": 100, "storey_height": 8}]}}},
    {"id": "stage", "position": [0, 0, 8], "types": {"smart_volume": {"use": "theatre"}}})",
                                          R"({"id": "deal", "kind": "demand", "from": "brief", "to": "stage"})"));
  world.tick(150);
  const reading::Accounts accounts = reading::accounts_of(world.state());
  const reading::VolumeAccount& stage = accounts.volumes.front();
  EXPECT_TRUE(stage.is_by_area);
  EXPECT_NEAR(stage.floor_area, stage.asked_area, 0.006 * stage.asked_area);
  ASSERT_GT(std::abs(stage.volume - stage.asked), 0.02 * stage.asked) << "the case that is tested has gone; take another height";
  EXPECT_FALSE(stage.is_short(accounts.tolerance));
  EXPECT_LE(stage.missing(), accounts.tolerance * stage.asked);
  EXPECT_NEAR(stage.difference(), 0, 0.006);
  EXPECT_FALSE(accounts.uses.front().is_short(accounts.tolerance));
}

// A row without a use is nobody's: the link passes it over, and so does the account.
TEST(Account, ARowWithoutAUseAsksNobody) {
  World world = World::from_text(scene_of(
      R"({"id": "brief", "types": {"programme": {"rows": [{"use": "shop", "floor_area": 300}, {"use": "", "floor_area": 500}]}}},
      {"id": "v", "position": [-8, 0, 5], "types": {"smart_volume": {"use": "shop"}}},
      {"id": "w", "position": [9, 0, 5], "types": {"smart_volume": {"demand": 500}}})",
      R"({"id": "deal", "kind": "demand", "from": "brief", "to": {"typification": "smart_volume"}})"));
  world.tick(120);
  const reading::Accounts accounts = reading::accounts_of(world.state());
  EXPECT_EQ(reading::brief_of(world.state()).size(), 1u);
  for (const reading::UseAccount& use : accounts.uses)
    if (use.use.empty()) {
      EXPECT_FALSE(use.is_in_programme);
      EXPECT_EQ(use.asked, 500);
      EXPECT_FALSE(use.is_short(accounts.tolerance)) << use.short_share();
    }
}

// What two others have too much hides in the sum what one goes short of; the use says who, and why.
TEST(Account, AUseSaysWhichOfItsVolumesIsShort) {
  World world = World::from_text(scene_of(
      R"({"id": "big", "name": "Big", "position": [-8, 0, 8], "types": {"smart_volume": {"use": "a", "demand": 4000}}},
      {"id": "cut", "name": "Cut", "position": [12, 0, 5], "types": {"smart_volume": {"use": "a", "demand": 30, "demand_limit": 20}}})",
      ""));
  world.tick(150);
  const reading::Accounts accounts = reading::accounts_of(world.state());
  ASSERT_EQ(accounts.uses.size(), 1u);
  const reading::UseAccount& use = accounts.uses.front();
  ASSERT_FALSE(use.is_short(accounts.tolerance)) << use.short_share();
  ASSERT_EQ(use.short_volumes, 1u);
  const std::string why = reading::why_short(world.state(), accounts, use);
  EXPECT_TRUE(why.starts_with("`Cut` alone is short: a limit set by hand leaves 20")) << why;
}

// The law: in random scenes with briefs, hands, limits and links, figures fit together, the sums are those of their parts, and
// page and account call the same volumes short.
TEST(AccountLaw, FiguresFitTogetherInEveryScene) {
  Random random(12);
  const std::vector<std::string> uses = {"", "a", "b", "c"};
  for (int trial = 0; trial < 40; ++trial) {
    std::string nodes = R"({"id": "brief", "types": {"programme": {"rows": [{"use": "a", "floor_area": )" +
                        std::to_string(50 + random.below(300)) + R"(}, {"use": "b", "floor_area": 120, "count": 2}]}}})";
    const std::uint64_t count = random.below(6);
    for (std::uint64_t k = 0; k < count; ++k) {
      nodes += R"(, {"id": "v)" + std::to_string(k) + R"(", "position": [)" + std::to_string(random.uniform(-12, 12)) + ", " +
               std::to_string(random.uniform(-12, 12)) + R"(, 5], "types": {"smart_volume": {"use": ")" + uses[random.below(4)] +
               "\"";
      if (random.below(2) == 0) nodes += R"(, "demand": )" + std::to_string(random.below(2500));
      if (random.below(3) == 0) nodes += R"(, "demand_limit": )" + std::to_string(random.below(900));
      nodes += "}}}";
    }
    World world = World::from_text(scene_of(
        nodes, R"({"id": "deal", "kind": "demand", "from": "brief", "to": {"typification": "smart_volume"}, "strength": 0.7})"));
    world.tick(1 + static_cast<int>(random.below(40)));
    reading::ReportModel model;
    reading::read_model(world.state(), model);
    const reading::Accounts& accounts = model.accounts;
    reading::Account sum;
    double worst = 0;
    for (const reading::VolumeRow& volume : model.volumes) {
      sum.add(volume);
      worst = std::max(worst, volume.short_share());
      EXPECT_GE(volume.missing(), 0);
      EXPECT_LE(volume.short_share(), 1);
      EXPECT_EQ(volume.is_short(accounts.tolerance), volume.standing() < -accounts.tolerance);
      EXPECT_EQ(volume.is_short(accounts.tolerance), !reading::why_short(world.state(), accounts, volume).empty());
      if (volume.is_alive) {
        EXPECT_EQ(volume.is_short(accounts.tolerance), report::standing_of(volume, accounts.tolerance) == "short");
      }
    }
    std::size_t volumes = 0;
    double had = 0;
    for (const reading::UseAccount& use : accounts.uses) {
      volumes += use.volumes;
      had += use.volume;
      worst = std::max(worst, use.short_share());
      EXPECT_EQ(use.is_short(accounts.tolerance) || use.short_volumes > 0,
                !reading::why_short(world.state(), accounts, use).empty());
      if (use.is_in_programme) { EXPECT_GE(use.asked_area, use.brief_area * (1 - 1e-12)); }
    }
    EXPECT_EQ(volumes, model.volumes.size());
    EXPECT_EQ(had, accounts.all.volume);
    EXPECT_NEAR(had, sum.volume, 1e-9 * (1 + had));
    EXPECT_EQ(accounts.worst_short, worst);
    EXPECT_EQ(accounts.worst.empty(), worst == 0);
  }
}

// A plot has several rules: which one takes the volume is said.
TEST(Account, SaysWhichRuleOfAPlotLimitsAVolume) {
  World world = World::from_file("scenes/links/plot_rules.json");
  const auto why = [&] {
    world.tick(20);
    EXPECT_TRUE(world.settle());
    const reading::Accounts accounts = reading::accounts_of(world.state());
    return reading::why_short(world.state(), accounts, accounts.volumes.front());
  };
  const std::string by_area = why();
  EXPECT_EQ(by_area.find("link `l1_rules` (FSI) leaves "), 0u) << by_area;
  ASSERT_EQ(world.submit(command<SetPort>({.node = "plot", .port = {"plot.height_max"}, .value = {"15.5"}})), "");
  const std::string by_height = why();
  EXPECT_EQ(by_height.find("link `l1_rules` (height) leaves "), 0u) << by_height;
  ASSERT_EQ(world.submit(command<SetLinkParameter>({.id = "l1_rules", .parameter = "hold_height", .value = {"false"}})), "");
  const std::string without = why();
  EXPECT_EQ(without.find("link `l1_rules` (FSI) leaves "), 0u) << without;
}

}  // namespace
}  // namespace bl::report
