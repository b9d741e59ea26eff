// Scripts in a running scene: they work as kinds in code do, are edited, undone, replayed and saved, and stop nobody when they
// fail.
#include <gtest/gtest.h>

#include "tests/support/world.h"

namespace bl {
namespace {

// A ratio by the name `id`; `factor` goes into the text, so that texts can differ.
std::string ratio_script(const std::string& id, const std::string& factor = "1") {
  return "return {\n  id = '" + id + "', doc = 'A ratio.',\n" +
         "  params = {{id = 'ratio', default = 1, unit = 'ratio', min = 0, doc = 'The multiple.'}},\n"
         "  reads = {volume = {at = 'from', port = 'smart_volume.volume', unit = 'm3'}},\n"
         "  proposes = {demand = {at = 'to', port = 'smart_volume.demand', unit = 'm3'}},\n"
         "  evaluate = function(params, ends)\n    return {demand = " +
         factor + " * params.ratio * ends.volume}\n  end,\n}\n";
}

std::string with_kind(std::string scene, const std::string& from, const std::string& to) {
  for (std::size_t at = scene.find(from); at != std::string::npos; at = scene.find(from, at + to.size()))
    scene.replace(at, from.size(), to);
  return scene;
}

std::string ratio_scene() {
  return with_kind(project_file("scenes/links/ratio.json"), "\"kind\": \"ratio\"", "\"kind\": \"my_ratio\"");
}

World scripted_world(int threads = 1) {
  World world = World::from_text(ratio_scene(), threads);
  EXPECT_EQ(world.submit(command<SetScript>({"my_ratio", ratio_script("my_ratio"), false})), "");
  return world;
}

std::string saved(const World& world, const Scene& scene) {
  const SavedState state = save(world.state());
  return write_scene(scene, full_registry(), &state);
}

TEST(ScriptSession, GivesTheBitsOfTheSameKindInCode) {
  World code = World::from_file("scenes/links/ratio.json"), script = scripted_world();
  for (int tick = 0; tick < 60; ++tick) {
    code.tick();
    script.tick();
    ASSERT_EQ(code.state().hash, script.state().hash) << "tick " << tick;
  }
}

TEST(ScriptSession, GhostsOfTheKindComeBackAndGoAgain) {
  World world = World::from_text(ratio_scene());
  const Scene before = world.session().scene();
  EXPECT_FALSE(before.links.at("l1_parking").ghost.empty());
  ASSERT_EQ(world.submit(command<SetScript>({"my_ratio", ratio_script("my_ratio"), false})), "");
  EXPECT_TRUE(world.session().scene().links.at("l1_parking").ghost.empty());
  world.tick(60);
  EXPECT_NEAR(world.number("parking", "smart_volume.volume"), 2000, 20);
  ASSERT_EQ(world.submit(command<RemoveScript>({"my_ratio"})), "");
  EXPECT_EQ(world.session().scene(), before);
  world.tick();
  EXPECT_NE(world.link_error("l1_parking").find("my_ratio"), std::string::npos);
}

TEST(ScriptSession, AnEditWorksFromTheNextTickAndIsUndone) {
  World world = scripted_world();
  ASSERT_TRUE(world.settle());
  const double before = world.number("parking", "smart_volume.demand");
  ASSERT_EQ(world.submit(command<SetScript>({"my_ratio", ratio_script("my_ratio", "0.5"), false})), "");
  world.tick();
  EXPECT_NEAR(world.number("parking", "smart_volume.demand"), before / 2, 1);
  ASSERT_TRUE(world.session().undo("test").ok());
  EXPECT_EQ(world.session().scene().scripts.texts().at("my_ratio"), ratio_script("my_ratio"));
  world.tick();
  EXPECT_NEAR(world.number("parking", "smart_volume.demand"), before, 1);
  ASSERT_TRUE(world.session().redo("test").ok());
  EXPECT_EQ(world.session().scene().scripts.texts().at("my_ratio"), ratio_script("my_ratio", "0.5"));
}

TEST(ScriptSession, ABrokenEditIsRefusedAndTheOldTextStays) {
  World world = scripted_world();
  world.tick(5);
  const std::string said = world.submit(command<SetScript>({"my_ratio", ratio_script("my_ratio", "0.5 *"), false}));
  EXPECT_TRUE(said.starts_with("scripts/my_ratio: my_ratio.lua:7: unexpected symbol")) << said;
  World same = scripted_world();
  same.tick(5);
  world.tick(5), same.tick(5);
  EXPECT_EQ(world.state().hash, same.state().hash);
  EXPECT_NE(world.submit(command<SetScript>({"other", ratio_script("my_ratio"), false}))
                .find("the scene's script `my_ratio` has this id already; name your file my_ratio.lua"),
            std::string::npos);
  EXPECT_NE(world.submit(command<SetScript>({"No name", "return 3", false})), "");
}

TEST(ScriptSession, WhatALinkSetsIsNotLost) {
  World world = scripted_world();
  const std::string without =
      "return {id = 'my_ratio', doc = 'x', proposes = {demand = {at = 'to', port = 'smart_volume.demand'}},\n"
      "evaluate = function() return {} end}";
  const std::string said = world.submit(command<SetScript>({"my_ratio", without, false}));
  EXPECT_NE(said.find("links/l1_parking/parameters/ratio"), std::string::npos) << said;
  // A new default that equals what is set: the value counts as not set, and undo brings it back all the same.
  const Scene before = world.session().scene();
  const std::string other_default = with_kind(ratio_script("my_ratio"), "default = 1", "default = 0.25");
  ASSERT_EQ(world.submit(command<SetScript>({"my_ratio", other_default, false})), "");
  EXPECT_TRUE(world.session().scene().links.at("l1_parking").parameters.empty());
  ASSERT_TRUE(world.session().undo("test").ok());
  EXPECT_EQ(world.session().scene(), before);
}

TEST(ScriptSession, ARunawayIsStoppedAndItsLastValuesStay) {
  World world = scripted_world();
  ASSERT_TRUE(world.settle());
  const double before = world.number("parking", "smart_volume.demand");
  for (const auto& [body, said] :
       {std::pair{"(function() while true do end end)()", "my_ratio.lua:7: stopped after"},
        {"(function() local t = {} for i = 1, 1e9 do t[i] = {} end end)()", "my_ratio.lua:7: stopped when"},
        {"error('no')", "my_ratio.lua:7: no"},
        {"0 / 0", "my_ratio.lua:6: `demand` is not a finite number"}}) {
    ASSERT_EQ(world.submit(command<SetScript>({"my_ratio", ratio_script("my_ratio", body), false})), "");
    const std::int64_t tick = world.state().tick;
    world.tick(2);
    EXPECT_EQ(world.state().tick, tick + 2);
    EXPECT_NE(world.link_error("l1_parking").find(said), std::string::npos) << world.link_error("l1_parking");
    EXPECT_NEAR(world.number("parking", "smart_volume.demand"), before, 1) << said;
  }
}

// A link over many pairs that uses a little in each: its tick is limited as a whole, at the same place on any number of threads.
TEST(ScriptSession, ALinkHasALimitInEachTick) {
  std::string nodes, ids;
  for (int i = 0; i < 40; ++i) {
    const std::string id = "n" + std::to_string(100 + i);
    nodes += (i > 0 ? ", " : "") + std::string("{\"id\": \"") + id + "\", \"position\": [" + std::to_string(i) + ", 1, 2]}";
    ids += (i > 0 ? ", \"" : "\"") + id + "\"";
  }
  const std::string scene = R"({"format": "behaviourlinks", "version": 1, "nodes": [)" + nodes +
                            R"(], "links": [{"id": "l", "kind": "busy", "from": [)" + ids + R"(], "to": [)" + ids + "]}]}";
  auto text = [](int rounds) {
    return "return {id = 'busy', doc = 'x', reads = {here = {at = 'from', port = 'node.position'}, there = {at = 'to', port = "
           "'node.position'}},\n"
           "proposes = {move = {at = 'to', port = 'node.position'}},\nevaluate = function(p, ends)\nfor i = 1, " +
           std::to_string(rounds) + " do end\nreturn {move = (ends.here - ends.there) * 0.01} end}";
  };
  World world = World::from_text(scene);
  ASSERT_EQ(world.submit(command<SetScript>({"busy", text(10), false})), "");
  world.tick(3);
  EXPECT_EQ(world.link_error("l"), "");
  ASSERT_EQ(world.submit(command<SetScript>({"busy", text(20000), false})), "");
  world.tick();
  EXPECT_NE(world.link_error("l").find("busy.lua:4: stopped after"), std::string::npos) << world.link_error("l");
  const std::string said = world.link_error("l");
  world.tick();  // the next tick has a budget of its own, and stops at the same place
  EXPECT_EQ(world.link_error("l"), said);
}

std::string many_links() {
  std::string scene = R"({"format": "behaviourlinks", "version": 1, "nodes": [{"id": "foot"})";
  for (int i = 0; i < 30; ++i)
    scene += R"(, {"id": "n)" + std::to_string(i) + R"(", "position": [)" + std::to_string(i * 3) + ", " + std::to_string(i % 7) +
             ", 1]}";
  scene += "], \"links\": [";
  for (int i = 0; i < 30; ++i)
    scene += std::string(i > 0 ? ", " : "") + R"({"id": "l)" + std::to_string(i) +
             R"(", "kind": "lean_uphill", "from": "foot", "to": "n)" + std::to_string(i) + "\"}";
  return scene + "]}";
}

TEST(ScriptSession, OneAndManyThreadsGiveTheSameBits) {
  const std::string text = project_file("links/scripts/lean_uphill.lua");
  std::vector<std::uint64_t> hashes;
  for (const int threads : {1, 2, 5}) {
    World world = World::from_text(many_links(), threads);
    ASSERT_EQ(world.submit(command<SetScript>({"lean_uphill", text, false})), "");
    world.tick(40);
    EXPECT_EQ(world.link_error("l29"), "");
    hashes.push_back(world.state().hash);
  }
  EXPECT_EQ(hashes[0], hashes[1]);
  EXPECT_EQ(hashes[0], hashes[2]);
}

TEST(ScriptSession, ALogWithScriptEditsIsReplayedToTheSameHash) {
  World world = World::from_text(ratio_scene());
  std::string log = log_header(write_scene(world.session().scene(), full_registry()));
  world.session().subscribe([&](const LogEntry& entry) { log += log_line(entry, full_registry()); });
  const auto edit = [&](const std::string& factor) {
    ASSERT_EQ(world.submit(command<SetScript>({"my_ratio", ratio_script("my_ratio", factor), false})), "");
    world.tick(7);
    log += log_line(LogCheck{world.state().tick, hex_digits(world.state().hash), false});
  };
  edit("1");
  edit("0.5");
  edit("error('no')");
  edit("2");
  ASSERT_TRUE(world.session().undo("test").ok());
  world.tick(3);
  ASSERT_EQ(world.submit(command<RemoveScript>({"my_ratio"})), "");
  world.tick(3);
  ASSERT_TRUE(world.session().undo("test").ok());
  world.tick(3);
  log += log_line(LogCheck{world.state().tick, hex_digits(world.state().hash), true});
  const auto read = read_log(log, full_registry());
  ASSERT_TRUE(read.ok()) << read.error().text();
  for (const int threads : {1, 2}) {
    const auto report = replay(*read, full_registry(), threads);
    ASSERT_TRUE(report.ok()) << report.error().text();
    EXPECT_FALSE(report->first_mismatch.has_value());
    EXPECT_EQ(report->checks, 5u);
    EXPECT_EQ(report->hash, hex_digits(world.state().hash));
  }
}

TEST(ScriptSession, IsSavedLineByLineAndReadBack) {
  World world = scripted_world();
  world.tick(10);
  const std::string text = saved(world, world.session().scene());
  EXPECT_NE(text.find("\"id\": \"my_ratio\",\n      \"lines\": [\n        \"return {\",\n"), std::string::npos) << text;
  const SceneReading reading = read_scene(text, full_registry());
  ASSERT_TRUE(reading.is_usable()) << reading.first_error().text();
  EXPECT_TRUE(reading.problems.empty());
  EXPECT_EQ(reading.scene, world.session().scene());
  EXPECT_EQ(write_scene(reading.scene, full_registry(), &*reading.state), text);
  World again = World::from_text(text);
  again.tick(10), world.tick(10);
  EXPECT_EQ(again.state().hash, world.state().hash);
}

TEST(ScriptSession, ABrokenTextInAFileIsKeptAndItsLinksRest) {
  World world = scripted_world();
  Scene scene = world.session().scene();
  const std::string broken = with_kind(write_scene(scene, full_registry()), "return {demand", "return = {demand");
  const SceneReading reading = read_scene(broken, full_registry());
  ASSERT_TRUE(reading.is_usable());
  ASSERT_FALSE(reading.problems.empty());
  EXPECT_FALSE(reading.problems.front().is_error);
  EXPECT_EQ(reading.problems.front().error.place, "scripts/my_ratio");
  EXPECT_TRUE(reading.problems.front().error.message.starts_with("my_ratio.lua:7: ")) << reading.problems.front().error.message;
  EXPECT_EQ(write_scene(reading.scene, full_registry()), broken);
  World run = World::from_text(broken);
  run.tick(3);
  // The mended text wakes the links, and undo lets them rest again.
  const Scene before = run.session().scene();
  ASSERT_EQ(run.submit(command<SetScript>({"my_ratio", ratio_script("my_ratio"), false})), "");
  run.tick();
  EXPECT_EQ(run.link_error("l1_parking"), "");
  ASSERT_TRUE(run.session().undo("test").ok());
  EXPECT_EQ(run.session().scene(), before);
}

TEST(ScriptSession, TheShippedSceneCarriesTheShippedScripts) {
  const SceneReading reading = read_scene(project_file("scenes/studies/scripted_terraces.json"), full_registry());
  ASSERT_TRUE(reading.is_usable() && reading.problems.empty());
  for (const auto& [name, text] : reading.scene.scripts.texts()) EXPECT_EQ(text, project_file("links/scripts/" + name + ".lua"));
  EXPECT_EQ(reading.scene.scripts.kinds().size(), 2u);
}

TEST(ScriptSession, WrongFormsInAFileHaveTheirPlace) {
  for (const auto& [part, place] : {std::pair{R"([{"id": "a"}])", "scripts/a/lines"},
                                    {R"([{"id": "a", "lines": []}])", "scripts/a/lines"},
                                    {R"([{"id": "a", "lines": [3]}])", "scripts/a/lines"},
                                    {R"([{"id": "a", "lines": ["x"], "text": ""}])", "scripts/a/text"},
                                    {R"([{"id": "a", "lines": ["x"]}, {"id": "a", "lines": ["x"]}])", "scripts/a"},
                                    {R"([{"lines": ["x"]}])", "scripts/0"},
                                    {R"({"a": "x"})", "scripts"}}) {
    const SceneReading reading =
        read_scene(R"({"format": "behaviourlinks", "version": 1, "scripts": )" + std::string(part) + "}", full_registry());
    ASSERT_FALSE(reading.is_usable()) << part;
    EXPECT_EQ(reading.first_error().place, place) << reading.first_error().text();
  }
}

}  // namespace
}  // namespace bl
