// Scene files: canonical text, ghosts, upgrades, and the message for each way of being wrong.
#include <sys/resource.h>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>

#include "core/base/random.h"
#include "core/base/stop.h"
#include "core/define/typification_builder.h"
#include "core/file/file_io.h"
#include "tests/support/world.h"

namespace bl {
namespace {

std::string first_error(const std::string& text) {
  const SceneReading reading = read_scene(text, full_registry());
  return reading.is_usable() ? "" : reading.first_error().text();
}

std::string with_nodes(const std::string& nodes, const std::string& more = "") {
  return R"({"format": "behaviourlinks", "version": 1, "nodes": [)" + nodes + "]" + more + "}";
}

struct BadScene {
  const char* name;
  std::string text, message;
  friend std::ostream& operator<<(std::ostream& out, const BadScene& scene) { return out << scene.name; }
};

class BadSceneTest : public testing::TestWithParam<BadScene> {};

TEST_P(BadSceneTest, IsRefusedWithAPlaceAndASentence) { EXPECT_EQ(first_error(GetParam().text), GetParam().message); }

INSTANTIATE_TEST_SUITE_P(
    SceneFile, BadSceneTest,
    testing::Values(
        BadScene{"empty", "", "the file is empty; a scene starts with {\"format\": \"behaviourlinks\", \"version\": 1, ...}"},
        BadScene{"only_a_mark", "\xEF\xBB\xBF \n",
                 "the file is empty; a scene starts with {\"format\": \"behaviourlinks\", \"version\": 1, ...}"},
        BadScene{"table", "use;area\nhall;5\n",
                 "line 1, column 1: this is not a scene, which is JSON text: it starts with {\"format\": \"behaviourlinks\", "
                 "\"version\": 1, ...}"},
        BadScene{"truncated", with_nodes("").substr(0, 50),
                 "line 1, column 51: the text ends in the middle of a JSON value; the file is cut off"},
        BadScene{"no_json", "{\"format\": behaviourlinks}",
                 "line 1, column 12: this is not JSON (no comments, no trailing commas, no NaN)"},
        BadScene{"not_a_number", with_nodes(R"({"id": "a", "position": [NaN, 0, 0]})"),
                 "line 1, column 79: this is not JSON (no comments, no trailing commas, no NaN)"},
        BadScene{"overflow", with_nodes(R"({"id": "a", "position": [1e999, 0, 0]})"),
                 "line 1, column 79: a number is too large for a double"},
        BadScene{"far", with_nodes(R"({"id": "a", "position": [1e300, 0, 0]})"),
                 "nodes/a/position: lies farther than 10 000 km from the origin; use local metric coordinates"},
        BadScene{"another_format", R"({"format": "gltf"})",
                 "format: this is not a scene: a scene starts with {\"format\": \"behaviourlinks\", \"version\": 1, ...}"},
        BadScene{"newer", R"({"format": "behaviourlinks", "version": 2})",
                 "version: the file has version 2, this program reads up to 1; get a newer program"},
        BadScene{"unknown_key", R"({"format": "behaviourlinks", "version": 1, "node": []})",
                 "node: unknown field `node`, did you mean `nodes`?"},
        BadScene{"unknown_field", with_nodes(R"({"id": "a", "types": {"smart_volume": {"demnd": 5}}})"),
                 "nodes/a/types/smart_volume/demnd: `smart_volume` has no `demnd`, did you mean `demand`?"},
        BadScene{"computed", with_nodes(R"({"id": "a", "types": {"smart_volume": {"volume": 5}}})"),
                 "nodes/a/types/smart_volume/volume: `volume` is computed and cannot be set"},
        BadScene{"wrong_unit", with_nodes(R"({"id": "a", "types": {"smart_volume": {"demand": "850 m2"}}})"),
                 "nodes/a/types/smart_volume/demand: expects a number in m³, found \"850 m2\", which is in square metres; "
                 "convert it and write the "
                 "plain number"},
        BadScene{"unit_text", with_nodes(R"({"id": "a", "types": {"smart_volume": {"demand": "850 m3"}}})"),
                 "nodes/a/types/smart_volume/demand: expects a number in m³, found the text \"850 m3\"; write 850"},
        BadScene{"negative", with_nodes(R"({"id": "a", "types": {"smart_volume": {"demand": -1}}})"),
                 "nodes/a/types/smart_volume/demand: must be between 0 and 1e+09 m³, found -1"},
        BadScene{"twice", with_nodes(R"({"id": "a"}, {"id": "a"})"), "nodes/a: two nodes have the id `a`; ids must be unique"},
        BadScene{"key_twice", with_nodes(R"({"id": "a", "id": "b"})"),
                 "line 1, column 66: the key \"id\" stands twice in one object; keep one of them"},
        BadScene{"no_id", with_nodes(R"({"name": "a"})"), "nodes/0: `id` is missing"},
        BadScene{"bad_id", with_nodes(R"({"id": "Tower 1"})"), "nodes/0/id: `Tower 1` is no id: use 1 to 64 of a-z 0-9 _ - . #"},
        BadScene{
            "missing_node",
            with_nodes(R"({"id": "tower"})", R"(, "links": [{"id": "l", "kind": "attract", "from": "tower", "to": "twoer"}])"),
            "links/l/to: there is no node `twoer`, did you mean `tower`?"},
        BadScene{"no_end", with_nodes(R"({"id": "tower"})", R"(, "links": [{"id": "l", "kind": "attract", "from": "tower"}])"),
                 "links/l: `to` is missing"},
        BadScene{"bad_lock", with_nodes(R"({"id": "a", "locked": ["smart_volume.demand"]})"),
                 "nodes/a/locked: the node has no port `smart_volume.demand`"}),
    [](const testing::TestParamInfo<BadScene>& test) { return std::string(test.param.name); });

TEST(SceneFile, ListsAllErrorsNotOnlyTheFirst) {
  const SceneReading reading =
      read_scene(with_nodes(R"({"id": "a", "x": 1}, {"id": "b", "name": 3}, {"id": "c"})"), full_registry());
  EXPECT_EQ(reading.problems.size(), 2u);
}

TEST(SceneFile, DeepNestingIsAnError) {
  EXPECT_EQ(first_error(std::string(100000, '[')),
            "line 1, column 65: The text is nested deeper than 64 levels from here on. No file of this kind needs that many: it "
            "is not read.");
}

TEST(SceneFile, GhostsAreKeptToTheLetterAndReported) {
  const std::string text = R"({
  "format": "behaviourlinks",
  "version": 1,
  "nodes": [
    {"id": "a", "types": {"hologram": {"z": 1, "a": [true, null, "x"]}, "smart_volume": {"demand": 5}}}
  ],
  "links": [
    {"id": "l", "kind": "teleport", "via": {"deep": [1, 2]}, "from": "nowhere"}
  ]
}
)";
  const SceneReading reading = read_scene(text, full_registry());
  EXPECT_TRUE(reading.is_usable());
  ASSERT_EQ(reading.problems.size(), 2u);
  EXPECT_EQ(reading.problems[0].error.text(),
            "nodes/a/hologram: unknown typification `hologram`: kept as it is and saved back, not run");
  EXPECT_EQ(
      reading.problems[1].error.text(),
      "links/l: unknown link kind `teleport`: kept as it is, not run; a Lua file of yours is put into the scene by `script` or "
      "--script, a library is named by --plugins FOLDER");
  EXPECT_EQ(write_scene(reading.scene, full_registry()), text);
}

// A scene that was saved in mid-run by a program with more typifications: what it says of them cannot be gone on with here.
TEST(SceneFile, WhatARunSaysOfUnknownTypificationsIsLeftOutWithAWarning) {
  const auto with_state = [](const std::string& state) {
    return with_nodes(
        R"({"id": "a", "types": {"hologram": {"v": 1}, "smart_volume": {}}}, {"id": "b"})",
        R"(, "links": [{"id": "l", "kind": "teleport", "from": "a", "to": "b"}], "state": {"tick": 3, "calm": 0, )" + state +
            "}");
  };
  const std::string warning =
      "`hologram` is unknown to this program, so its results are left out: keep the file for the program that knows it";
  const std::pair<const char*, const char*> rows[] = {
      {R"("nodes": {"a": {"hologram.v": 3, "smart_volume.demand": 40}})", "state/nodes/a/hologram.v"},
      {R"("errors": {"a/hologram": {"code": "io", "message": "x"}})", "state/errors/a/hologram"},
      {R"("voices": {"l": {"a/hologram.v": 3}})", "state/voices/l/a/hologram.v"},
      {R"("analyses": {"a/hologram": {"as_of": 1}})", "state/analyses/a/hologram"},
      {R"("meshes": {"a": {"hologram.mesh": {"vertices": [], "triangles": []}}})", "state/meshes/a/hologram.mesh"},
      {R"("nodes": {"a": {"hologram.v": 3, "hologram.w": {"x": []}}}, "errors": {"a/hologram": {"message": "x"}})",
       "state/nodes/a/hologram.v"}};
  for (const auto& [state, place] : rows) {
    const SceneReading reading = read_scene(with_state(state), full_registry());
    ASSERT_TRUE(reading.is_usable()) << reading.first_error().text();
    ASSERT_TRUE(reading.state.has_value()) << state;
    ASSERT_EQ(reading.problems.size(), 3u) << "the ghost, the unknown link, and this once: " << state;
    EXPECT_FALSE(reading.problems.back().is_error);
    EXPECT_EQ(reading.problems.back().error.text(), std::string(place) + ": " + warning);
    const World world = World::from_text(with_state(state));
    EXPECT_EQ(world.state().tick, 3) << state;
  }
  EXPECT_EQ(World::from_text(with_state(rows[0].first)).number("a", "smart_volume.demand"), 40);
  EXPECT_FALSE(read_scene(with_state(R"("errors": {"b/hologram": {"message": "x"}})"), full_registry()).is_usable());
}

// An interrupted run writes what it has come to: all of it.
TEST(SceneFile, AWishToStopLosesNothingOfWhatIsWritten) {
  const SceneReading reading = read_scene(with_nodes(R"({"id": "a"})", R"(, "view": {"boxes": {"a": [1, 2]}})"), full_registry());
  const std::string whole = write_scene(reading.scene, full_registry());
  ASSERT_NE(whole.find("boxes"), std::string::npos);
  const StopScope scope([] { return true; });
  EXPECT_EQ(write_scene(reading.scene, full_registry()), whole);
}

TEST(SceneFile, DefaultsAreNotWritten) {
  const SceneReading reading =
      read_scene(with_nodes(R"({"id": "a", "name": "", "position": [0, 0, 0], "types": {"smart_volume": {"demand": 1000.0}}})"),
                 full_registry());
  EXPECT_EQ(write_scene(reading.scene, full_registry()),
            "{\n  \"format\": \"behaviourlinks\",\n  \"version\": 1,\n  \"nodes\": [\n    {\"id\": \"a\", \"types\": "
            "{\"smart_volume\": {}}}\n  ],\n  \"links\": []\n}\n");
}

// A type that was renamed and changed: its old id is an alias, its old values are upgraded.
struct Plot {
  struct In {
    double depth = 1;
  };
  struct Out {};
  static void declare(TypificationBuilder<Plot>& t) {
    t.id("plot").label("Plot").doc("A plot.").alias("parcel");
    t.in(&In::depth, "depth").unit(Unit::metre).doc("How deep.");
    t.upgrade("`feet` became `depth` in metres.", [](const std::string& text) -> Result<std::string> {
      return text.find("feet") == std::string::npos ? text : std::string(R"({"depth": 3.048})");
    });
  }
};

TEST(SceneFile, OldRevisionsAndNamesAreUpgraded) {
  Registry registry;
  register_base_node(registry);
  registry.add(TypificationBuilder<Plot>::build());
  const SceneReading reading = read_scene(with_nodes(R"({"id": "a", "types": {"parcel": {"feet": 10}}})"), registry);
  ASSERT_TRUE(reading.is_usable()) << reading.first_error().text();
  EXPECT_EQ(reading.scene.nodes.at("a").types.at("plot").at("depth"), Value(3.048));
  const std::string saved = write_scene(reading.scene, registry);
  EXPECT_NE(saved.find(R"("plot": 2)"), std::string::npos) << saved;
  EXPECT_TRUE(read_scene(saved, registry).scene == reading.scene);
  std::string newer = saved;
  newer.replace(newer.find("\"plot\": 2"), 9, "\"plot\": 3");
  EXPECT_EQ(read_scene(newer, registry).first_error().text(),
            "nodes/a/types/plot: `plot` was saved by a newer version of the program (revision 3)");
}

TEST(SceneFile, RandomByteEditsGiveErrorsNeverCrashes) {
  const std::string good = with_nodes(
      R"({"id": "a", "position": [1, 2, 3], "types": {"smart_volume": {"demand": 5}}}, {"id": "b"})",
      R"(, "links": [{"id": "l", "kind": "attract", "from": "a", "to": ["a", "b"], "strength": 0.5}], "view": {"k": 1})");
  ASSERT_EQ(first_error(good), "");
  bl::Random random(5);
  for (int i = 0; i < 3000; ++i) {
    std::string text = good;
    for (std::uint64_t edits = 1 + random.below(3); edits > 0; --edits)
      text[random.below(text.size())] = static_cast<char>(random.below(256));
    const SceneReading reading = read_scene(text, full_registry());
    if (!reading.is_usable()) {
      EXPECT_GT(reading.first_error().message.size(), 5u);
    } else {
      EXPECT_TRUE(read_scene(write_scene(reading.scene, full_registry()), full_registry()).is_usable()) << text;
    }
  }
}

class FileTest : public testing::Test {
 protected:
  std::filesystem::path folder_ = std::filesystem::temp_directory_path() / ("bl_file_test_" + std::to_string(::getpid()));
  void SetUp() override { std::filesystem::create_directories(folder_); }
  void TearDown() override { std::filesystem::remove_all(folder_); }
};

TEST_F(FileTest, WritesAndReadsBack) {
  const std::string path = (folder_ / "a.json").string();
  ASSERT_TRUE(write_file(path, "one").ok());
  ASSERT_TRUE(write_file(path, "two").ok());
  EXPECT_EQ(*read_file(path), "two");
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder_), {}), 1);
}

TEST_F(FileTest, SaysWhyAFileCannotBeReadOrWritten) {
  EXPECT_EQ(read_file((folder_ / "none").string()).error().message, "cannot be opened: No such file or directory");
  EXPECT_EQ(read_file(folder_.string()).error().message, "is a folder, not a file");
  EXPECT_EQ(write_file((folder_ / "none" / "a").string(), "x").error().message, "cannot be written: No such file or directory");
  EXPECT_EQ(write_file("/dev/full", "x").error().message, "cannot be written: No space left on device");
}

TEST_F(FileTest, AFullDiskLeavesTheOldFileWhole) {
  const std::string path = (folder_ / "a.json").string();
  ASSERT_TRUE(write_file(path, "old").ok());
  // A limit on the size of files stands in for a full disk: the write stops half way.
  rlimit limit{};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &limit), 0);
  const auto old_handler = std::signal(SIGXFSZ, SIG_IGN);
  const rlimit small{1000, limit.rlim_max};
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);
  const auto saved = write_file(path, std::string(5000, 'x'));
  ::setrlimit(RLIMIT_FSIZE, &limit);
  std::signal(SIGXFSZ, old_handler);
  ASSERT_FALSE(saved.ok());
  EXPECT_EQ(saved.error().message, "could not be saved, the old file is unchanged: File too large");
  EXPECT_EQ(*read_file(path), "old");
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder_), {}), 1);
}

}  // namespace
}  // namespace bl
