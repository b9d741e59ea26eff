// No task writes over what it reads, over another output, or over a file of another kind: the rule of ui/cli/file_rule.h.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <sstream>

#include "tests/ui/cli/program.h"

namespace bl::test {

namespace {

const std::string kHoldingScript =
    "return {id = 'held', doc = 'Holds.', reads = {here = {at = 'from', port = 'node.position', unit = 'm'}},\n"
    "proposes = {move = {at = 'from', port = 'node.position', unit = 'm'}},\n"
    "evaluate = function(params, ends, tick) return {move = point(0, 0, 0)} end}\n";
const std::string kSquarePlan =
    R"({"type": "Feature", "properties": {}, "geometry": {"type": "Polygon", "coordinates": [[[0,0],[40,0],[40,40],[0,40],[0,0]]]}})";

class FileRule : public testing::Test {
 public:
  FileRule() {
    place.write("s.json", moving_scene());
    place.write("b.json", moving_scene());
    place.write("f.lua", kHoldingScript);
    place.write("site.geojson", kSquarePlan);
    place.write("rows.csv", "x,y,value\n1,2,3\n");
    place.write("case.json", R"({"boundary": {"plan": [[0,0],[10,0],[10,10],[0,10]], "bottom": 0, "top": 10},
                                "sites": [[2,5,5]], "weights": [4], "demands": [10]})");
  }

  // The call is refused with a sentence, and no file that was there is another.
  void expect_refused(const std::vector<std::string>& arguments, const std::string& said) {
    std::map<std::string, std::string> before;
    for (const auto& file : std::filesystem::recursive_directory_iterator(place.path("")))
      if (file.is_regular_file()) before[file.path().string()] = read_text(file.path());
    const Outcome outcome = place.run(arguments);
    std::string line;
    for (const std::string& argument : arguments) line += argument + " ";
    EXPECT_EQ(outcome.code, 2) << line;
    EXPECT_NE(outcome.err.find(said), std::string::npos) << line << "\n" << outcome.err;
    for (const auto& [file, text] : before)
      if (!file.ends_with(".out") && !file.ends_with(".err")) { EXPECT_EQ(read_text(file), text) << line; }
  }

  Workplace place;
};

TEST_F(FileRule, OutputsAreNoInputs) {
  expect_refused({"check", "s.json", "--json", "s.json"}, "--json would be written over `s.json`, which is read (FILE)");
  expect_refused({"check", "s.json", "b.json", "--json", "b.json"}, "which is read");
  expect_refused({"compare", "s.json", "b.json", "--report", "s.json", "--ticks", "1"}, "which is read (SCENE_A)");
  expect_refused({"compare", "s.json", "b.json", "--report", "b.json", "--ticks", "1"}, "which is read (SCENE_B)");
  expect_refused({"import", "rows.csv", "--into", "s.json", "--out", "o.json", "--report", "rows.csv"}, "which is read (FILE)");
  expect_refused({"import", "rows.csv", "--into", "s.json", "--out", "o.json", "--report", "s.json"}, "which is read (--into)");
  expect_refused({"import", "site.geojson", "--out", "site.geojson", "--force"}, "which is read");
  expect_refused({"run", "s.json", "--script", "f.lua", "--json", "f.lua", "--ticks", "1"}, "which is read (--script)");
  expect_refused({"run", "s.json", "--script", "f.lua", "--log", "s.json", "--ticks", "1"}, "which is read (SCENE)");
  expect_refused({"cells", "case.json", "--json", "case.json"}, "which is read");
  expect_refused({"fit", "case.json", "--json", "./case.json"}, "which is read");
  expect_refused(
      {"new", "--boundary", "site.geojson", "--height", "9", "--programme", "rows.csv", "--out", "rows.csv", "--force"},
      "which is read (--programme)");
  expect_refused({"assign", "rows.csv", "case.json", "--json", "case.json"}, "which is read (TRIPS)");
  expect_refused({"script", "s.json", "f.lua", "--out", "o.json", "--extract", "."}, "which is read");
  expect_refused({"docs", "--from", "f.lua", "--out", "f.lua"}, "");
}

TEST_F(FileRule, AFileHasManyNames) {
  std::filesystem::create_symlink("s.json", place.path("link.json"));
  std::filesystem::create_hard_link(place.path("s.json"), place.path("twin.json"));
  std::filesystem::create_directory(place.path("folder"));
  for (const char* name : {"link.json", "twin.json", "./s.json", "folder/../s.json"})
    expect_refused({"check", "s.json", "--json", name}, "which is read");
  expect_refused({"check", "s.json", "--json", place.path("s.json").string()}, "which is read");
}

TEST_F(FileRule, TwoOutputsAreTwoFiles) {
  expect_refused({"run", "s.json", "--ticks", "1", "--json", "o", "--log", "o"}, "would write the same file `o`");
  expect_refused({"run", "s.json", "--ticks", "1", "--json", "o", "--save", "./o"}, "would write the same file");
  expect_refused({"run", "s.json", "--ticks", "1", "--json", "out/volumes.csv", "--report", "out"}, "would write the same file");
  expect_refused({"import", "rows.csv", "--out", "o.json", "--report", "o.json"}, "would write the same file");
  EXPECT_FALSE(std::filesystem::exists(place.path("o"))) << "nothing is left behind";
  const Outcome both = place.run({"run", "s.json", "--ticks", "1", "--json", "/dev/null", "--log", "/dev/null"});
  EXPECT_EQ(both.code, 0) << "devices take what comes: " << both.err;
}

TEST_F(FileRule, OtherKindsStay) {
  expect_refused({"import", "rows.csv", "--out", "o.json", "--report", "b.json"},
                 "--report: `b.json` is there and holds a scene, and a table would replace it");
  expect_refused({"run", "s.json", "--ticks", "1", "--json", "b.json"}, "holds a scene, and figures as JSON would replace it");
  expect_refused({"run", "s.json", "--ticks", "1", "--json", "f.lua"}, "holds another text");
  expect_refused({"run", "s.json", "--ticks", "1", "--save", "case.json"}, "holds figures as JSON, and a scene would replace it");
  expect_refused({"run", "s.json", "--ticks", "1", "--log", "rows.csv"}, "holds a table, and a log");
  expect_refused({"run", "s.json", "--ticks", "1", "--json", "site.geojson"}, "holds a map");
  expect_refused({"compare", "s.json", "b.json", "--ticks", "1", "--report", "rows.csv"}, "holds a table, and a page");
  expect_refused({"schema", "--out", "b.json"}, "holds a scene");
}

// What was written may be written again, and what a task is there to change is changed.
TEST_F(FileRule, TheSameKindIsReplaced) {
  place.write("empty.json", "");
  for (int i = 0; i < 2; ++i) {
    const Outcome run = place.run(
        {"run", "s.json", "--ticks", "1", "--json", "empty.json", "--log", "o.log", "--save", "o.json", "--report", "out"});
    EXPECT_EQ(run.code, 0) << run.err;
    EXPECT_EQ(place.run({"compare", "s.json", "b.json", "--ticks", "1", "--report", "page.html"}).code, 0);
    EXPECT_EQ(place
                  .run({"import", "rows.csv", "--as", "layer", "--value", "value", "--into", "s.json", "--out", "i.json",
                        "--force", "--report", "i.csv"})
                  .code,
              0);
    EXPECT_EQ(place.run({"schema", "--out", "schema.json"}).code, 0);
    EXPECT_EQ(place.run({"check", "s.json", "--write", "--json", "problems.json"}).code, 0);
    EXPECT_EQ(place.run({"script", "s.json", "f.lua", "--out", "s.json"}).code, 0);
    EXPECT_EQ(place.run({"run", "o.json", "--ticks", "1", "--save", "o.json"}).code, 0);
  }
}

TEST_F(FileRule, ExtractedScriptsThatWereChangedStay) {
  EXPECT_EQ(place.run({"script", "s.json", "f.lua", "--out", "s.json"}).code, 0);
  EXPECT_EQ(place.run({"script", "s.json", "--extract", "lua"}).code, 0);
  EXPECT_EQ(place.run({"script", "s.json", "--extract", "lua"}).code, 0) << "the same text may be written again";
  place.write("lua/f.lua", kHoldingScript + "-- an afternoon's work\n");
  expect_refused({"script", "s.json", "--extract", "lua"}, "lua/f.lua: is there and is not what the scene holds");
  EXPECT_EQ(place.run({"script", "s.json", "--extract", "lua", "--force"}).code, 0);
  EXPECT_EQ(place.text("lua/f.lua"), kHoldingScript);
}

// Law over all tasks and options, as the help lists them: a file that is named twice is refused where one of the two is written,
// and is never another afterwards, but where the task is there to change it.
struct FileOption {
  std::string name, type;  // "" for an argument
  bool is_required = false;
};

std::vector<FileOption> file_options(const std::string& help) {
  static const std::set<std::string> kTypes = {"FILE", "SCENE", "SCENE_A", "SCENE_B", "FILE.lua", "DIR",
                                               "OUT",  "LOG",   "PICTURE", "NET",     "TRIPS"};
  std::vector<FileOption> options;
  std::istringstream lines(help);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::vector<std::string> all;
    for (std::string word; words >> word;) all.push_back(word);
    if (!line.starts_with("  ") || all.size() < 2) continue;
    const auto type = std::find_if(all.begin(), all.begin() + 2, [](const std::string& word) { return kTypes.contains(word); });
    if (type == all.begin() + 2 || (type == all.begin() + 1 && all[0].starts_with("behaviourlinks"))) continue;
    const bool is_required = std::find(all.begin(), all.end(), "REQUIRED") != all.end();
    options.push_back({all[0].starts_with("--") ? all[0] : "", *type, is_required});
  }
  return options;
}

TEST_F(FileRule, HoldsForEveryPairOfOptionsOfEveryTask) {
  const std::set<std::string> in_place = {"run --save", "script --out", "import --out", "place --out"};
  int pairs = 0;
  for (const std::string task : {"run", "new", "check", "docs", "schema", "replay", "bench", "cells", "fit", "assign", "import",
                                 "script", "compare", "place"}) {
    const std::vector<FileOption> options = file_options(place.run({task, "--help"}).out);
    ASSERT_FALSE(options.empty()) << task;
    for (std::size_t a = 0; a < options.size(); ++a)
      for (std::size_t b = a + 1; b < options.size(); ++b) {
        place.write("twice", moving_scene());
        std::vector<std::string> call = {task};
        if (task == "bench") call.insert(call.end(), {"--solver", "--quick", "--rows", "drag"});
        if (task == "new") call.insert(call.end(), {"--height", "9", "--force"});
        for (std::size_t i = 0; i < options.size(); ++i) {
          const bool is_one = i == a || i == b;
          if (!is_one && !options[i].is_required && options[i].name != "--json") continue;
          if (!options[i].name.empty()) call.push_back(options[i].name);
          call.push_back(is_one ? "twice" : "other" + std::to_string(i));
        }
        const Outcome outcome = place.run(call);
        const std::string what = task + " " + options[a].name + options[a].type + " " + options[b].name + options[b].type;
        EXPECT_EQ(outcome.err.find("defect"), std::string::npos) << what << "\n" << outcome.err;
        const bool is_changing =
            in_place.contains(task + " " + options[b].name) || in_place.contains(task + " " + options[a].name);
        if (!is_changing || outcome.code == 2) { EXPECT_EQ(place.text("twice"), moving_scene()) << what << "\n" << outcome.err; }
        const bool is_told =
            outcome.err.find("which is read") != std::string::npos || outcome.err.find("same file") != std::string::npos;
        pairs += is_told ? 1 : 0;
        if (is_told) { EXPECT_EQ(outcome.code, 2) << what; }
      }
  }
  EXPECT_GT(pairs, 25) << "pairs that were refused";
}

}  // namespace

}  // namespace bl::test
