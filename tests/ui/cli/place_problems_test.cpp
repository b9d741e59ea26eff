// What is said of bodies in the air and of volumes on one point.
#include "core/reading/place_problems.h"

#include <gtest/gtest.h>

#include <string>

#include "core/reading/report_model.h"
#include "tests/support/world.h"

namespace bl {
namespace {

std::string placed_scene(const std::string& volumes, const std::string& links = "") {
  return R"({"format": "behaviourlinks", "version": 1, "nodes": [)" + volumes +
         R"(, {"id": "site", "types": {"boundary": {"form": "plan", "plan": [[0,0,0],[60,0,0],[60,40,0],[0,40,0]], "height": 40}}},
            {"id": "solver", "types": {"smart_volumes_solver": {}}}],
            "links": [)" +
         links + "]}";
}

std::string volume_at(const std::string& id, const std::string& position, const std::string& more = "") {
  return R"({"id": ")" + id + R"(", "name": "The )" + id + R"(", "position": )" + position +
         R"(, "types": {"smart_volume": {"demand": 1000)" + more + "}}}";
}

// 1000 m³ are a ball of radius 6.2 m.
TEST(PlaceProblems, NamesWhatHangsWithItsHeight) {
  World world = World::from_text(placed_scene(volume_at("kiosk", "[10, 10, 5]") + "," + volume_at("nursery", "[40, 20, 20]") +
                                              "," + volume_at("shop", "[10, 10, 15]", R"(, "standing": "ground")")));
  ASSERT_TRUE(world.settle());
  const auto hanging = reading::hanging_volumes(world.state());
  ASSERT_EQ(hanging.size(), 2u);
  EXPECT_EQ(hanging[0].subject, "The nursery hangs 13.8 m above the ground");
  EXPECT_EQ(hanging[0].nodes, std::vector<std::string>{"nursery"});
  EXPECT_NE(hanging[0].text.find("nothing that stands carries it"), std::string::npos) << hanging[0].text;
  EXPECT_TRUE(hanging[1].subject.starts_with("The shop stands ")) << hanging[1].subject;
  EXPECT_NE(hanging[1].text.find("it stands on `kiosk`, and has to stand on the ground"), std::string::npos) << hanging[1].text;
  EXPECT_TRUE(reading::collapsed_volumes(world.state()).empty());
  // The report's list has them too, as no failure.
  reading::ReportModel model;
  reading::read_problems(world.state(), model);
  ASSERT_EQ(model.problems.size(), 2u);
  EXPECT_TRUE(model.problems[0].is_place);
  EXPECT_NE(model.problems[0].message.find("13.8 m above the ground"), std::string::npos);
}

// Two that stand and attract each other: no link makes room for such, and none is advised.
TEST(PlaceProblems, WhatHelpsIsWhatTheSceneAllows) {
  World world = World::from_text(R"({"format": "behaviourlinks", "version": 1, "nodes": [
    {"id": "site", "types": {"boundary": {"form": "plan", "plan": [[0,0,0],[60,0,0],[60,40,0],[0,40,0]], "height": 40}}},
    {"id": "solver", "types": {"standing_solver": {}}},
    {"id": "a", "position": [30, 20, 0], "types": {"smart_volume": {"demand": 900}, "footprint": {}}},
    {"id": "b", "position": [30.5, 20, 0], "types": {"smart_volume": {"demand": 900}, "footprint": {}}}], "links": [
    {"id": "pull", "kind": "attract", "from": "a", "to": "b"}]})");
  world.tick(3);
  const auto collapsed = reading::collapsed_volumes(world.state());
  ASSERT_EQ(collapsed.size(), 1u);
  EXPECT_EQ(collapsed[0].text.find("make_room"), std::string::npos) << collapsed[0].text;
  EXPECT_NE(collapsed[0].text.find("move them apart"), std::string::npos) << collapsed[0].text;
}

// The flats stand on the shop, which its set-back leaves no ground: that is what is wrong with both, and not that they share a
// place.
TEST(PlaceProblems, WhoStandsOnAVolumeWithoutABodyLiesOnNoPointWithIt) {
  const std::string text = R"({"format": "behaviourlinks", "version": 1, "nodes": [
    {"id": "site", "types": {"boundary": {"form": "plan", "plan": [[0,0,0],[60,0,0],[60,40,0],[0,40,0]], "height": 40}}},
    {"id": "solver", "types": {"standing_solver": {}}},
    {"id": "shop", "position": [30, 20, 0], "types": {"smart_volume": {"demand": 900}, "footprint": {"setback": 35}}},
    {"id": "flats", "position": [30, 20, 0], "types": {"smart_volume": {"demand": 900}, "footprint": {BASES}}}]})";
  const auto collapses = [&text](const std::string& bases) {
    World world = World::from_text(std::string(text).replace(text.find("BASES"), 5, bases));
    world.tick(5);
    EXPECT_EQ(world.number("shop", "smart_volume.floor_area"), 0);
    return reading::collapsed_volumes(world.state()).size();
  };
  EXPECT_EQ(collapses(R"("bases": ["shop"])"), 0u);
  EXPECT_EQ(collapses(""), 1u) << "on the ground they do";
}

TEST(PlaceProblems, WhoSharesAFootprintLiesOnNoPointWithItsHost) {
  const auto collapses = [](const std::string& shares) {
    World world = World::from_text(R"({"format": "behaviourlinks", "version": 1, "nodes": [
      {"id": "site", "types": {"boundary": {"form": "plan", "plan": [[0,0,0],[60,0,0],[60,40,0],[0,40,0]], "height": 40}}},
      {"id": "solver", "types": {"standing_solver": {}}},
      {"id": "shop", "position": [30, 20, 0], "types": {"smart_volume": {"demand": 900}, "footprint": {"storeys": 3}}},
      {"id": "flats", "position": [30, 20, 0], "types": {"smart_volume": {"demand": 1800}, "footprint": {)" +
                                   shares + R"(}}}], "links": []})");
    world.tick(5);
    return reading::collapsed_volumes(world.state()).size();
  };
  EXPECT_EQ(collapses(R"("shares": ["shop"])"), 0u);
  EXPECT_EQ(collapses(""), 1u);
}

TEST(PlaceProblems, TellsACollapseAsOneWithThosePulling) {
  World world = World::from_text(placed_scene(
      volume_at("a", "[20, 20, 6]") + "," + volume_at("b", "[22, 20, 6]") + "," + volume_at("c", "[20, 22, 6]") + "," +
          volume_at("far", "[50, 20, 6]"),
      R"({"id": "hug", "kind": "attract", "from": "a", "to": ["b", "c"], "parameters": {"rest": 0, "stiffness": 0.3}},
         {"id": "inside", "kind": "inside_boundary", "from": "site", "to": {"typification": "smart_volume"}},
         {"id": "off", "kind": "repel", "from": "a", "to": "b", "strength": 0.01},
         {"id": "silent", "kind": "attract", "from": "b", "to": "c", "muted": true})"));
  world.tick(60);
  const auto collapsed = reading::collapsed_volumes(world.state());
  ASSERT_EQ(collapsed.size(), 1u);
  EXPECT_EQ(collapsed[0].nodes, (std::vector<std::string>{"a", "b", "c"}));
  EXPECT_EQ(collapsed[0].links, std::vector<std::string>{"hug"});
  EXPECT_EQ(collapsed[0].subject, "3 volumes lie on one point, pulled by `hug`");
  EXPECT_EQ(reading::place_problems(world.state()).front().subject, collapsed[0].subject);
}

TEST(PlaceProblems, WhereAStandRunsItSaysWhatHoldsTheVolumeUp) {
  const std::string volumes = volume_at("lifted", "[20, 20, 20]", R"(, "standing": "ground")") + "," +
                              volume_at("high", "[20, 20, 38]", R"(, "standing": "ground")");
  const std::string stand = R"({"id": "standing", "kind": "stand", "from": "solver", "to": "lifted"})";
  const std::string pull =
      R"({"id": "hoist", "kind": "attract", "from": "lifted", "to": "high", "parameters": {"stiffness": 1}})";
  World world = World::from_text(placed_scene(volumes, stand + "," + pull));
  world.tick(3);
  const auto text_of = [](const State& state, const std::string& id) {
    for (const reading::PlaceProblem& problem : reading::hanging_volumes(state))
      if (problem.nodes.front() == id) return problem.text;
    return std::string();
  };
  const std::string running = text_of(world.state(), "lifted");
  EXPECT_EQ(running.find("add a `stand`"), std::string::npos) << running;
  EXPECT_NE(running.find("`standing` lets it down, but `hoist` holds it up"), std::string::npos) << running;
  EXPECT_NE(text_of(world.state(), "high").find("add a `stand`"), std::string::npos) << "nothing lets that one down";
  World alone = World::from_text(placed_scene(volumes, stand));
  alone.tick(1);
  const std::string sinking = text_of(alone.state(), "lifted");
  EXPECT_NE(sinking.find("`standing` still lets it down"), std::string::npos) << sinking;
}

TEST(PlaceProblems, SaysNothingBeforeTheFirstTick) {
  World world = World::from_text(placed_scene(volume_at("a", "[20, 20, 26]") + "," + volume_at("b", "[20, 20, 26]")));
  EXPECT_TRUE(reading::place_problems(world.state()).empty());
}

// On a roof a volume shares its place in plan with the one that carries it, and each has a body.
TEST(PlaceProblems, WhatStandsOnARoofLiesOnNoOnePoint) {
  World world = World::from_file("scenes/studies/tower_on_podium.json");
  ASSERT_TRUE(world.settle());
  EXPECT_TRUE(reading::place_problems(world.state()).empty());
}

}  // namespace
}  // namespace bl
