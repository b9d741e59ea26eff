// What failing parts of a scene leave standing, for others, for a save and after they have been mended.
#include <cmath>

#include <gtest/gtest.h>

#include "core/file/scene_file.h"
#include "tests/support/world.h"

namespace bl {
namespace {

World loaded(World& world) {
  const SavedState saved = save(world.state());
  return World::from_text(write_scene(world.session().scene(), full_registry(), &saved));
}

std::string add_boundary(World& world) {
  return world.submit(command<AddNode>(
      {"plot2", {R"({"types": {"boundary": {"form": "plan", "plan": [[0, 0, 0], [60, 0, 0], [60, 24, 0]]}}})"}}));
}

TEST(Failure, ShapesThatAFailingSolverLeavesAreSavedWithIt) {
  World world = World::from_file("scenes/nodes/sun_study.json");
  ASSERT_TRUE(world.settle());
  ASSERT_EQ(add_boundary(world), "");
  world.tick(3);
  ASSERT_TRUE(has_failure(world.state()));
  ASSERT_FALSE(save(world.state()).meshes.empty());
  World again = loaded(world);
  EXPECT_EQ(again.state().hash, world.state().hash);
  // The study follows rays among the shapes: it has to find the same ones.
  for (World* each : {&world, &again}) {
    ASSERT_EQ(each->submit(command<SetPort>({"sun", {"sun_and_sky.min_altitude"}, {"5"}})), "");
    each->tick(8);
  }
  EXPECT_GT(world.number("garden_north", "shadow_receiver.sun_mean"), 0);
  EXPECT_EQ(again.number("garden_north", "shadow_receiver.sun_mean"), world.number("garden_north", "shadow_receiver.sun_mean"));
  EXPECT_EQ(again.state().hash, world.state().hash);
  // Once all is well nothing of it is kept.
  ASSERT_EQ(world.submit(command<RemoveNode>({"plot2"})), "");
  world.tick(2);
  EXPECT_TRUE(save(world.state()).meshes.empty());
}

std::string one_sun(const std::string& settings) {
  return R"({"format": "behaviourlinks", "version": 1, "settings": {)" + settings +
         R"(}, "nodes": [{"id": "sun", "types": {"sun_and_sky": {}}}], "links": []})";
}

SceneReading sun_of(const std::string& settings, const std::string& sun) {
  return read_scene(R"({"format": "behaviourlinks", "version": 1, "settings": {)" + settings +
                        R"(}, "nodes": [{"id": "sun", "types": {"sun_and_sky": {)" + sun +
                        R"(}}}, {"id": "view", "types": {"media": {"latitude": 7}}}], "links": []})",
                    full_registry());
}

std::string problems_of(const std::string& settings, const std::string& sun) {
  std::string all;
  for (const Problem& problem : sun_of(settings, sun).problems) all += problem.error.text() + "\n";
  return all;
}

TEST(Failure, ASunThatStandsElsewhereThanItsSceneIsToldOf) {
  EXPECT_EQ(problems_of("", ""), "");
  EXPECT_EQ(problems_of(R"("latitude": 52, "longitude": 4.36)", ""), "");
  EXPECT_EQ(problems_of(R"("latitude": -33.9, "longitude": 4.36)", ""), "");  // it follows the scene
  const std::string south = problems_of(R"("latitude": -33.9, "longitude": 4.36)", R"("latitude": 52)");
  EXPECT_NE(south.find("nodes/sun/sun_and_sky/latitude"), std::string::npos) << south;
  EXPECT_EQ(south.find("media"), std::string::npos) << south;
}

TEST(Failure, TrueNorthIsSaidOnceForTheScene) {
  EXPECT_EQ(problems_of(R"("true_north": 90)", ""), "");
  // An older file says it at the node: it becomes the setting.
  const SceneReading older = sun_of("", R"("true_north": 12)");
  ASSERT_EQ(older.problems.size(), 1u);
  EXPECT_FALSE(older.problems[0].is_error);
  EXPECT_EQ(settings_of(older.scene).true_north, 12);
  EXPECT_TRUE(older.scene.nodes.at("sun").types.at("sun_and_sky").empty());
  const std::string differing = problems_of(R"("true_north": 90)", R"("true_north": 12)");
  EXPECT_NE(differing.find("nodes/sun/types/sun_and_sky/true_north: the scene's setting `true_north` is used instead"),
            std::string::npos)
      << differing;
  EXPECT_NE(problems_of("", R"("true_north": 400)").find("nodes/sun/types/sun_and_sky/true_north"), std::string::npos);

  // Of several the lowest place counts, whatever stands first, and a default says nothing.
  const auto of_two = [](const std::string& first, const std::string& second) {
    const auto node = [](const std::string& id, const std::string& north) {
      return R"({"id": ")" + id + R"(", "types": {"sun_and_sky": {"true_north": )" + north + "}}}";
    };
    const SceneReading reading =
        read_scene(R"({"format": "behaviourlinks", "version": 1, "nodes": [)" + node(first, first == "a" ? "0" : "20") + ", " +
                       node(second, second == "a"   ? "0"
                                    : second == "b" ? "10"
                                                    : "20") +
                       "]}",
                   full_registry());
    EXPECT_TRUE(reading.is_usable());
    return settings_of(reading.scene).true_north;
  };
  EXPECT_EQ(of_two("c", "b"), 10);
  EXPECT_EQ(of_two("a", "c"), 20);

  World world = World::from_text(R"({"format": "behaviourlinks", "version": 1, "nodes": [
    {"id": "sun", "locked": ["sun_and_sky.true_north"], "types": {"sun_and_sky": {}}}, {"id": "style", "types": {"facade_style": {}}}], "links": []})");
  world.tick();
  const Vector3 before = world.point("sun", "sun_and_sky.direction");
  EXPECT_NE(world.submit(command<LockPort>({"sun", {"sun_and_sky.true_north"}})).find("set it in the scene's settings"),
            std::string::npos);
  // Older logs set it at the node.
  ASSERT_EQ(world.submit(command<SetPort>({"sun", {"sun_and_sky.true_north"}, {"90"}})), "");
  world.tick();
  const Vector3 turned = world.point("sun", "sun_and_sky.direction");
  EXPECT_NEAR(turned.x, before.y, 1e-12);
  EXPECT_NEAR(turned.y, -before.x, 1e-12);
  EXPECT_EQ(world.number("style", "facade_style.true_north"), 90);
  ASSERT_EQ(world.submit(command<SetSetting>({"true_north", {"null"}})), "");
  world.tick();
  EXPECT_EQ(world.point("sun", "sun_and_sky.direction"), before);
}

TEST(Failure, TheSunStandsWhereTheSceneLiesUnlessItIsSetElsewhere) {
  const auto altitude = [](World& world) {
    world.tick();
    return world.number("sun", "sun_and_sky.transit_altitude");
  };
  World world = World::from_text(one_sun(""));
  const double at_52 = altitude(world);
  ASSERT_EQ(world.submit(command<SetSetting>({"latitude", {"48"}})), "");
  EXPECT_NEAR(altitude(world), at_52 + 4, 0.02);
  // The default of the port is a choice like any other: it stays, also in the file, until nothing is said here any more.
  ASSERT_EQ(world.submit(command<SetPort>({"sun", {"sun_and_sky.latitude"}, {"52"}})), "");
  EXPECT_NEAR(altitude(world), at_52, 1e-9);
  World loaded = World::from_text(write_scene(world.session().scene(), full_registry()));
  EXPECT_NEAR(altitude(loaded), at_52, 1e-9);
  ASSERT_EQ(world.submit(command<SetPort>({"sun", {"sun_and_sky.latitude"}, {"null"}})), "");
  EXPECT_NEAR(altitude(world), at_52 + 4, 0.02);
}

TEST(Failure, ASceneOnTheEquatorHasItsSunThere) {
  World world = World::from_text(one_sun(R"("latitude": 0, "longitude": 0)"));
  const std::string text = write_scene(world.session().scene(), full_registry());
  EXPECT_NE(text.find("\"latitude\": 0"), std::string::npos) << text;
  world.tick();
  EXPECT_GT(world.number("sun", "sun_and_sky.transit_altitude"), 88);
  ASSERT_EQ(world.submit(command<SetSetting>({"latitude", {"null"}})), "");
  world.tick();
  EXPECT_LT(world.number("sun", "sun_and_sky.transit_altitude"), 60);
  EXPECT_EQ(problems_of(R"("longitude": 60)", ""), "");  // nobody has said two things
}

TEST(Failure, RunningTablesMayHoldWhatNobodyCouldType) {
  const std::string text =
      R"({"format": "behaviourlinks", "version": 1, "nodes": [{"id": "z", "types": {"traffic_zone": {}}}], "links": [],
    "state": {"tick": 1, "calm": 0, "nodes": {"z": {"traffic_zone.reach": [{"junction": "j", "driving": 3e18}]}}}})";
  const SceneReading reading = read_scene(text, full_registry());
  EXPECT_TRUE(reading.problems.empty());
  EXPECT_TRUE(reading.state.has_value());
}

TEST(Failure, AMeshThatIsNoneIsAnErrorWithAPlace) {
  for (const char* mesh :
       {R"({})", R"(7)", R"({"vertices": [[0, 0]], "triangles": []})", R"({"vertices": [], "triangles": [[0, 0, 0]]})",
        R"({"vertices": [[0, 0, 0]], "triangles": [[0, 0, -1]]})", R"({"vertices": 1, "triangles": 2})"}) {
    const std::string text =
        std::string(R"({"format": "behaviourlinks", "version": 1, "nodes": [{"id": "a", "types": {"smart_volume": {}}}],
      "links": [], "state": {"tick": 1, "calm": 0, "nodes": {}, "meshes": {"a": {"smart_volume.mesh": )") +
        mesh + "}}}}";
    const SceneReading reading = read_scene(text, full_registry());
    ASSERT_EQ(reading.problems.size(), 1u) << mesh;
    EXPECT_NE(reading.problems[0].error.text().find("state/meshes"), std::string::npos) << mesh;
  }
}

// The error of a volume that wants next to nothing is a number beyond what anybody could set.
TEST(Failure, FiguresBeyondAllSettingsAreReadAgain) {
  World world = World::from_file("scenes/nodes/smart_volume.json");
  std::vector<std::string> volumes;
  for (const auto& [id, node] : world.session().scene().nodes)
    if (node.types.contains("smart_volume")) volumes.push_back(id);
  for (const std::string& id : volumes) ASSERT_EQ(world.submit(command<SetPort>({id, {"smart_volume.demand"}, {"1e-300"}})), "");
  world.tick(10);
  bool is_beyond = false;
  for (const auto& [node, values] : save(world.state()).nodes)
    for (const auto& [path, value] : values)
      if (const auto* number = std::get_if<double>(&value)) is_beyond = is_beyond || std::abs(*number) > 1e15;
  EXPECT_TRUE(is_beyond) << "the case does not show what it is for";
  EXPECT_EQ(loaded(world).state().hash, world.state().hash);
}

TEST(Failure, AStudyThatStopsWaitingTakesTheNewestResult) {
  World world = World::from_file("scenes/nodes/sun_study.json");
  world.tick(3);
  ASSERT_EQ(world.submit(command<SetPort>({"study", {"sun_study.latency"}, {"0"}})), "");
  world.tick(4);
  EXPECT_FALSE(has_failure(world.state()));
  EXPECT_EQ(loaded(world).state().hash, world.state().hash);
  EXPECT_TRUE(world.settle());
}

TEST(Failure, ASelectionThatIsMendedClearsTheErrorOfItsAnalysis) {
  World world = World::from_file("scenes/nodes/sun_study.json");
  ASSERT_TRUE(world.settle());
  ASSERT_EQ(world.submit(command<SetPort>({"study", {"sun_study.buildings"}, {R"(["old_mill", "garden_east"])"}})), "");
  world.tick(3);
  EXPECT_TRUE(has_failure(world.state()));
  ASSERT_TRUE(world.session().undo("test").ok());
  EXPECT_TRUE(world.settle());
  EXPECT_FALSE(has_failure(world.state()));
}

TEST(Failure, WhoLeavesAnAnalysisGetsNoneOfItsResults) {
  World world = World::from_file("scenes/nodes/sun_study.json");
  ASSERT_TRUE(world.settle());
  ASSERT_GT(world.number("garden_east", "shadow_receiver.sun_mean"), 0);
  ASSERT_EQ(world.submit(command<SetPort>({"sun", {"sun_and_sky.min_altitude"}, {"5"}})), "");
  world.tick();
  ASSERT_EQ(world.submit(command<SetPort>({"study", {"sun_study.receivers"}, {R"(["garden_north"])"}})), "");
  world.tick(12);
  EXPECT_GT(world.number("garden_north", "shadow_receiver.sun_mean"), 0);
  EXPECT_EQ(world.number("garden_east", "shadow_receiver.sun_mean"), 0);
}

// Three nodes follow a terrain, one of them stands beside it.
TEST(Failure, OnePairThatFailsDoesNotStopTheOthers) {
  World world = World::from_file("scenes/links/terrain_follow.json");
  world.tick(2);
  std::string link;
  for (const auto& [id, record] : world.session().scene().links)
    if (record.kind == "terrain_follow") link = id;
  ASSERT_EQ(world.submit(command<AddNode>({"inside", {R"({"position": [20, 20, 500], "tags": ["both"]})"}})), "");
  ASSERT_EQ(world.submit(command<AddNode>({"astray", {R"({"position": [90000, 0, 500], "tags": ["both"]})"}})), "");
  const LinkRecord ends = world.session().scene().links.at(link);
  ASSERT_EQ(world.submit(command<SetLinkEnds>({.id = link, .from = ends.from, .to = {{}, "", {"both"}}})), "");
  ASSERT_TRUE(world.session().scene().nodes.contains("inside"));
  world.tick(3);
  EXPECT_NE(world.link_error(link).find("there is no ground"), std::string::npos) << world.link_error(link);
  EXPECT_LT(world.point("inside", "node.position").z, 499);
  EXPECT_EQ(world.point("astray", "node.position").z, 500);
}

// The plot's polygon meets itself, so that its figures are of the past: limits that follow from them must not slide on.
TEST(Failure, LinksHoldWhatTheyWantedWhileTheirSourceHasAnError) {
  World world = World::from_file("scenes/links/plot_rules.json");
  ASSERT_TRUE(world.settle());
  ASSERT_EQ(world.submit(command<SetPort>({"plot", {"plot.polygon"}, {"[[0, 0, 0], [30, 30, 0], [30, 0, 0], [0, 30, 0]]"}})), "");
  world.tick(2);
  ASSERT_TRUE(has_failure(world.state()));
  const State before = world.state();
  world.tick(50);
  for (std::size_t n = 0; n < before.nodes.size(); ++n) {
    const std::string& id = before.plan->nodes[n].id;
    if (!world.session().scene().nodes.at(id).types.contains("smart_volume")) continue;
    EXPECT_EQ(
        world.number(id, "smart_volume.demand_limit"),
        as_number(before.value(*before.plan->find(static_cast<std::uint32_t>(n), *parse_port_path("smart_volume.demand_limit")))))
        << id;
  }
}

// A scene in which links of a kind "shout" propose `said`, in Lua, to the node `b`.
std::string shouting_scene(const std::string& port, const std::string& said, const std::string& links) {
  return R"({"format": "behaviourlinks", "version": 1, "scripts": [{"id": "shout", "lines": [
    "return {id = 'shout', doc = 'Says much.', reads = {x = {at = 'from', port = 'node.position'}},",
    "proposes = {y = {at = 'to', port = ')" +
         port + R"('}},", "evaluate = function(p, ends) return {y = )" + said + R"(} end}"]}],
    "nodes": [{"id": "a", "tags": ["t"]}, {"id": "a2", "tags": ["t"]}, {"id": "b", "position": [1, 0, 0], "types": {"smart_volume": {}}}],
    "links": [)" +
         links + "]}";
}

// Each of the pairs says a number; what they come to is none.
TEST(Failure, PairsThatAddUpBeyondAllNumbersAreAnErrorOfTheirLink) {
  World world = World::from_text(shouting_scene("node.position", "point(1.7e308, 0, 0)",
                                                R"({"id": "l", "kind": "shout", "from": {"tag": "t"}, "to": "b"})"));
  world.tick(2);
  EXPECT_EQ(world.link_error("l"), "links/l: what its pairs propose for `b` adds up to more than any number");
  EXPECT_EQ(world.point("b", "node.position").x, 1);
  EXPECT_TRUE(has_failure(world.state()));
}

// Each of the links says a number; the port takes none of it, and each of them is told.
TEST(Failure, LinksThatAddUpBeyondAllNumbersAreErrorsOfTheseLinks) {
  const std::string two =
      R"({"id": "l1", "kind": "shout", "from": "a", "to": "b"}, {"id": "l2", "kind": "shout", "from": "a2", "to": "b"},
    {"id": "l3", "kind": "shout", "from": "b", "to": "a"})";
  World world = World::from_text(shouting_scene("node.position", "point(1.7e308, 0, 0)", two));
  world.tick(2);
  for (const char* link : {"l1", "l2"})
    EXPECT_EQ(world.link_error(link),
              std::string("links/") + link +
                  ": together with other links it proposes more than any number for `node.position` of `b`, "
                  "which stays as it is");
  EXPECT_EQ(world.link_error("l3"), "") << "alone it can be followed, as far as the step limit goes";
  EXPECT_EQ(world.point("b", "node.position").x, 1);
  const State before = world.state();
  EXPECT_EQ(loaded(world).state().hash, before.hash);
  ASSERT_EQ(world.submit(command<RemoveLink>({"l2"})), "");
  world.tick();
  EXPECT_EQ(world.link_error("l1"), "");
}

}  // namespace
}  // namespace bl
