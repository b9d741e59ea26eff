// Who holds a limit, and which tensions are conflicts: the tightest limit alone, and only where somebody loses by it.
#include <gtest/gtest.h>

#include <string>

#include "core/reading/report_model.h"
#include "core/reading/storeys.h"
#include "core/reading/survey.h"
#include "tests/support/world.h"

namespace bl::reading {
namespace {

World tower_with_plot(const std::string& height_max) {
  std::string text = project_file("scenes/studies/tower_and_garden.json");
  text.insert(text.find("\"nodes\": [") + 10,
              R"({"id": "plot", "types": {"plot": {"polygon": [[0,0,0],[80,0,0],[80,44,0],[0,44,0]], "height_max": )" +
                  height_max + "}}},");
  text.insert(text.find("\"links\": [") + 10, R"({"id": "rules", "kind": "plot_rules", "from": "plot", "to": "tower"},)");
  return World::from_text(text);
}

std::string links_of(const std::vector<Pull>& pulls) {
  std::string text;
  for (const Pull& pull : pulls) text += (text.empty() ? "" : " ") + pull.link;
  return text;
}

TEST(Holders, TheTightestLimitAloneIsInTheConflict) {
  for (const auto& [height_max, holder, share] : {std::tuple{"13", "rules", 0.6}, std::tuple{"30", "sun", 0.2}}) {
    World world = tower_with_plot(height_max);
    ASSERT_TRUE(world.settle(500));
    const std::uint32_t tower = world.state().plan->node_index("tower");
    const std::string why = why_lower(world.state(), tower);
    EXPECT_NE(why.find("link `" + std::string(holder) + "`"), std::string::npos) << why;
    EXPECT_EQ(why.find(" and "), std::string::npos) << why;
    ReportModel model;
    read_conflicts(world.state(), model);
    ASSERT_EQ(model.conflicts.size(), 1u);
    EXPECT_EQ(model.conflicts[0].links, (std::vector<std::string>{holder, ""})) << "and the storeys that are wished";
    EXPECT_NEAR(model.conflicts[0].severity, share, 1e-12) << "what is lost, as a share of what is wished";
    const Survey survey = survey_of(world.state());
    ASSERT_FALSE(survey.tensions.empty());
    EXPECT_FALSE(survey.tensions[0].is_minor);
    EXPECT_EQ(links_of(survey.tensions[0].pulls), holder);
  }
}

// The tower is two volumes, and the sun holds the upper one: the storeys are those of the building.
TEST(Holders, ABuildingIsToldOnceWithWhoHoldsIt) {
  std::string text = project_file("scenes/studies/tower_and_garden.json");
  text.insert(text.find("\"nodes\": [") + 10, R"({"id": "upper", "position": [32, 30, 0], "types": {"shadow_caster": {},
    "smart_volume": {"use": "office"}, "footprint": {"order": 1}}},)");
  text.insert(text.find("\"links\": [") + 10, R"({"id": "above", "kind": "share_footprint", "from": "tower", "to": "upper"},)");
  World world = World::from_text(text);
  ASSERT_TRUE(world.settle(500));
  const Plan& plan = *world.state().plan;
  EXPECT_NE(why_lower(world.state(), plan.node_index("tower")).find("8 of 10 storeys: link `sun` (Solar right) leaves 2"),
            std::string::npos)
      << why_lower(world.state(), plan.node_index("tower"));
  EXPECT_EQ(why_lower(world.state(), plan.node_index("upper")), "");
  ReportModel model;
  read_conflicts(world.state(), model);
  ASSERT_EQ(model.conflicts.size(), 1u);
  EXPECT_EQ(model.conflicts[0].node_id, "upper");
  EXPECT_EQ(model.conflicts[0].links, (std::vector<std::string>{"sun", ""}));
  EXPECT_NEAR(model.conflicts[0].severity, 0.2, 1e-12);
}

// Two limits of which neither takes a storey: that they differ is nobody's loss.
TEST(Holders, ALimitThatTakesNothingIsNoConflict) {
  const std::string scene = R"({"format": "behaviourlinks", "version": 1, "nodes": [
    {"id": "v", "position": [20, 20, 0], "types": {"smart_volume": {"demand": 3600}, "footprint": {"storeys": 4}}},
    {"id": "a", "types": {"control": {"value": 9000, "maximum": 20000, "unit": "m3"}}}, {"id": "b", "types": {"control": {"value": 12000, "maximum": 20000, "unit": "m3"}}},
    {"id": "site", "types": {"boundary": {"form": "plan", "plan": [[0,0,0],[40,0,0],[40,40,0],[0,40,0]], "height": 40}}},
    {"id": "solver", "types": {"standing_solver": {}}}], "links": [
    {"id": "l1", "kind": "map_value", "from": "a", "to": "v", "parameters": {"target": "smart_volume.demand_limit"}},
    {"id": "l2", "kind": "map_value", "from": "b", "to": "v", "parameters": {"target": "smart_volume.demand_limit"}}]})";
  World world = World::from_text(scene);
  ASSERT_TRUE(world.settle());
  EXPECT_GT(world.tension("v", "smart_volume.demand_limit"), 1000);
  ReportModel model;
  read_conflicts(world.state(), model);
  EXPECT_TRUE(model.conflicts.empty());
  EXPECT_EQ(model.minor_conflicts, 0u);
}

}  // namespace
}  // namespace bl::reading
