// Law of commands: a command and then its inverse give the same scene, for every registered command.
#include <array>
#include <map>
#include <optional>
#include <set>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/base/random.h"
#include "core/define/codec.h"
#include "core/live/commands.h"
#include "tests/support/random_commands.h"
#include "tests/support/sanitized.h"
#include "tests/support/world.h"

namespace bl {
namespace {

constexpr const char* kScene = R"({"format": "behaviourlinks", "version": 1, "scripts": [
  {"id": "mover", "lines": ["return {id = 'mover', doc = 'Moves.', params = {{id = 'step', default = 1, doc = 'Metres.'}},",
   "proposes = {move = {at = 'to', port = 'node.position', unit = 'm'}},",
   "evaluate = function(params) return {move = point(params.step, 0, 0)} end}", ""]},
  {"id": "sketch", "lines": ["return 3 4"]}], "nodes": [
  {"id": "a", "position": [1, 2, 3], "tags": ["x"], "types": {"smart_volume": {"demand": 900}, "strange": {"deep": [1, {"k": null}]}}, "locked": ["node.position"]},
  {"id": "b", "types": {"smart_volume": {}}},
  {"id": "c", "types": {"statistics": {"nodes": ["a", "b"]}}},
  {"id": "brief", "types": {"programme": {"rows": [{"use": "housing", "floor_area": 90}, {"use": "shop", "floor_area": 60}]}}},
  {"id": "poll", "types": {"vote": {"is_open": true, "ballots": [{"voter": "anna", "answer": "no"}, {"voter": "carla", "answer": "maybe"}]}}},
  {"id": "d", "types": {"sensor": {"reading": 5, "reading_tick": 3, "reading_problem": "noise"}}}],
  "links": [
  {"id": "l", "kind": "keep_distance", "from": "a", "to": "b"},
  {"id": "m", "kind": "keep_distance", "from": "b", "to": ["a", "c"], "strength": 0.5},
  {"id": "n", "kind": "unheard_of", "from": "nowhere", "to": 7},
  {"id": "p", "kind": "mover", "from": "a", "to": "b", "parameters": {"step": 2}},
  {"id": "q", "kind": "second_mover", "to": "b", "from": ["a"], "strength": 1}]})";

// The script of the scene under another id and with another default.
std::string mover(const std::string& id, const std::string& step) {
  return "return {id = '" + id + "', doc = 'Moves.', params = {{id = 'step', default = " + step +
         ", doc = 'Metres.'}},\nproposes = {move = {at = 'to', port = 'node.position', unit = 'm'}},\n"
         "evaluate = function(params) return {move = point(0, params.step, 0)} end}";
}

std::vector<Command> every_command() {
  return {command<AddNode>({"z", {R"({"name": "Z", "types": {"smart_volume": {"demand": 5}}})"}}),
          command<RemoveNode>({"a"}),
          command<RemoveNode>({"b"}),
          command<RenameNode>({"a", "Anna"}),
          command<Typify>({"b", "control", {R"({"value": 4})"}}),
          command<Untypify>({"a", "smart_volume"}),
          command<SetPort>({"a", {"smart_volume.demand"}, {"1234.5"}}),
          command<SetPort>({"c", {"statistics.nodes"}, {R"({"tag": "x"})"}}),
          command<LockPort>({"b", {"node.position"}}),
          command<UnlockPort>({"a", {"node.position"}}),
          command<AddLink>({"o", {R"({"kind": "attract", "from": "a", "to": {"typification": "smart_volume"}})"}}),
          command<RemoveLink>({"m"}),
          command<RemoveLink>({"n"}),
          command<SetLinkEnds>({"l", Selection{{"b"}, "", ""}, Selection{{}, "", "x"}}),
          command<SetLinkParameter>({"l", full_registry().link("keep_distance")->ports.front().id, {"7"}}),
          command<SetLinkStrength>({"m", 0.25}),
          command<EnableLink>({"l", false}),
          command<MuteLink>({"l", true}),
          command<SetSetting>({"tolerance", {"0.02"}}),
          command<SetScript>({"mover", mover("mover", "2"), false}),
          command<SetScript>({"mover", mover("other_mover", "2"), false}),
          command<SetScript>({"mover", "no Lua", true}),
          command<SetScript>({"sketch", mover("second_mover", "3"), false}),
          command<SetScript>({"fresh", mover("second_mover", "3"), false}),
          command<RemoveScript>({"mover"}),
          command<RemoveScript>({"sketch"}),
          command<SetCell>({"brief", {"programme.rows"}, "shop", "count", {"3"}}),
          command<SetCell>({"brief", {"programme.rows"}, "shop", "use", {"\"market\""}}),
          command<AddRow>({"brief", {"programme.rows"}, {R"({"use": "school", "floor_area": 800})"}, 1}),
          command<RemoveRow>({"brief", {"programme.rows"}, "housing"}),
          command<CastVote>({"poll", "ben", {"\"yes\""}}),
          command<CastVote>({"poll", "anna", {"\"yes\""}}),
          command<CastVote>({"poll", "anna", JsonValue::null()}),
          command<CastVote>({"poll", "carla", {"\"no\""}}),
          command<live::Receive>({"d", 21.5, "noon", "", 12}),
          command<live::Receive>({"d", 0, "", "`x` is no number", 12}),
          command<live::NoteConnection>({"d", "nobody is there"}),
          command<SetView>({{R"({"boxes": {"a": [1, 2], "b": null}})"}}),
          command<Batch>({std::vector{command<RenameNode>({"a", "B"}), command<RemoveNode>({"b"})}})};
}

TEST(UndoLaws, EveryCommandIsTaken) {
  std::set<std::string> taken;
  for (const Command& command : every_command()) taken.insert(command.id);
  for (const auto& [id, command] : full_registry().commands()) EXPECT_TRUE(taken.contains(id)) << id;
}

// The laws of whole scenes are as wide as what is drawn for them.
TEST(UndoLaws, EveryCommandIsDrawnAtRandomAndMostlyFits) {
  Scene scene = read_scene(kScene, full_registry()).scene;
  Random random(4);
  std::map<std::string, int> drawn, taken;
  for (int k = 0; k < 2000; ++k) {
    const Command command = random_command(scene, random, k);
    ++drawn[command.id];
    SceneEdit edit(scene, full_registry());
    const auto inverse = apply(edit, command);
    if (!inverse) continue;
    ++taken[command.id];
    for (const Command& back : *inverse) ASSERT_TRUE(apply(edit, back).ok()) << command.id;
    // On from here now and then, so that there are locks to open and scripts to remove.
    if (k % 3 == 0) { ASSERT_TRUE(apply(edit, command).ok()) << command.id; }
    if (scene.nodes.size() < 3 || scene.links.size() < 2) scene = read_scene(kScene, full_registry()).scene;
  }
  for (const auto& [id, command] : full_registry().commands()) {
    EXPECT_GT(drawn[id], 0) << id;
    EXPECT_GT(taken[id], 0) << id << " was drawn " << drawn[id] << " times and never fitted";
  }
}

TEST(UndoLaws, ACommandAndItsInverseGiveTheSameBytes) {
  const SceneReading reading = read_scene(kScene, full_registry());
  ASSERT_TRUE(reading.is_usable()) << reading.first_error().text();
  for (const Command& command : every_command()) {
    Scene scene = reading.scene;
    SceneEdit edit(scene, full_registry());
    const auto inverse = apply(edit, command);
    ASSERT_TRUE(inverse.ok()) << command.id << ": " << inverse.error().text();
    EXPECT_FALSE(scene == reading.scene) << command.id << " changed nothing";
    for (const Command& back : *inverse) {
      const auto done = apply(edit, back);
      ASSERT_TRUE(done.ok()) << command.id << ": " << done.error().text();
    }
    EXPECT_EQ(hash_of(scene), hash_of(reading.scene)) << command.id;
    EXPECT_EQ(write_scene(scene, full_registry()), write_scene(reading.scene, full_registry())) << command.id;
  }
}

TEST(UndoLaws, EveryCommandSurvivesJson) {
  for (const Command& command : every_command()) {
    const Json json = command_to_json(full_registry(), command);
    const auto text = parse_json(write_json_line(json));
    ASSERT_TRUE(text.ok()) << command.id;
    const auto back = command_from_json(full_registry(), *text, "");
    ASSERT_TRUE(back.ok()) << command.id << ": " << back.error().text();
    EXPECT_TRUE(*back == command) << write_json_line(json);
  }
}

// Whatever is wrong inside a batch has its place there, whether it is read or applied.
TEST(UndoLaws, ErrorsInABatchSayWhere) {
  const auto read = [](const char* list) {
    const auto command =
        command_from_json(full_registry(), {{"command", "batch"}, {"arguments", {{"commands", Json::parse(list)}}}}, "line 7");
    return command ? "" : command.error().text();
  };
  EXPECT_EQ(read(R"([{"command": "rename_node", "arguments": {"id": "a", "name": "A"}}, {"command": "rename_nod"}])"),
            "line 7/arguments/commands/1: unknown command `rename_nod`, did you mean `rename_node`?");
  EXPECT_EQ(read(R"([{"command": "batch", "arguments": {"commands": [{"command": "lock_port", "arguments": {"node": 3}}]}}])"),
            "line 7/arguments/commands/0/arguments/commands/0/arguments/node: expects a text, found 3");
  EXPECT_EQ(read(R"({"a": 1})"), "line 7/arguments/commands: expects a list of commands");
  EXPECT_EQ(read("[7]"), "line 7/arguments/commands/0: expects {\"command\": ..., \"arguments\": {...}}");
  World world = World::from_text(kScene);
  const Command port = command<SetPort>({"a", {"smart_volume.demand"}, {"\"much\""}});
  EXPECT_EQ(world.submit(command<Batch>({std::vector{command<RenameNode>({"a", "A"}), port}})),
            "commands/1/nodes/a/smart_volume/demand: expects a number in m\xc2\xb3, found \"much\"");
  EXPECT_EQ(world.submit(command<SetPort>({"a", {"smart_volume.demand"}, {"[1,"}})).substr(0, 40),
            "nodes/a/smart_volume/demand/line 1, colu");
}

TEST(UndoLaws, AFailedBatchLeavesTheSceneAsItWas) {
  const SceneReading reading = read_scene(kScene, full_registry());
  Scene scene = reading.scene;
  SceneEdit edit(scene, full_registry());
  const auto done = apply(edit, command<Batch>({std::vector{command<RemoveNode>({"a"}), command<RenameNode>({"a", "B"})}}));
  ASSERT_FALSE(done.ok());
  EXPECT_EQ(done.error().text(), "commands/1/nodes/a: there is no node `a`, did you mean `b`?");
  EXPECT_TRUE(scene == reading.scene);
}

TEST(UndoLaws, UndoIsPerAuthorAndRedoBringsBack) {
  World world = World::from_text(kScene);
  ASSERT_EQ(world.submit(command<RenameNode>({"a", "by Anna"}), "anna"), "");
  ASSERT_EQ(world.submit(command<RenameNode>({"b", "by Ben"}), "ben"), "");
  ASSERT_TRUE(world.session().undo("anna").ok());
  EXPECT_EQ(world.session().scene().nodes.at("a").name, "");
  EXPECT_EQ(world.session().scene().nodes.at("b").name, "by Ben");
  ASSERT_TRUE(world.session().redo("anna").ok());
  EXPECT_EQ(world.session().scene().nodes.at("a").name, "by Anna");
  ASSERT_TRUE(world.session().undo("anna").ok());
  EXPECT_EQ(world.session().undo("anna").error().message, "there is nothing to undo for anna");
  ASSERT_TRUE(world.session().redo("anna").ok());
  EXPECT_EQ(world.session().redo("anna").error().message, "there is nothing to redo for anna");
  // A new step of Anna's forgets what she could have redone.
  ASSERT_TRUE(world.session().undo("anna").ok());
  ASSERT_EQ(world.submit(command<RenameNode>({"a", "anew"}), "anna"), "");
  EXPECT_FALSE(world.session().redo("anna").ok());
}

TEST(UndoLaws, AGestureIsOneStep) {
  World world = World::from_text(kScene);
  const std::int64_t drag = world.session().new_gesture();
  for (int i = 1; i <= 5; ++i)
    ASSERT_TRUE(world.session()
                    .submit(command<SetPort>({"b", {"node.position"}, {"[" + std::to_string(i) + ", 0, 0]"}}), "anna", drag)
                    .ok());
  EXPECT_EQ(std::get<Vector3>(world.session().scene().nodes.at("b").types.at("node").at("position")).x, 5);
  ASSERT_TRUE(world.session().undo("anna").ok());
  EXPECT_FALSE(world.session().scene().nodes.at("b").types.at("node").contains("position"));
  ASSERT_TRUE(world.session().redo("anna").ok());
  EXPECT_EQ(std::get<Vector3>(world.session().scene().nodes.at("b").types.at("node").at("position")).x, 5);
}

TEST(UndoLaws, AGestureBelongsToOneAuthorAndEndsWhenUndone) {
  World world = World::from_text(kScene);
  const std::int64_t drag = world.session().new_gesture();
  const auto move = [&](const char* author) {
    return world.session().submit(command<SetPort>({"b", {"node.position"}, {"[1, 0, 0]"}}), author, drag);
  };
  ASSERT_TRUE(move("anna").ok());
  ASSERT_EQ(world.submit(command<RenameNode>({"a", "by Ben"}), "ben"), "");
  EXPECT_TRUE(move("anna").ok());
  EXPECT_EQ(move("ben").error().text(), "gesture: the gesture 1 is closed or somebody else's");
  ASSERT_TRUE(world.session().undo("anna").ok());
  EXPECT_FALSE(move("anna").ok());
}

TEST(UndoLaws, CommandsRefuseWhatAFileWouldBeRefusedFor) {
  World world = World::from_text(kScene);
  EXPECT_EQ(world.submit(command<SetPort>({"c", {"statistics.port"}, {"\"foo.bar\""}})),
            "nodes/c/statistics/port: unknown typification `foo`");
  EXPECT_EQ(world.submit(command<AddNode>({"z", {R"({"locked": ["foo.bar"]})"}})),
            "nodes/z/locked: the node has no port `foo.bar`");
  EXPECT_EQ(world.submit(command<Batch>({})), "commands: an empty batch changes nothing");
  EXPECT_TRUE(read_scene(write_scene(world.session().scene(), full_registry()), full_registry()).is_usable());
}

TEST(UndoLaws, WhatCannotBeUndoneSaysWhyAndChangesNothing) {
  World world = World::from_text(kScene);
  ASSERT_EQ(world.submit(command<RenameNode>({"b", "by Anna"}), "anna"), "");
  ASSERT_EQ(world.submit(command<RemoveNode>({"b"}), "ben"), "");
  const std::uint64_t before = hash_of(world.session().scene());
  const auto undone = world.session().undo("anna");
  ASSERT_FALSE(undone.ok());
  EXPECT_EQ(undone.error().message, "cannot be undone: ben has changed nodes/b since");
  EXPECT_EQ(hash_of(world.session().scene()), before);
}

// What has to come again, so that rows and links are there to be changed.
std::optional<Command> missing_thing(const Scene& scene, int number) {
  if (!scene.nodes.contains("brief"))
    return command<AddNode>({"brief", {R"({"types": {"programme": {"rows": [{"use": "shop", "floor_area": 7}]}}})"}});
  if (!scene.nodes.contains("poll")) return command<AddNode>({"poll", {R"({"types": {"vote": {"is_open": true}}})"}});
  const std::string one = scene.nodes.begin()->first, other = scene.nodes.rbegin()->first;
  if (scene.nodes.size() > 1 && scene.links.size() < 4)
    return command<AddLink>(
        {"again" + std::to_string(number), {R"({"kind": "attract", "from": ")" + one + R"(", "to": ")" + other + "\"}"}});
  return std::nullopt;
}

// However they wrote over each other: where each takes back what was done last, nothing is left of it, and all of it comes again.
TEST(UndoLaws, WhatThreeDidIsUndoneByAllToTheSameBytes) {
  const std::array<const char*, 3> authors = {"anna", "ben", "carla"};
  const Scene before = read_scene(kScene, full_registry()).scene;
  Ledger ledger(full_registry(), before);
  Random random(2026);
  std::vector<const char*> steps;
  std::map<std::string, int> taken;
  const int count = test::kIsSanitized ? 1000 : 10000;
  for (int k = 0; k < count; ++k) {
    const Command command = missing_thing(ledger.scene(), k).value_or(random_command(ledger.scene(), random, k));
    const char* author = authors[random.below(authors.size())];
    if (!ledger.submit(command, author, k)) continue;
    steps.push_back(author);
    ++taken[command.id];
  }
  for (const auto& [id, command] : full_registry().commands()) EXPECT_GT(taken[id], 0) << id;
  const std::string after = write_scene(ledger.scene(), full_registry());
  for (auto author = steps.rbegin(); author != steps.rend(); ++author) {
    const auto undone = ledger.undo(*author, count);
    ASSERT_TRUE(undone.ok()) << undone.error().text() << ", step " << steps.rend() - author;
    ASSERT_TRUE(undone->left.empty()) << text_of(undone->left.front());
  }
  EXPECT_EQ(write_scene(ledger.scene(), full_registry()), write_scene(before, full_registry()));
  for (const char* author : steps) ASSERT_TRUE(ledger.redo(author, count).ok());
  EXPECT_EQ(write_scene(ledger.scene(), full_registry()), after);
}

}  // namespace
}  // namespace bl
