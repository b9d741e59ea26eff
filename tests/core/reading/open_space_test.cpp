// Open space: what briefs ask for, what boundaries keep open, and why there is less.
#include <gtest/gtest.h>

#include "core/reading/account.h"
#include "core/reading/figures_memo.h"
#include "core/reading/survey.h"
#include "tests/nodes/scene_text.h"
#include "tests/support/world.h"

namespace bl::reading {
namespace {

// A plan of 100 m by 50 m that keeps a rectangle open for `use`, and a brief that asks for housing and for 600 m² of garden.
std::string open_scene(const std::string& use, double west, double east, bool is_open = true) {
  std::string rows;
  for (const auto& [x, y] : {std::pair{west, 0.0}, {east, 0.0}, {east, 20.0}, {west, 20.0}})
    rows += (rows.empty() ? "" : ", ") + (R"({"name": "lawn", "use": ")" + use + R"(", "x": )" + std::to_string(x)) +
            R"(, "y": )" + std::to_string(y) + R"(, "bottom": 0, "top": 20})";
  return scene_text(R"({"id": "site", "types": {"boundary": {"form": "plan", "plan": [[0,0,0],[100,0,0],[100,50,0],[0,50,0]],
        "exclusions": [)" +
                    rows + R"(]}}},
      {"id": "brief", "types": {"programme": {"rows": [{"use": "housing", "floor_area": 900}, {"use": "garden", "floor_area": 200, "count": 3}]}}},
      {"id": "use_garden", "types": {"use": {"use": "garden", "is_open": )" +
                    std::string(is_open ? "true" : "false") + R"(}}},
      {"id": "house", "position": [70, 30, 0], "types": {"smart_volume": {"use": "housing"}, "footprint": {"storeys": 2}}},
      {"id": "solver", "types": {"standing_solver": {}}}], "links": [{"id": "deal", "kind": "demand", "from": "brief", "to": "house"})");
}

Accounts settled_accounts(World& world) {
  EXPECT_TRUE(world.settle(200));
  return accounts_of(world.state());
}

TEST(OpenSpace, HasARowOfItsOwnAndIsNoFloorArea) {
  World world = World::from_text(open_scene("garden", 0, 30));
  const Accounts accounts = settled_accounts(world);
  ASSERT_EQ(accounts.open.size(), 1u);
  EXPECT_EQ(accounts.open[0].use, "garden");
  EXPECT_TRUE(accounts.open[0].is_in_programme);
  EXPECT_EQ(accounts.open[0].asked, 600);
  EXPECT_NEAR(accounts.open[0].area, 600, 1e-9);
  EXPECT_EQ(why_short(accounts.open[0], accounts.tolerance), "");
  ASSERT_EQ(accounts.uses.size(), 1u);
  EXPECT_EQ(accounts.uses[0].use, "housing");
  EXPECT_EQ(accounts.all.brief_area, 900);
  EXPECT_EQ(world.link_error("deal"), "") << "no volume is missed";
  EXPECT_LE(accounts.worst_short, accounts.tolerance);
}

// Who raises the boundary above its exclusions is told why their ground does not count any more.
TEST(OpenSpace, GroundThatEndsBelowTheTopOfTheBoundaryIsTold) {
  std::string text = open_scene("garden", 0, 30);
  text.replace(text.find(R"("form": "plan")"), 14, R"("form": "plan", "height": 30)");
  World world = World::from_text(text);
  const Accounts accounts = settled_accounts(world);
  EXPECT_NEAR(accounts.open[0].area, 0, 1e-9);
  EXPECT_EQ(why_short(accounts.open[0], accounts.tolerance),
            "of the 600 m² that are drawn, 600 m² end below the top of the boundary, so that volumes may stand above them: raise "
            "the `top` of its `exclusions`");
}

// Maps and people write uses in small letters where a brief has large ones.
TEST(OpenSpace, IsTheSameInSmallAndInLargeLetters) {
  World world = World::from_text(open_scene("GARDEN", 0, 30));
  const Accounts accounts = settled_accounts(world);
  ASSERT_EQ(accounts.open.size(), 1u);
  EXPECT_EQ(accounts.open[0].use, "garden") << "as the brief writes it";
  EXPECT_NEAR(accounts.open[0].area, 600, 1e-9);
  std::string text = open_scene("garden", 0, 30);
  text.replace(text.find(R"("use": {"use": "garden")"), 23, R"("use": {"use": "Garden")");
  World other = World::from_text(text);
  EXPECT_EQ(settled_accounts(other).open, accounts.open);
  EXPECT_EQ(settled_accounts(other).uses.size(), 1u) << "the row asks for no floor area";
  EXPECT_EQ(other.link_error("deal"), "") << "nor for a volume";
}

TEST(OpenSpace, WhatIsMissingIsToldWithItsReason) {
  World small = World::from_text(open_scene("garden", 0, 20));
  Accounts accounts = settled_accounts(small);
  EXPECT_NEAR(accounts.open[0].missing_share(), 1.0 / 3, 1e-9);
  EXPECT_EQ(accounts.worst, "garden");
  EXPECT_EQ(why_short(accounts.open[0], accounts.tolerance).substr(0, 18), "400\xC2\xA0m² are drawn") << "that is all of it";
  World outside = World::from_text(open_scene("garden", -20, 10));
  accounts = settled_accounts(outside);
  EXPECT_NEAR(accounts.open[0].area, 200, 1e-9);
  EXPECT_NE(why_short(accounts.open[0], accounts.tolerance).find("lie outside of the boundary"), std::string::npos);
  World none = World::from_text(open_scene("", 0, 30));
  accounts = settled_accounts(none);
  EXPECT_EQ(accounts.open[0].area, 0);
  EXPECT_NE(why_short(accounts.open[0], accounts.tolerance).find("garden --open --use garden"), std::string::npos);
  const Survey survey = survey_of(none.state());
  ASSERT_EQ(survey.open.size(), 1u);
  const auto told = std::find_if(survey.problems.begin(), survey.problems.end(),
                                 [](const Error& problem) { return problem.place == "open space garden"; });
  ASSERT_NE(told, survey.problems.end());
  EXPECT_NE(told->message.find("600\xC2\xA0m² of open space are asked for, and 0\xC2\xA0m² are there"), std::string::npos)
      << told->message;
}

TEST(OpenSpace, GroundOfAUseThatIsNoOpenSpaceIsTold) {
  World world = World::from_text(open_scene("garden", 0, 30, false));
  (void)world.settle(200);
  const Accounts accounts = accounts_of(world.state());
  ASSERT_EQ(accounts.open.size(), 1u) << "nothing that is kept open is lost";
  EXPECT_FALSE(accounts.open[0].is_in_programme);
  const auto garden =
      std::find_if(accounts.uses.begin(), accounts.uses.end(), [](const UseAccount& u) { return u.use == "garden"; });
  ASSERT_NE(garden, accounts.uses.end());
  EXPECT_NE(why_short(world.state(), accounts, *garden).find("has `is_open`"), std::string::npos);
}

// Readers that follow a scene see ground and briefs change where no volume does.
TEST(OpenSpace, IsFollowedFromStateToState) {
  World world = World::from_text(open_scene("garden", 0, 30));
  (void)settled_accounts(world);
  FiguresMemo memo;
  EXPECT_NEAR(memo.of(world.session().state()).accounts.open[0].area, 600, 1e-9);
  ASSERT_EQ(world.submit(command<SetCell>({"brief", {"programme.rows"}, "garden", "floor_area", {"300"}})), "");
  world.tick(2);
  EXPECT_EQ(memo.of(world.session().state()).accounts.open[0].asked, 900);
  ASSERT_EQ(world.submit(command<SetPort>({.node = "site", .port = {"boundary.exclusions"}, .value = {"[]"}})), "");
  world.tick(2);
  EXPECT_EQ(memo.of(world.session().state()).accounts.open[0].area, 0);
  EXPECT_EQ(memo.last().accounts, accounts_of(world.state()));
}

}  // namespace
}  // namespace bl::reading
