// Laws of whole scenes: text, threads, order, save and load, rewind, replay and undo leave the result as it is.
#include <algorithm>
#include <regex>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/base/random.h"
#include "core/define/codec.h"
#include "tests/support/random_commands.h"
#include "tests/support/sanitized.h"
#include "tests/support/scene_files.h"
#include "tests/support/world.h"

namespace bl {
namespace {

constexpr int kTicks = 25;

std::uint64_t hash_after(const std::string& text, int ticks, int threads) {
  World world = World::from_text(text, threads);
  world.tick(ticks);
  return world.state().hash;
}

bool is_frozen(const std::string& path) { return path.starts_with("scenes/old/"); }

void expect_canonical(const SceneReading& reading, const std::string& text, const std::string& path) {
  std::string written = write_scene(reading.scene, full_registry(), reading.state ? &*reading.state : nullptr);
  // The digest of a running state, which files of older programs have not.
  if (is_frozen(path)) written = std::regex_replace(written, std::regex(",\n    \"check\": \"[0-9a-f]{16}\""), "");
  EXPECT_EQ(written, text) << (is_frozen(path)
                                   ? path + " is frozen: what is written of it must not change"
                                   : path + " is not in canonical form; this brings it there: behaviourlinks check --write " +
                                         path);
}

class SceneLaws : public testing::TestWithParam<std::string> {};

TEST_P(SceneLaws, LoadsWithoutProblemsAndSavesByteForByte) {
  const std::string text = project_file(GetParam());
  const SceneReading reading = read_scene(text, full_registry());
  for (const Problem& problem : reading.problems)
    // Frozen files hold ghosts on purpose.
    if (problem.is_error || !is_frozen(GetParam())) ADD_FAILURE() << problem.error.text();
  expect_canonical(reading, text, GetParam());
}

TEST_P(SceneLaws, OneTwoThreeAndEightThreadsAgree) {
  const std::string text = project_file(GetParam());
  const std::uint64_t one = hash_after(text, kTicks, 1);
  for (const int threads : {2, 3, 8}) EXPECT_EQ(hash_after(text, kTicks, threads), one) << threads << " threads";
}

// The same nodes and links, created one by one by commands in shuffled order.
Scene rebuilt(const Scene& scene, std::uint64_t seed) {
  Random random(seed);
  std::vector<Command> nodes, links;
  for (const auto& [id, node] : scene.nodes) {
    NodeRecord bare = node;
    std::erase_if(bare.types, [](const auto& type) { return type.first != kBaseNode; });
    bare.locked.clear();
    bare.ghosts.clear();
    nodes.push_back(command<AddNode>({id, JsonValue::of(node_to_json(bare, full_registry()))}));
  }
  std::vector<Command> roles;
  for (const auto& [id, node] : scene.nodes) {
    for (const auto& [type, values] : node.types)
      if (type != kBaseNode)
        roles.push_back(command<Typify>({id, type, JsonValue::of(ports_to_json(*full_registry().typification(type), values))}));
  }
  for (const auto& [id, link] : scene.links)
    links.push_back(command<AddLink>({id, JsonValue::of(link_to_json(link, full_registry()))}));
  Scene fresh;
  fresh.settings = scene.settings;
  fresh.view = scene.view;
  SceneEdit edit(fresh, full_registry());
  for (auto* list : {&nodes, &roles, &links}) {
    for (std::size_t i = list->size(); i > 1; --i) std::swap((*list)[i - 1], (*list)[random.below(i)]);
    for (const Command& command : *list) {
      const auto done = apply(edit, command);
      EXPECT_TRUE(done.ok()) << done.error().text();
    }
  }
  for (const auto& [id, node] : scene.nodes) {
    fresh.nodes[id].ghosts = node.ghosts;
    for (const std::string& path : node.locked) EXPECT_TRUE(apply(edit, command<LockPort>({id, {path}})).ok());
  }
  return fresh;
}

TEST_P(SceneLaws, TheOrderOfCreationDoesNotMatter) {
  const SceneReading reading = read_scene(project_file(GetParam()), full_registry());
  if (reading.state) return;  // a scene in mid-run starts from its state, not from its creation
  const std::uint64_t straight = hash_after(write_scene(reading.scene, full_registry()), kTicks, 1);
  for (const std::uint64_t seed : {1u, 2u}) {
    const Scene shuffled = rebuilt(reading.scene, seed);
    EXPECT_TRUE(shuffled == reading.scene);
    EXPECT_EQ(hash_after(write_scene(shuffled, full_registry()), kTicks, 1), straight);
  }
}

TEST_P(SceneLaws, SavingAndLoadingInMidRunChangesNothing) {
  World through = World::from_file(GetParam());
  through.tick(kTicks / 2);
  const SavedState saved = save(through.state());
  const std::string text = write_scene(through.session().scene(), full_registry(), &saved);
  World loaded = World::from_text(text);
  EXPECT_EQ(loaded.state().hash, through.state().hash);
  for (int i = 0; i < kTicks / 2; ++i) {
    through.tick();
    loaded.tick();
    ASSERT_EQ(loaded.state().hash, through.state().hash) << "tick " << through.state().tick;
  }
}

TEST_P(SceneLaws, StepRewindStepGivesTheSame) {
  World world = World::from_file(GetParam());
  world.tick(3);
  const auto kept = world.session().state();
  const SavedState saved = save(*kept);
  world.tick(5);
  const std::uint64_t first = world.state().hash;
  Simulation again(full_registry(), 1);
  again.set_scene(world.session().scene());
  ASSERT_TRUE(again.restore_state(saved).ok());
  EXPECT_EQ(again.state()->hash, kept->hash);
  for (int i = 0; i < 5; ++i) again.step();
  EXPECT_EQ(again.state()->hash, first);
}

// A limit that links have tightened for many ticks is not let go because somebody gives a node another name.
TEST_P(SceneLaws, AnEditThatSaysNothingOfAPortLeavesWhatRunsThere) {
  World quiet = World::from_file(GetParam()), edited = World::from_file(GetParam());
  for (World* world : {&quiet, &edited}) world->tick(kTicks);
  const auto& nodes = edited.session().scene().nodes;
  if (nodes.empty()) return;
  ASSERT_EQ(edited.submit(command<RenameNode>({.id = nodes.begin()->first, .name = "Another name"})), "");
  for (int i = 0; i < 3; ++i) {
    for (World* world : {&quiet, &edited}) world->tick();
    const SavedState expected = save(quiet.state()), found = save(edited.state());
    for (const auto& [node, values] : expected.nodes)
      for (const auto& [path, value] : values) {
        if (path == "node.name") continue;
        ASSERT_TRUE(found.nodes.at(node).at(path) == value) << node << " " << path << ", tick " << i + 1;
      }
  }
}

TEST_P(SceneLaws, UndoingEverythingGivesTheScenesBytesAndReplayTheSameHash) {
  const std::string text = project_file(GetParam());
  World world = World::from_text(text);
  const std::uint64_t scene_hash = hash_of(world.session().scene());
  Random random(21, text.size());
  int done = 0;
  for (int i = 0; i < 60; ++i) {
    if (world.submit(random_command(world.session().scene(), random, i), i % 3 == 0 ? "anna" : "ben").empty()) ++done;
    if (i % 10 == 0) world.tick();
  }
  EXPECT_GT(done, 10);
  world.tick(2);
  // Authors take turns in reverse order of their entries, so that every undo finds the scene that it was made for.
  std::vector<Author> authors;
  for (const LogEntry& entry : world.session().log()) authors.push_back(entry.author);
  std::reverse(authors.begin(), authors.end());
  std::set<std::int64_t> gestures;
  for (const LogEntry& entry : world.session().log()) gestures.insert(entry.gesture);
  ASSERT_EQ(gestures.size(), authors.size());
  for (const Author& author : authors) {
    const auto undone = world.session().undo(author);
    ASSERT_TRUE(undone.ok()) << undone.error().text();
  }
  EXPECT_EQ(hash_of(world.session().scene()), scene_hash);
  EXPECT_EQ(write_scene(world.session().scene(), full_registry()),
            write_scene(read_scene(text, full_registry()).scene, full_registry()));
  world.tick(2);
  std::string log = log_header(text);
  for (const LogEntry& entry : world.session().log()) log += log_line(entry, full_registry());
  log += log_line(LogCheck{world.state().tick, hex_digits(world.state().hash), true});
  const auto file = read_log(log, full_registry());
  ASSERT_TRUE(file.ok()) << file.error().text();
  const auto report = replay(*file, full_registry(), 2);
  ASSERT_TRUE(report.ok()) << report.error().text();
  EXPECT_FALSE(report->first_mismatch.has_value());
  EXPECT_EQ(report->hash, hex_digits(world.state().hash));
  EXPECT_EQ(report->checks, 1u);
}

INSTANTIATE_TEST_SUITE_P(Small, SceneLaws, testing::ValuesIn(small_scenes()),
                         [](const auto& test) { return scene_test_name(test); });

TEST(StudyLaws, StudiesLoadSaveAndAgreeOnThreads) {
  for (const std::string& path : shipped_scenes()) {
    if (!path.starts_with("scenes/studies/")) continue;
    const std::string text = project_file(path);
    const SceneReading reading = read_scene(text, full_registry());
    EXPECT_TRUE(reading.problems.empty()) << path;
    expect_canonical(reading, text, path);
    EXPECT_EQ(hash_after(text, 3, 2), hash_after(text, 3, 1)) << path;
  }
}

TEST(LargeLaws, LargeScenesLoadSaveAndAgreeOnThreads) {
  std::vector<std::size_t> sizes;
  for (const std::string& path : large_scenes()) {
    const std::string text = project_file(path);
    const SceneReading reading = read_scene(text, full_registry());
    EXPECT_TRUE(reading.problems.empty()) << path;
    expect_canonical(reading, text, path);
    sizes.push_back(reading.scene.nodes.size());
    if (sizes.back() < 20000 && !test::kIsSanitized) { EXPECT_EQ(hash_after(text, 2, 2), hash_after(text, 2, 1)) << path; }
  }
  ASSERT_EQ(sizes.size(), 2u);
  EXPECT_GE(sizes[0], 10000u);
  EXPECT_GE(sizes[1], 30000u);
}

}  // namespace
}  // namespace bl
