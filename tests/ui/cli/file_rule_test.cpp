// No task writes over what it reads, over another output, or over a file of another kind: the rule of ui/cli/file_rule.h.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <sstream>

#include "tests/support/sanitized.h"
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
  expect_refused({"check", "s.json", "--json", "s.json"}, "--json: s.json: is read as FILE; choose another file");
  expect_refused({"check", "s.json", "b.json", "--json", "b.json"}, "is read as");
  expect_refused({"compare", "s.json", "b.json", "--report", "s.json", "--ticks", "1"}, "is read as SCENE_A");
  expect_refused({"compare", "s.json", "b.json", "--report", "b.json", "--ticks", "1"}, "is read as SCENE_B");
  expect_refused({"import", "rows.csv", "--into", "s.json", "--out", "o.json", "--report", "rows.csv"}, "is read as FILE");
  expect_refused({"import", "rows.csv", "--into", "s.json", "--out", "o.json", "--report", "s.json"}, "is read as --into");
  expect_refused({"import", "site.geojson", "--out", "site.geojson", "--force"}, "is read as");
  expect_refused({"run", "s.json", "--script", "f.lua", "--json", "f.lua", "--ticks", "1"}, "is read as --script");
  expect_refused({"run", "s.json", "--script", "f.lua", "--log", "s.json", "--ticks", "1"}, "is read as SCENE");
  expect_refused({"cells", "case.json", "--json", "case.json"}, "is read as");
  expect_refused({"fit", "case.json", "--json", "./case.json"}, "is read as");
  expect_refused(
      {"new", "--boundary", "site.geojson", "--height", "9", "--programme", "rows.csv", "--out", "rows.csv", "--force"},
      "is read as --programme");
  expect_refused({"assign", "rows.csv", "case.json", "--json", "case.json"}, "is read as TRIPS");
  expect_refused({"script", "s.json", "f.lua", "--out", "o.json", "--extract", "."}, "is read as");
  expect_refused({"docs", "--from", "f.lua", "--out", "f.lua"}, "");
}

TEST_F(FileRule, AFileHasManyNames) {
  std::filesystem::create_symlink("s.json", place.path("link.json"));
  std::filesystem::create_hard_link(place.path("s.json"), place.path("twin.json"));
  std::filesystem::create_directory(place.path("folder"));
  for (const char* name : {"link.json", "twin.json", "./s.json", "folder/../s.json"})
    expect_refused({"check", "s.json", "--json", name}, "is read as");
  expect_refused({"check", "s.json", "--json", place.path("s.json").string()}, "is read as");
}

TEST_F(FileRule, TwoOutputsAreTwoFiles) {
  expect_refused({"run", "s.json", "--ticks", "1", "--json", "o", "--log", "o"},
                 "--json: o: is written by --log already; choose another file");
  expect_refused({"run", "s.json", "--ticks", "1", "--json", "o", "--save", "./o"}, " already; choose another");
  expect_refused({"run", "s.json", "--ticks", "1", "--json", "out/volumes.csv", "--report", "out"}, " already; choose another");
  expect_refused({"import", "rows.csv", "--out", "o.json", "--report", "o.json"}, " already; choose another");
  EXPECT_FALSE(std::filesystem::exists(place.path("o"))) << "nothing is left behind";
  const Outcome both = place.run({"run", "s.json", "--ticks", "1", "--json", "/dev/null", "--log", "/dev/null"});
  EXPECT_EQ(both.code, 0) << "devices take what comes: " << both.err;
}

TEST_F(FileRule, OtherKindsStay) {
  expect_refused({"import", "rows.csv", "--out", "o.json", "--report", "b.json"},
                 "--report: b.json: exists already and holds a scene, not a table");
  expect_refused({"run", "s.json", "--ticks", "1", "--json", "b.json"}, "holds a scene, not figures as JSON");
  expect_refused({"run", "s.json", "--ticks", "1", "--json", "f.lua"}, "holds another text");
  expect_refused({"run", "s.json", "--ticks", "1", "--save", "case.json"}, "holds figures as JSON, not a scene");
  expect_refused({"run", "s.json", "--ticks", "1", "--log", "rows.csv"}, "holds a table, not a log");
  expect_refused({"run", "s.json", "--ticks", "1", "--json", "site.geojson"}, "holds a map");
  expect_refused({"compare", "s.json", "b.json", "--ticks", "1", "--report", "rows.csv"}, "holds a table, not a page");
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
                  .run({"import", "rows.csv", "--as", "layer", "--value", "value", "--crs", "EPSG:28992", "--into", "s.json",
                        "--out", "i.json", "--force", "--report", "i.csv"})
                  .code,
              0);
    EXPECT_EQ(place.run({"schema", "--out", "schema.json"}).code, 0);
    EXPECT_EQ(place.run({"check", "s.json", "--write", "--json", "problems.json"}).code, 0);
    EXPECT_EQ(place.run({"script", "s.json", "f.lua", "--out", "s.json"}).code, 0);
    EXPECT_EQ(place.run({"run", "o.json", "--ticks", "1", "--save", "o.json"}).code, 0);
  }
}

// A folder of a report may hold other things; what lies under a name of the report is of one, or the run does not begin.
TEST_F(FileRule, ReportsLeaveWhatIsSomebodyElses) {
  std::filesystem::create_directory(place.path("out"));
  for (const char* name :
       {"plots.csv", "uses.csv", "volumes.csv", "conflicts.csv", "sun_map.csv", "report.html", "volumes.obj"}) {
    place.write(std::string("out/") + name, "id\n1\n");
    expect_refused({"run", "s.json", "--ticks", "1", "--report", "out"},
                   std::string("--report: out/") + name + ": is there already and is no ");
    std::filesystem::remove(place.path(std::string("out/") + name));
  }
  place.write("out/report.html", "<!DOCTYPE html>\n<html><head><title>Mine</title></head></html>\n");
  expect_refused({"run", "s.json", "--ticks", "1", "--report", "out"}, "out/report.html: is there already and is no page");
  std::filesystem::remove(place.path("out/report.html"));
  // What is ours is replaced, and emptied where there is nothing to tell any more; all else stays.
  place.write("out/mine.csv", "id\n1\n");
  place.write("out/uses.csv", "");
  place.write("out/streets.csv", "id,name,used_length [m],lanes\r\nold,Old street,5,1\r\n");
  for (int i = 0; i < 2; ++i) EXPECT_EQ(place.run({"run", "s.json", "--ticks", "1", "--report", "out"}).code, 0);
  EXPECT_EQ(place.text("out/streets.csv").find("Old street"), std::string::npos);
  EXPECT_EQ(place.text("out/mine.csv"), "id\n1\n");
  EXPECT_NE(place.text("out/uses.csv").find("housing"), std::string::npos);
  // A page that compares is no page of a run.
  EXPECT_EQ(place.run({"compare", "s.json", "b.json", "--ticks", "1", "--report", "out/difference.html"}).code, 0);
  std::filesystem::rename(place.path("out/difference.html"), place.path("out/report.html"));
  expect_refused({"run", "s.json", "--ticks", "1", "--report", "out"}, "out/report.html: is there already");
}

TEST_F(FileRule, TheCatalogueLeavesWhatIsSomebodyElses) {
  std::filesystem::create_directory(place.path("pages"));
  place.write("pages/README.md", "# Mine\n");
  expect_refused({"docs", "--out", "pages"}, "pages/README.md: exists already and is no page of the catalogue");
  EXPECT_FALSE(std::filesystem::exists(place.path("pages/nodes"))) << "all or nothing";
  place.write("pages/README.md", "");
  for (int i = 0; i < 2; ++i) EXPECT_EQ(place.run({"docs", "--out", "pages"}).code, 0);
}

// Told before the work, not after it: nothing has been computed that could be shown.
TEST_F(FileRule, WhatCannotBeWrittenIsToldAtOnce) {
  std::filesystem::create_directory(place.path("folder"));
  const auto refused_at_once = [&](const std::vector<std::string>& options, const std::string& said) {
    std::vector<std::string> arguments{"run", "s.json", "--ticks", "1"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const Outcome outcome = place.run(arguments);
    EXPECT_EQ(outcome.code, 2) << options.back();
    EXPECT_EQ(outcome.out, "") << options.back();
    EXPECT_NE(outcome.err.find(said), std::string::npos) << outcome.err;
  };
  refused_at_once({"--report", "rows.csv"}, "rows.csv is a file, not a folder");
  refused_at_once({"--report", "rows.csv/deeper"}, "rows.csv is a file, not a folder");
  refused_at_once({"--json", "folder"}, "--json: folder: is a folder, not a file; choose another name");
  refused_at_once({"--log", "folder"}, "--log: folder: is a folder");
  // Nobody makes files there, not even who may do everything.
  refused_at_once({"--json", "/proc/o.json"}, "--json: /proc/o.json: cannot be written");
  refused_at_once({"--report", "/proc/out"}, "--report: /proc/out: nothing can be written there");
  EXPECT_TRUE(std::filesystem::is_empty(place.path("folder")));
  // Trying leaves nothing behind.
  EXPECT_EQ(place.run({"run", "s.json", "--ticks", "1", "--json", "folder/o.json"}).code, 0);
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(place.path("folder")), {}), 1);
}

TEST_F(FileRule, EmptyNamesAreRefusedWithTheirOption) {
  expect_refused({"run", "", "--report", "out"}, "SCENE: names no file; say which one");
  expect_refused({"run", "s.json", "--script", "", "--report", "out"}, "--script: names no file");
  expect_refused({"run", "s.json", "--report", ""}, "--report: names no folder");
  expect_refused({"script", "s.json", "", "--extract", "lua"}, "FILE.lua: names no file");
  expect_refused({"docs", "--from", "", "--out", "d"}, "--from: names no file");
  expect_refused({"cells", "", "--json", "x.json"}, "FILE: names no file");
  expect_refused({"cells", "case.json", "--json", ""}, "--json: names no file");
}

// --force is for --out, as its help says: the report of an import is another file.
TEST_F(FileRule, ForceReplacesNothingButTheOutput) {
  expect_refused({"import", "rows.csv", "--as", "layer", "--value", "value", "--crs", "EPSG:28992", "--out", "o.json", "--force",
                  "--report", "b.json"},
                 "--report: b.json: exists already and holds a scene, not a table; choose another name, or remove it first");
  expect_refused({"import", "rows.csv", "--out", "case.json"}, "or replace it with --force");
}

TEST_F(FileRule, ExtractedScriptsThatWereChangedStay) {
  EXPECT_EQ(place.run({"script", "s.json", "f.lua", "--out", "s.json"}).code, 0);
  EXPECT_EQ(place.run({"script", "s.json", "--extract", "lua"}).code, 0);
  EXPECT_EQ(place.run({"script", "s.json", "--extract", "lua"}).code, 0) << "the same text may be written again";
  place.write("lua/f.lua", kHoldingScript + "-- an afternoon's work\n");
  expect_refused({"script", "s.json", "--extract", "lua"}, "lua/f.lua: exists and differs from the script in the scene");
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
  std::vector<std::string> tasks = {"run",   "new", "check",  "docs",   "schema", "replay",  "erase", "minutes",
                                    "cells", "fit", "assign", "import", "script", "compare", "place"};
  if (!kIsSanitized) tasks.push_back("bench");  // a build with sanitizers has none
  for (const std::string& task : tasks) {
    const bool is_bench = task == "bench";
    const std::vector<FileOption> options = file_options((is_bench ? place.bench({"--help"}) : place.run({task, "--help"})).out);
    ASSERT_FALSE(options.empty()) << task;
    for (std::size_t a = 0; a < options.size(); ++a)
      for (std::size_t b = a + 1; b < options.size(); ++b) {
        place.write("twice", moving_scene());
        std::vector<std::string> call =
            is_bench ? std::vector<std::string>{"--solver", "--quick", "--rows", "drag"} : std::vector<std::string>{task};
        if (task == "new") call.insert(call.end(), {"--height", "9", "--force"});
        for (std::size_t i = 0; i < options.size(); ++i) {
          const bool is_one = i == a || i == b;
          if (!is_one && !options[i].is_required && options[i].name != "--json") continue;
          if (!options[i].name.empty()) call.push_back(options[i].name);
          call.push_back(is_one ? "twice" : "other" + std::to_string(i));
        }
        const Outcome outcome = is_bench ? place.bench(call) : place.run(call);
        const std::string what = task + " " + options[a].name + options[a].type + " " + options[b].name + options[b].type;
        EXPECT_EQ(outcome.err.find("defect"), std::string::npos) << what << "\n" << outcome.err;
        const bool is_changing =
            in_place.contains(task + " " + options[b].name) || in_place.contains(task + " " + options[a].name);
        if (!is_changing || outcome.code == 2) { EXPECT_EQ(place.text("twice"), moving_scene()) << what << "\n" << outcome.err; }
        const bool is_told = outcome.err.find("is read as") != std::string::npos ||
                             outcome.err.find(" already; choose another ") != std::string::npos;
        pairs += is_told ? 1 : 0;
        if (is_told) { EXPECT_EQ(outcome.code, 2) << what; }
      }
  }
  EXPECT_GT(pairs, 20) << "pairs that were refused";
}

}  // namespace

}  // namespace bl::test
