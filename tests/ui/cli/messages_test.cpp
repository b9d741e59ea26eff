// What is said where people err, and where there is nothing to say: in sentences, at once, and of what is there.
#include <gtest/gtest.h>

#include "tests/support/photograph.h"
#include "tests/support/sanitized.h"
#include "tests/ui/cli/program.h"

namespace bl::test {

namespace {

class Messages : public testing::Test {
 protected:
  Messages() {
    place.write("s.json", moving_scene());
    place.write("corner.geojson", corner);
    place.write("brief.csv", "use,floor_area_m2,count,storey_height_m\nhousing,100,2,3\n");
  }
  void expect_refused(const std::vector<std::string>& arguments, const std::string& said, const std::string& not_said = "") {
    const Outcome outcome = place.run(arguments);
    EXPECT_EQ(outcome.code, 2) << said << "\n" << outcome.out;
    EXPECT_NE(outcome.err.find(said), std::string::npos) << outcome.err;
    if (!not_said.empty()) { EXPECT_EQ(outcome.err.find(not_said), std::string::npos) << outcome.err; }
  }
  std::vector<std::string> new_scene(const std::string& height, std::vector<std::string> more = {}) const {
    std::vector<std::string> call{"new",         "--boundary", "corner.geojson", "--height", height,
                                  "--programme", "brief.csv",  "--out",          "o.json"};
    call.insert(call.end(), more.begin(), more.end());
    return call;
  }

  // An L, whose wings are 30 m wide.
  const std::string corner =
      R"({"type": "Polygon", "crs": {"type": "name", "properties": {"name": "EPSG:28992"}}, "coordinates": [[[85000, 446000],
      [85090, 446000], [85090, 446030], [85030, 446030], [85030, 446090], [85000, 446090], [85000, 446000]]]})";
  Workplace place;
};

TEST_F(Messages, CommandLinesAreAnsweredInSentences) {
  expect_refused({"compare", "s.json"}, "SCENE_B is missing: a second scene", "second is required");
  expect_refused({"new", "--boundary", "corner.geojson", "--height", "9"}, "is missing: ");
  expect_refused({"run", "s.json", "--reprot", "x"}, "there is no option `--reprot`, did you mean `--report`?", "not expected");
  expect_refused({"run", "s.json", "--reprot=x"}, "did you mean `--report`?");
  expect_refused({"compare", "s.json", "s.json", "s.json"}, "`s.json` is one argument more than the task takes");
  expect_refused(new_scene("abc"), "--height: expects a plain number of metres, such as 12, without a unit; found `abc`",
                 "Could not convert");
  expect_refused(new_scene("60 m"), "without a unit; found `60 m`");
  expect_refused({"place", "p.png", "--into", "s.json", "--size", "abc"}, "--size: expects a plain number of metres");
}

// What `check` says of each volume costs the same, however many there are. The limit only ends a check that looks at all volumes
// for each of them several times; times are measured by the benchmarks, never here.
TEST_F(Messages, TensOfThousandsOfVolumesAreChecked) {
  if (test::kIsSanitized) GTEST_SKIP() << "it is about time";
  std::string nodes;
  for (int k = 0; k < 40000; ++k)
    nodes += (k > 0 ? ",\n" : "") + (R"({"id": "n)" + std::to_string(k) + R"(", "types": {"smart_volume": {"demand": 900}}})");
  place.write("many.json", R"({"format": "behaviourlinks", "version": 1, "nodes": [)" + nodes + "]}");
  // Seconds of the processor, so that a busy machine does not decide.
  const Outcome done = place.shell("ulimit -t 60; \"$BEHAVIOURLINKS\" check many.json");
  EXPECT_EQ(done.code, 0) << done.err.substr(0, 300);
  EXPECT_NE(done.out.find(" nodes, 0 links"), std::string::npos) << done.out;
  EXPECT_LT(std::count(done.err.begin(), done.err.end(), '\n'), 100) << "a warning that holds everywhere is not said everywhere";
  EXPECT_NE(done.err.find(" more places: is idle"), std::string::npos) << done.err.substr(0, 3000);
}

TEST_F(Messages, SizesOfPicturesAreMoreThanNothing) {
  place.write("p.jpg", photograph(Photograph()));
  for (const char* size : {"-3", "0"}) {
    expect_refused({"place", "p.jpg", "--into", "s.json", "--out", "o.json", "--size", size}, "must be a width of more than 0 m");
    EXPECT_FALSE(std::filesystem::exists(place.path("o.json")));
  }
  EXPECT_EQ(place.run({"place", "p.jpg", "--into", "s.json", "--out", "o.json", "--size", "3"}).code, 0);
}

TEST_F(Messages, AFileThatIsNoScriptGoesByItsOwnName) {
  place.write("pic.png", std::string("\x89PNG\r\n\x1a\n\0\0\0\rIHDR", 16));
  expect_refused({"script", "s.json", "pic.png", "--out", "o.json"}, "pic.png: is no link script", "pic.lua");
}

// A margin that leaves no room is told by who makes the scene, not by the run that comes after.
TEST_F(Messages, AMarginWithoutRoomIsToldAtOnce) {
  expect_refused(new_scene("20", {"--margin", "40"}), "--margin: a margin of 40 m leaves no room inside the boundary");
  EXPECT_FALSE(std::filesystem::exists(place.path("o.json")));
  const Outcome made = place.run(new_scene("20", {"--margin", "4"}));
  EXPECT_EQ(made.code, 0) << made.err;
}

TEST_F(Messages, ASceneAgainstItselfHasNoDifference) {
  const Outcome outcome = place.run({"compare", "s.json", "s.json"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("No difference: all "), std::string::npos) << outcome.out;
  EXPECT_EQ(outcome.out.find("indicator"), std::string::npos) << "no empty tables: " << outcome.out;
}

// What is refused has not been done, and nothing that is printed reads as if it had.
TEST_F(Messages, ARefusedImportTellsOfNothingTaken) {
  place.write("o.json", moving_scene());
  place.write("rows.csv", "x,y,value\n1,2,3\n");
  const Outcome outcome = place.run({"import", "rows.csv", "--as", "layer", "--value", "value", "--crs", "EPSG:28992", "--out",
                                     "o.json", "--report", "told.csv"});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_NE(outcome.err.find("o.json: exists already"), std::string::npos) << outcome.err;
  EXPECT_EQ(outcome.out, "") << outcome.out;
  EXPECT_NE(place.text("told.csv").find("skipped,file"), std::string::npos) << place.text("told.csv");
}

// Before the first tick nobody has computed anything: no table, no reason, no figure is made up.
TEST_F(Messages, NothingComputedIsSaidSo) {
  const Outcome outcome = place.run({"run", "s.json", "--ticks", "0", "--json", "o.json", "--report", "out", "--save", "k.json"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.last_line(), "not settled: nothing has been computed yet; run a tick or more");
  for (const std::string& text : {outcome.out, place.text("out/report.html"), place.text("out/volumes.csv")}) {
    EXPECT_EQ(text.find("1000"), std::string::npos) << text;
    EXPECT_EQ(text.find("no solver"), std::string::npos) << text;
  }
  EXPECT_NE(place.text("out/report.html").find("nothing has been computed yet"), std::string::npos);
  EXPECT_TRUE(place.json("o.json")["volumes"].empty());
  // A scene that has run tells what it has.
  ASSERT_EQ(place.run({"run", "s.json", "--ticks", "5", "--save", "k.json"}).code, 0);
  EXPECT_NE(place.run({"run", "k.json", "--ticks", "0"}).out.find("alive"), std::string::npos);
}

// One account of who goes short: what the sentence says is what the table has.
TEST_F(Messages, ShortagesAreThoseOfTheTable) {
  place.write("full.json", scene_text(volume_text("big", "[-8, 0, 8]", "40000") + "," + volume_text("small", "[9, 3, 8]", "900") +
                                      "," + volume_text("other", "[9, -9, 5]", "700")));
  const Outcome outcome = place.run({"run", "full.json", "--ticks", "7", "--json", "o.json"});
  const std::string::size_type at = outcome.out.find("short of it fall ");
  ASSERT_NE(at, std::string::npos) << outcome.out;
  const nlohmann::json volumes = place.json("o.json")["volumes"];
  std::size_t told = 0;
  for (const auto& volume : volumes) {
    const std::string name = "`" + volume["id"].get<std::string>() + "` by ";
    const std::size_t where = outcome.out.find(name, at);
    if (where == std::string::npos) continue;
    ++told;
    EXPECT_NEAR(std::stod(outcome.out.substr(where + name.size())),
                volume["demand"].get<double>() - volume["volume"].get<double>(), 0.06)
        << name;
  }
  EXPECT_GE(told, 1u);
}

}  // namespace

}  // namespace bl::test
