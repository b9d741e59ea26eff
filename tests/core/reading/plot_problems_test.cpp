// Rules of plots that are broken: found, allowed, by whom, and which link holds them.
#include "core/reading/plot_problems.h"

#include <gtest/gtest.h>

#include <string>

#include "core/reading/report_model.h"
#include "core/reading/survey.h"
#include "tests/support/world.h"

namespace bl::reading {
namespace {

// Two volumes that stand on 40 by 40 m, with 12 and 6 m of height.
World world_with(const std::string& rules, const std::string& links = "") {
  return World::from_text(
      R"({"format": "behaviourlinks", "version": 1, "nodes": [
    {"id": "high", "position": [12, 20, 0], "types": {"smart_volume": {"demand": 3600, "storey_height": 3}, "footprint": {"storeys": 4}}},
    {"id": "low", "position": [28, 20, 0], "types": {"smart_volume": {"demand": 1200, "storey_height": 3}, "footprint": {"storeys": 2}}},
    {"id": "plot", "name": "The plot", "types": {"plot": {"polygon": [[0,0,0],[40,0,0],[40,40,0],[0,40,0]])" +
      rules + R"(}}},
    {"id": "site", "types": {"boundary": {"form": "plan", "plan": [[0,0,0],[40,0,0],[40,40,0],[0,40,0]], "height": 40}}},
    {"id": "solver", "types": {"standing_solver": {}}}], "links": [)" +
      links + "]}");
}

std::vector<BrokenRule> broken_in(World& world) {
  EXPECT_TRUE(world.settle());
  return broken_rules(world.state());
}

TEST(PlotProblems, KeptRulesAreNotListed) {
  World world = world_with(R"(, "fsi_max": 1, "gsi_max": 0.4, "height_max": 12)");
  EXPECT_TRUE(broken_in(world).empty());
}

// 1600 m² of floor area on 1600 m² of land; 300 and 200 m² of ground; 12 m.
TEST(PlotProblems, EachRuleIsToldWithWhatWasFoundAndByWhom) {
  World world = world_with(R"(, "fsi_max": 0.8, "gsi_max": 0.25, "height_max": 9)");
  const auto broken = broken_in(world);
  ASSERT_EQ(broken.size(), 3u);
  const std::string what_to_do = "; nothing holds it: lay a link of the kind `plot_rules` from `plot` to the volumes";
  EXPECT_EQ(broken[0].port, "fsi_max");
  EXPECT_NEAR(broken[0].found, 1, 1e-4);
  EXPECT_EQ(broken[0].text, "FSI 1.00 of 0.80 allowed, by `high` (1200\u00a0m²) and `low` (400\u00a0m²)" + what_to_do);
  EXPECT_EQ(broken[1].text, "GSI 0.31 of 0.25 allowed, by `high` (300\u00a0m²) and `low` (200\u00a0m²)" + what_to_do);
  EXPECT_EQ(broken[2].text, "a height of 12.0 m of 9.0 m allowed, by `high` (12.0\u00a0m)" + what_to_do);
  EXPECT_EQ(broken[2].volumes, std::vector<std::string>{"high"});
  // One source for all who read problems.
  ReportModel model;
  read_problems(world.state(), model);
  ASSERT_EQ(model.problems.size(), 3u);
  EXPECT_EQ(model.problems[1].place, "node The plot");
  EXPECT_TRUE(model.problems[1].is_rule);
  EXPECT_EQ(model.problems[1].message, broken[1].text);
  const Survey survey = survey_of(world.state());
  ASSERT_EQ(survey.problems.size(), 3u);
  EXPECT_EQ(survey.problems[0].place, "nodes/plot");
  EXPECT_EQ(survey.problems[0].message, broken[0].text);
}

TEST(PlotProblems, ASetBackIsToldWithItsDistance) {
  World world = world_with(R"(, "setback": 8)");
  const auto broken = broken_in(world);
  ASSERT_EQ(broken.size(), 1u);
  EXPECT_EQ(broken[0].port, "setback");
  EXPECT_LT(broken[0].found, 8);
  EXPECT_EQ(broken[0].allowed, 8);
  EXPECT_TRUE(broken[0].text.find("m of 8.00 m asked for, by `high`") != std::string::npos) << broken[0].text;
}

// Nobody builds to less than a millimetre, and a fit ends before.
TEST(PlotProblems, LengthsThatMissARuleByLessThanAMillimetreKeepIt) {
  const auto with_setback = [](const std::string& setback) {
    World world = World::from_text(R"({"format": "behaviourlinks", "version": 1, "nodes": [
      {"id": "house", "position": [10, 10, 0], "types": {"smart_volume": {"demand": 1764, "storey_height": 3},
       "footprint": {"form": "cell", "storeys": 3, "border_distance": 3, "street_distance": 3}}},
      {"id": "plot", "types": {"plot": {"polygon": [[0,0,0],[20,0,0],[20,20,0],[0,20,0]], "height_max": )" +
                                   setback + R"(, "setback": )" + setback + R"(}}},
      {"id": "site", "types": {"boundary": {"form": "plan", "plan": [[0,0,0],[20,0,0],[20,20,0],[0,20,0]], "height": 40}}},
      {"id": "solver", "types": {"standing_solver": {}}}]})");
    std::vector<std::string> ports;
    for (const BrokenRule& rule : broken_in(world)) ports.push_back(rule.port);
    return ports;
  };
  EXPECT_EQ(with_setback("3.0001"), std::vector<std::string>{"height_max"}) << "9 m of 3 m, and 0.1 mm of the set-back";
  EXPECT_EQ(with_setback("3.002"), (std::vector<std::string>{"height_max", "setback"}));
  EXPECT_EQ(with_setback("8.9999"), std::vector<std::string>{"setback"}) << "a height of 9 m";
  EXPECT_EQ(with_setback("8.998"), (std::vector<std::string>{"height_max", "setback"}));
}

// In a plot that is not convex distances are kept to ten nanometres: who keeps them is not named beside who does not.
TEST(PlotProblems, WhoKeepsASetBackToTheGridIsNotNamed) {
  const std::string outline = "[[0,0,0],[47.3,5.7,0],[51.1,48.9,0],[27.7,22.3,0],[-3.1,44.9,0]]";
  std::string text = R"({"format": "behaviourlinks", "version": 1, "nodes": [
    {"id": "breaker", "position": [6, 9, 0],
     "types": {"smart_volume": {"demand": 900, "storey_height": 3}, "footprint": {"storeys": 3}}},
    {"id": "plot", "types": {"plot": {"polygon": )" +
                     outline + R"(, "setback": 3}}},
    {"id": "site", "types": {"boundary": {"form": "plan", "plan": )" +
                     outline + R"(, "height": 40}}},
    {"id": "solver", "types": {"standing_solver": {}}})";
  for (const char* place : {"40, 12", "43, 30", "8, 30", "22, 13"})
    text += R"(, {"id": "keeper_)" + std::to_string(text.size()) + R"(", "position": [)" + place +
            R"(, 0], "types": {"smart_volume": {"demand": 900, "storey_height": 3},
             "footprint": {"storeys": 2, "border_distance": 3, "street_distance": 3}}})";
  World world = World::from_text(text + "]}");
  const auto broken = broken_in(world);
  ASSERT_EQ(broken.size(), 1u);
  EXPECT_EQ(broken[0].port, "setback");
  EXPECT_EQ(broken[0].volumes, std::vector<std::string>{"breaker"}) << broken[0].text;
}

TEST(PlotProblems, WhoHoldsARuleIsNamed) {
  const std::string rules = R"(, "fsi_max": 0.8, "height_max": 9)";
  const auto text = [&rules](const std::string& link) {
    World world = world_with(rules, R"({"id": "l1", "kind": "plot_rules", "from": "plot", )" + link + "}");
    world.tick(3);
    const auto broken = broken_rules(world.state());
    return broken.empty() ? std::string() : broken[0].text.substr(broken[0].text.find(';'));
  };
  EXPECT_EQ(text(R"("to": ["high", "low"])"), "; link `l1` holds it, and is still at work");
  EXPECT_EQ(text(R"("to": ["high"])"),
            "; link `l1` holds it, and is still at work; it does not lead to `low`: add what is missing to its end");
  EXPECT_EQ(text(R"("to": ["high", "low"], "muted": true)"), "; nothing holds it, because link `l1` is switched off or muted");
  EXPECT_EQ(text(R"("to": ["high", "low"], "parameters": {"hold_fsi": false})"),
            "; nothing holds it, because link `l1` has `hold_fsi` switched off");
}

TEST(PlotProblems, ALinkThatHoldsThemAllLeavesNoneBroken) {
  World world = world_with(R"(, "fsi_max": 0.8, "gsi_max": 0.5, "height_max": 9)",
                           R"({"id": "l1", "kind": "plot_rules", "from": "plot", "to": ["high", "low"]})");
  EXPECT_TRUE(broken_in(world).empty());
}

}  // namespace
}  // namespace bl::reading
