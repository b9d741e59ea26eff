// Bad scenes by hand: each is refused, or run as far as it goes, with a sentence that says where and why.
#include <gtest/gtest.h>

#include "tests/ui/cli/program.h"

namespace bl::test {

namespace {

struct BadScene {
  const char* name;
  std::string text;
  const char* said;
  friend std::ostream& operator<<(std::ostream& out, const BadScene& scene) { return out << scene.name; }
};

class RefusedScene : public testing::TestWithParam<BadScene> {};

TEST_P(RefusedScene, HasASentenceWithAPlace) {
  const Workplace place;
  place.write("s.json", GetParam().text);
  for (const char* command : {"run", "check"}) {
    const Outcome outcome = place.run({command, "s.json"});
    EXPECT_EQ(outcome.code, 2) << command;
    EXPECT_TRUE(outcome.err.starts_with("s.json: ")) << outcome.err;
    EXPECT_NE(outcome.err.find(GetParam().said), std::string::npos) << outcome.err;
  }
}

std::string with(const std::string& nodes, const std::string& links = "") { return scene_text(nodes, links); }

INSTANTIATE_TEST_SUITE_P(
    ByHand, RefusedScene,
    testing::Values(
        BadScene{"truncated", with(volume_text("a", "[0, 0, 5]")).substr(0, 120), "line "}, BadScene{"empty", "", ""},
        BadScene{"unknown_field", with(R"({"id": "a", "postion": [0, 0, 5]})"),
                 "nodes/a/postion: unknown field `postion`, did you mean `position`?"},
        BadScene{"unknown_port", with(R"({"id": "a", "types": {"smart_volume": {"demnd": 5}}})"), "did you mean `demand`?"},
        BadScene{"text_with_unit", with(volume_text("a", "[0, 0, 5]", "\"500 m3\"")), "found the text \"500 m3\"; write 500"},
        BadScene{"wrong_unit", with(volume_text("a", "[0, 0, 5]", "\"500 m2\"")), "which is in square metres"},
        BadScene{"link_to_nobody",
                 with(volume_text("tower", "[0, 0, 5]"), R"({"id": "l", "kind": "attract", "from": "tower", "to": "towre"})"),
                 "links/l/to: there is no node `towre`, did you mean `tower`?"},
        BadScene{"not_a_number", with(volume_text("a", "[0, 0, NaN]")), "line "},
        BadScene{"too_large", with(volume_text("a", "[0, 0, 1e300]")), "nodes/a/position: lies farther than 10 000 km"},
        BadScene{"too_large_demand", with(volume_text("a", "[0, 0, 5]", "1e300")), "1e+300"},
        BadScene{"beyond_a_double", with(volume_text("a", "[0, 0, 5]", "1e999")), "a number is too large for a double"},
        BadScene{"duplicate", with(volume_text("a", "[0, 0, 5]") + "," + volume_text("a", "[5, 0, 5]")),
                 "nodes/a: two nodes have the id `a`"},
        BadScene{"newer", R"({"format": "behaviourlinks", "version": 2, "nodes": [], "links": []})",
                 "the file has version 2, this program reads up to 1"},
        BadScene{"no_scene", R"({"type": "FeatureCollection"})", "this is not a scene"}),
    [](const auto& test_case) { return std::string(test_case.param.name); });

TEST(BadInput, AllProblemsAreListedErrorsFirst) {
  const Workplace place;
  place.write("s.json",
              with(volume_text("a", "[0, 0, 5]", "-1") + R"(, {"id": "b", "types": {"hologram": {}}}, {"id": "c", "nme": "x"})"));
  const Outcome outcome = place.run({"check", "s.json", "--json", "p.json"});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_NE(outcome.err.find("nodes/a/types/smart_volume/demand"), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find("nodes/c/nme"), std::string::npos) << outcome.err;
  const nlohmann::json report = place.json("p.json")["scenes"][0];
  EXPECT_FALSE(report["ok"]);
  EXPECT_GE(report["problems"].size(), 2u);
  EXPECT_EQ(report["problems"][0]["severity"], "error");
}

TEST(BadInput, BoundariesThatAreNone) {
  const Workplace place;
  for (
      const auto& [boundary, said] :
      {std::pair<const char*, const char*>{R"({"points": [[0, 0, 0], [9, 0, 0], [0, 9, 0]]})", "at least 4"},
       {R"({"form": "plan", "plan": [[0, 0, 0], [9, 9, 0], [9, 0, 0], [0, 9, 0]]})", "cross"},
       {R"({"form": "plan", "plan": [[0, 0, 0], [9, 0, 0], [0, 9, 0]], "holes": [{"x": 8, "y": 8}, {"x": 9, "y": 8}, {"x": 8, "y": 9}]})",
        "outside the plan"}}) {
    place.write("s.json", scene_text(volume_text("a", "[2, 2, 5]"), "", boundary));
    const Outcome check = place.run({"check", "s.json"});
    EXPECT_EQ(check.code, 2) << boundary;
    EXPECT_NE(check.err.find("s.json: nodes/site/boundary/"), std::string::npos) << check.err;
    EXPECT_NE(check.err.find(said), std::string::npos) << check.err;
    const Outcome run = place.run({"run", "s.json"});
    EXPECT_EQ(run.code, 2) << boundary;
    EXPECT_NE(run.last_line().find(said), std::string::npos) << run.last_line();
  }
}

TEST(BadInput, VolumesInTheWrongPlaceAreAccountedFor) {
  const Workplace place;
  place.write("s.json", with(volume_text("first", "[0, 0, 5]") + "," + volume_text("second", "[0, 0, 5]") + "," +
                             volume_text("stray", "[90, 0, 5]")));
  const Outcome check = place.run({"check", "s.json"});
  EXPECT_EQ(check.code, 0) << "a scene may be run as it is";
  EXPECT_NE(check.err.find("is coincident"), std::string::npos) << check.err;
  EXPECT_NE(check.err.find("nodes/stray: warning: is outside"), std::string::npos) << check.err;
  const Outcome run = place.run({"run", "s.json", "--json", "r.json"});
  EXPECT_EQ(run.code, 3);
  EXPECT_EQ(place.json("r.json")["volumes"].size(), 3u);
  EXPECT_NE(run.out.find("coincident: "), std::string::npos) << run.out;
}

TEST(BadInput, UnknownTypesAreKept) {
  const Workplace place;
  place.write("s.json", with(R"({"id": "b", "types": {"hologram": {"colour": [1, 2.50, "x"]}}})"));
  const Outcome outcome = place.run({"check", "s.json", "--write"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_NE(outcome.err.find("warning: unknown typification `hologram`"), std::string::npos) << outcome.err;
  EXPECT_NE(place.text("s.json").find(R"("hologram": {"colour": [1, 2.5, "x"]})"), std::string::npos) << place.text("s.json");
  EXPECT_EQ(outcome.last_line(), "ok: 3 nodes, 0 links, 1 warning; rewritten");
  const std::string once = place.text("s.json");
  EXPECT_EQ(place.run({"check", "s.json", "--write"}).last_line(), "ok: 3 nodes, 0 links, 1 warning");
  EXPECT_EQ(place.text("s.json"), once);
}

TEST(BadInput, CheckRewritesSoundFilesAlone) {
  const Workplace place;
  // It can be read, but a plan that crosses itself only shows when the scene runs.
  const std::string text =
      scene_text(volume_text("a", "[2, 2, 5]"), "", R"({"form": "plan", "plan": [[0, 0, 0], [9, 9, 0], [9, 0, 0], [0, 9, 0]]})");
  place.write("s.json", text);
  const Outcome outcome = place.run({"check", "s.json", "--write"});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_EQ(place.text("s.json"), text);
  EXPECT_TRUE(outcome.last_line().ends_with("; not rewritten")) << outcome.last_line();
}

TEST(BadInput, FilesThatCannotBeRead) {
  const Workplace place;
  std::filesystem::create_directory(place.path("folder"));
  for (const char* command : {"run", "check", "replay"}) {
    const Outcome missing = place.run({command, "nowhere.json"});
    EXPECT_EQ(missing.code, 2);
    EXPECT_EQ(missing.err, "nowhere.json: cannot be opened: No such file or directory\n");
    const Outcome folder = place.run({command, "folder"});
    EXPECT_EQ(folder.code, 2);
    EXPECT_EQ(folder.err, "folder: is a folder, not a file\n");
  }
}

// An archive under the name of a scene: what it is, and what to do.
TEST(BadInput, ArchivesAreNamedWhateverTheyAreCalled) {
  const Workplace place;
  place.write("s.json", std::string("PK\x03\x04", 4) + std::string(200, '\0'));
  for (const char* command : {"run", "check", "compare"}) {
    const Outcome outcome = place.run(command == std::string("compare") ? std::vector<std::string>{command, "s.json", "s.json"}
                                                                        : std::vector<std::string>{command, "s.json"});
    EXPECT_EQ(outcome.code, 2) << command;
    EXPECT_NE((outcome.out + outcome.err).find("zip archive"), std::string::npos) << command << ": " << outcome.err;
    EXPECT_NE((outcome.out + outcome.err).find("unpack it first"), std::string::npos) << command << ": " << outcome.err;
  }
}

}  // namespace

}  // namespace bl::test
