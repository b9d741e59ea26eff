// Receivers that are short of their sun: by how much, and who holds it.
#include "core/reading/sun_problems.h"

#include <gtest/gtest.h>

#include <string>

#include "core/reading/report_model.h"
#include "core/reading/survey.h"
#include "tests/support/world.h"

namespace bl::reading {
namespace {

// A garden of 10 by 10 m, with a wall south of it that stands already and takes the sun of the points that are near to it.
World walled_garden(const std::string& needs, const std::string& links = "") {
  return World::from_text(R"({"format": "behaviourlinks", "version": 1, "settings": {"latitude": 52, "longitude": 5}, "nodes": [
    {"id": "garden", "name": "The garden", "types": {"shadow_receiver": {"width": 10, "depth": 10, "spacing": 1)" +
                          needs + R"(}}},
    {"id": "sun", "types": {"sun_and_sky": {"date": "2026-03-21"}}},
    {"id": "study", "types": {"sun_study": {}}},
    {"id": "wall", "types": {"shadow_caster": {}, "existing_building":
      {"outline": [[-60, -8, 0], [60, -8, 0], [60, -6, 0], [-60, -6, 0]], "height": 4, "height_source": "tag"}}}], "links": [)" +
                          links + "]}");
}

std::string sun_told(const World& world) {
  const auto all = sun_shortages(world.state());
  return all.size() == 1 ? all[0].text : std::to_string(all.size()) + " shortages";
}

TEST(SunProblems, WhoHasWhatItAsksForIsNotListed) {
  for (const char* needs : {R"(, "required_sun": 0)", R"(, "required_sun": 28800, "required_share": 0.2)"}) {
    World world = walled_garden(needs);
    EXPECT_EQ(sun_shortages(world.state()).size(), 0u) << "nothing is measured before the first tick";
    ASSERT_TRUE(world.settle());
    EXPECT_EQ(sun_told(world), "0 shortages");
  }
}

TEST(SunProblems, WhatIsShortIsToldWithItsFiguresByAllWhoReadProblems) {
  World world = walled_garden(R"(, "required_sun": 28800)");
  ASSERT_TRUE(world.settle());
  const double share = world.number("garden", "shadow_receiver.share_met");
  ASSERT_GT(share, 0.3);
  ASSERT_LT(share, 0.99);
  const auto all = sun_shortages(world.state());
  ASSERT_EQ(all.size(), 1u);
  EXPECT_EQ(all[0].share, share);
  EXPECT_EQ(all[0].required_share, 1);
  const std::string& text = all[0].text;
  EXPECT_EQ(text.find("has 8.00 h of sun on "), 0u) << text;
  EXPECT_NE(text.find(" % of its area, where 100 % is asked for: its points lack "), std::string::npos) << text;
  EXPECT_NE(text.find("nothing holds it: lay a link of the kind `solar_right` from `garden` to the volumes"), std::string::npos)
      << text;
  ReportModel model;
  read_problems(world.state(), model);
  ASSERT_EQ(model.problems.size(), 1u);
  EXPECT_EQ(model.problems[0].place, "node The garden");
  EXPECT_TRUE(model.problems[0].is_shortage);
  EXPECT_EQ(model.problems[0].message, text);
  const Survey survey = survey_of(world.state());
  ASSERT_EQ(survey.problems.size(), 1u);
  EXPECT_EQ(survey.problems[0].place, "nodes/garden");
  EXPECT_EQ(survey.problems[0].message, text);
}

// Where even an empty site has less, no link brings it.
TEST(SunProblems, SunThatNobodyTakesIsNoTaskForALink) {
  World world = walled_garden(R"(, "required_sun": 72000)");
  ASSERT_TRUE(world.settle());
  const std::string text = sun_told(world);
  EXPECT_NE(text.find("has 20.00 h of sun on 0 % of its area, where 100 % is asked for"), std::string::npos) << text;
  EXPECT_NE(text.find("h where nobody takes any: lower `required_sun`, or choose another period at the sun"), std::string::npos)
      << text;
  EXPECT_EQ(text.find("lay a link"), std::string::npos) << text;
}

TEST(SunProblems, LinksThatHoldItAreNamedWithWhatTheySay) {
  // A tower that stands in the sun of the garden of a shipped scene, and gives way.
  World world = World::from_file("scenes/links/solar_right.json");
  ASSERT_TRUE(world.settle(400));
  ASSERT_LT(world.number("garden", "shadow_receiver.share_met"), 0.99);
  const std::string text = sun_told(world);
  EXPECT_NE(text.find("; link `l1_right` holds it, and lets them lack 0.34 h (`tolerance` and `play`): lower these"),
            std::string::npos)
      << text;
  ASSERT_EQ(world.submit(command<SetPort>({.node = "garden", .port = {"shadow_receiver.required_sun"}, .value = {"36000"}})), "");
  world.tick(12);
  EXPECT_NE(sun_told(world).find("; link `l1_right` holds it, and is still at work"), std::string::npos) << sun_told(world);
  ASSERT_EQ(world.submit(command<EnableLink>({.id = "l1_right", .enabled = false})), "");
  world.tick(2);
  EXPECT_NE(sun_told(world).find("; nothing holds it, because link `l1_right` is switched off or muted"), std::string::npos)
      << sun_told(world);
}

// What the link cannot bring about is told by its own sentence.
TEST(SunProblems, ALinkThatCannotMeetItIsNamed) {
  World world = World::from_file("scenes/links/solar_right.json");
  ASSERT_EQ(world.submit(command<SetLinkParameter>({.id = "l1_right", .parameter = "least", .value = {"1"}})), "");
  world.tick(60);
  world.settle(300);
  EXPECT_NE(world.link_error("l1_right").find("cannot be met"), std::string::npos) << world.link_error("l1_right");
  EXPECT_NE(sun_told(world).find("; link `l1_right` holds it, and cannot meet it: its own sentence says why"), std::string::npos)
      << sun_told(world);
}

}  // namespace
}  // namespace bl::reading
