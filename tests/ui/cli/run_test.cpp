// `run` and `replay`: last lines, exit codes, files, and one result however it is reached.
#include <gtest/gtest.h>

#include "tests/ui/cli/program.h"

namespace bl::test {

namespace {

// Whoever writes into a saved file means what they write, and not the figures of before.
TEST(Run, ASavedSceneThatWasEditedStartsAnew) {
  const Workplace place;
  place.write("s.json", moving_scene());
  ASSERT_EQ(place.run({"run", "s.json", "--save", "saved.json"}).code, 0);
  EXPECT_EQ(place.run({"run", "saved.json", "--json", "same.json"}).err.find("edited"), std::string::npos);
  for (const auto& [from, to] : {std::pair{"\"demand\": 2000", "\"demand\": 4000"}, {"\"calm\": ", "\"calm\": 1"}}) {
    std::string text = place.text("saved.json");
    const std::size_t at = text.find(from);
    ASSERT_NE(at, std::string::npos) << from << text;
    std::string plain = moving_scene();
    if (const std::size_t wish = plain.find(from); wish != std::string::npos) plain.replace(wish, std::string(from).size(), to);
    place.write("plain.json", plain);
    ASSERT_NE(place.run({"run", "plain.json", "--json", "anew.json"}).code, 2);
    place.write("edited.json", text.replace(at, std::string(from).size(), to));
    const Outcome outcome = place.run({"run", "edited.json", "--json", "r.json"});
    EXPECT_NE(outcome.err.find("the file was edited after this running state was saved"), std::string::npos) << outcome.err;
    EXPECT_EQ(place.json("r.json")["ticks"], place.json("anew.json")["ticks"]) << "from the beginning";
  }
}

TEST(Run, SettlesAndSaysSo) {
  const Workplace place;
  place.write("s.json", moving_scene());
  const Outcome outcome = place.run({"run", "s.json", "--json", "r.json"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  const nlohmann::json result = place.json("r.json");
  EXPECT_TRUE(result["settled"]);
  const std::string line = outcome.last_line();
  EXPECT_TRUE(line.starts_with("settled after " + std::to_string(result["ticks"].get<int>()) + " ticks, worst error ")) << line;
  EXPECT_TRUE(line.ends_with(" %, hash " + result["hash"].get<std::string>())) << line;
  EXPECT_EQ(outcome.out.find('\033'), std::string::npos);
  for (const char* key : {"ticks", "settled", "hash", "volumes", "totals", "tensions", "problems"})
    EXPECT_TRUE(result.contains(key)) << key;
  ASSERT_EQ(result["volumes"].size(), 3u);
  for (const char* key :
       {"id", "name", "position", "weight", "demand", "volume", "cell_volume", "floor_area", "surface_area", "state", "reason"})
    EXPECT_TRUE(result["volumes"][0].contains(key)) << key;
  EXPECT_EQ(result["volumes"][0]["id"], "east");
  for (const auto& volume : result["volumes"])
    EXPECT_NEAR(volume["volume"].get<double>() / volume["demand"].get<double>(), 1, 0.01);
}

TEST(Run, TicksEndWithCodeZeroHoweverFar) {
  const Workplace place;
  place.write("s.json", moving_scene());
  const Outcome outcome = place.run({"run", "s.json", "--ticks", "1"});
  EXPECT_EQ(outcome.code, 0);
  EXPECT_TRUE(outcome.last_line().starts_with("not settled: ")) << outcome.last_line();
}

TEST(Run, ThreadsGiveTheSameHash) {
  const Workplace place;
  place.write("s.json", moving_scene());
  EXPECT_EQ(place.run({"run", "s.json", "--ticks", "40", "--threads", "1"}).last_line(),
            place.run({"run", "s.json", "--ticks", "40", "--threads", "3"}).last_line());
}

TEST(Run, SavedAndContinuedIsTheSameAsRunThrough) {
  const Workplace place;
  place.write("s.json", moving_scene());
  place.run({"run", "s.json", "--ticks", "25", "--json", "whole.json"});
  EXPECT_EQ(place.run({"run", "s.json", "--ticks", "10", "--save", "half.json"}).code, 0);
  const Outcome rest = place.run({"run", "half.json", "--ticks", "15", "--json", "rest.json"});
  EXPECT_EQ(rest.code, 0) << rest.err;
  EXPECT_EQ(place.json("rest.json")["hash"], place.json("whole.json")["hash"]);
  EXPECT_EQ(place.json("rest.json")["ticks"], 25);
}

TEST(Run, LogIsReplayed) {
  const Workplace place;
  place.write("s.json", moving_scene());
  const Outcome run = place.run({"run", "s.json", "--ticks", "130", "--log", "run.log", "--set",
                                 "east/smart_volume.demand=1500 m3", "--set", "site/node.position=[1, 2, 3]"});
  ASSERT_EQ(run.code, 0) << run.err;
  const Outcome replay = place.run({"replay", "run.log", "--threads", "2"});
  EXPECT_EQ(replay.code, 0) << replay.err;
  EXPECT_EQ(replay.last_line(), "agrees with all 3 checks");
  EXPECT_NE(replay.out.find("2 entries, 130 ticks, hash "), std::string::npos) << replay.out;
  std::string log = place.text("run.log");
  const std::size_t at = log.find("\"hash\": \"");
  ASSERT_NE(at, std::string::npos) << log;
  log[at + 9] = log[at + 9] == '0' ? '1' : '0';
  place.write("bad.log", log);
  const Outcome bad = place.run({"replay", "bad.log"});
  EXPECT_EQ(bad.code, 3);
  EXPECT_TRUE(bad.last_line().starts_with("differs from the log first at tick 60")) << bad.out;
  // A hash of another scheme says nothing, whatever it is: neither that the log agrees, nor that it differs.
  const std::size_t scheme = log.find("\"hashes\":");
  ASSERT_NE(scheme, std::string::npos) << log.substr(0, 200);
  place.write("old.log", log.substr(0, scheme) + log.substr(log.find('"', scheme + 9)));
  const Outcome old = place.run({"replay", "old.log"});
  EXPECT_EQ(old.code, 0) << old.err;
  EXPECT_TRUE(old.last_line().starts_with("the hashes of the log are of scheme 1 and cannot be compared")) << old.out;
  place.write("cut.log", place.text("run.log").substr(0, place.text("run.log").size() - 20));
  const Outcome cut = place.run({"replay", "cut.log"});
  EXPECT_EQ(cut.code, 0) << cut.err;
  EXPECT_NE(cut.err.find("the last line is incomplete"), std::string::npos) << cut.err;
  // Cut between two lines, so that every line that is left is whole: what is missing is told, and the rest can be used.
  const std::string whole = place.text("run.log");
  place.write("short.log", whole.substr(0, whole.find("{\"end\"")));
  const Outcome shortened = place.run({"replay", "short.log"});
  EXPECT_EQ(shortened.code, 0) << shortened.err;
  EXPECT_NE(shortened.err.find("the log has no end: it was cut off, or its program was stopped. What was done after tick 120"),
            std::string::npos)
      << shortened.err;
  EXPECT_EQ(shortened.last_line(), "agrees with all 2 checks");
  EXPECT_EQ(replay.err, "");
  place.write("two.log", whole + whole.substr(whole.find("{\"end\"")));
  const Outcome two = place.run({"replay", "two.log"});
  EXPECT_EQ(two.code, 2);
  EXPECT_NE(two.err.find("line 7: is a second end of the log"), std::string::npos) << two.err;
}

TEST(Run, WhatCannotBeSetLeavesTheLogOfAnEarlierRun) {
  const Workplace place;
  place.write("s.json", moving_scene());
  place.write("old.log", "an earlier run\n");
  EXPECT_EQ(place.run({"run", "s.json", "--log", "old.log", "--set", "site/boundry.height=3"}).code, 2);
  EXPECT_EQ(place.text("old.log"), "an earlier run\n");
}

TEST(Run, SetTakesQuantitiesAndSaysWhatItCannotTake) {
  const Workplace place;
  place.write("s.json", moving_scene());
  const auto set = [&](const std::string& argument) {
    return place.run({"run", "s.json", "--ticks", "3", "--json", "r.json", "--set", argument});
  };
  EXPECT_EQ(set("east/smart_volume.storey_height=400 cm").code, 0);
  EXPECT_EQ(place.json("r.json")["volumes"][0]["storey_height"], 4);
  EXPECT_EQ(set("east/smart_volume.use=Town hall").code, 0);
  EXPECT_EQ(place.json("r.json")["volumes"][0]["use"], "Town hall");
  for (const auto& [argument, said] : {std::pair<const char*, const char*>{"east/smart_volume.demand=12 m2", "m³"},
                                       {"east/smart_volume.demnd=5", "did you mean `demand`?"},
                                       {"easd/smart_volume.demand=5", "did you mean `east`?"},
                                       {"east.demand=5", "NODE/TYPIFICATION.PORT=VALUE"},
                                       {"east/smart_volume.demand=-5", "between 0 and"},
                                       {"solver/smart_volumes_solver.steps=1e300", "1e+300"},
                                       {"east/smart_volume.volume=5", "computed"}}) {
    const Outcome outcome = set(argument);
    EXPECT_EQ(outcome.code, 2) << argument;
    EXPECT_NE(outcome.err.find(said), std::string::npos) << argument << ": " << outcome.err;
  }
}

TEST(Run, DemandsThatDoNotFitAreNamedEarly) {
  const Workplace place;
  place.write("s.json",
              scene_text(volume_text("small", "[8, 0, 8]", "4000") + "," + volume_text("greedy", "[-8, 0, 8]", "60000")));
  const Outcome outcome = place.run({"run", "s.json", "--json", "r.json"});
  EXPECT_EQ(outcome.code, 3);
  EXPECT_TRUE(outcome.last_line().starts_with("not settled: the demands cannot be met: ")) << outcome.last_line();
  EXPECT_NE(outcome.last_line().find("`greedy`"), std::string::npos) << outcome.last_line();
  EXPECT_LT(place.json("r.json")["ticks"].get<int>(), 1000) << "nobody waits for what cannot come";
}

// One volume is insisted on and breaks the rule by itself. The other is not wound to nothing for it, and nobody calls it settled.
TEST(Run, ARuleThatCannotBeMetIsSaidAndEndsWithCodeThree) {
  const Workplace place;
  const std::string plot =
      R"({"id": "plot", "types": {"plot": {"polygon": [[-20, -20, 0], [20, -20, 0], [20, 20, 0], [-20, 20, 0]], "fsi_max": 0.3}}})";
  const std::string insisted =
      R"({"id": "fixed", "position": [-8, 0, 8], "types": {"smart_volume": {"use": "hotel", "demand": 4000,
      "demand_min": 4000}}})";
  place.write("s.json",
              scene_text(volume_text("free", "[8, 0, 8]", "2000") + "," + insisted + "," + plot,
                         R"({"id": "rules", "kind": "plot_rules", "from": "plot", "to": {"typification": "smart_volume"}})"));
  const Outcome outcome = place.run({"run", "s.json", "--settle", "--json", "r.json"});
  EXPECT_EQ(outcome.code, 3) << outcome.err;
  EXPECT_TRUE(outcome.last_line().starts_with("not settled: links/rules/from: cannot be met: FSI ")) << outcome.last_line();
  EXPECT_NE(outcome.last_line().find("of 0.30, held by `fixed` (4000 m³ are insisted on)"), std::string::npos)
      << outcome.last_line();
  const nlohmann::json result = place.json("r.json");
  EXPECT_FALSE(result["settled"]);
  EXPECT_LT(result["ticks"].get<int>(), 400) << "nobody waits for what cannot come";
  EXPECT_NE(result["problems"].dump().find("cannot be met: FSI"), std::string::npos);
  ASSERT_EQ(result["volumes"].size(), 2u);
  EXPECT_EQ(result["volumes"][1]["id"], "free");
  EXPECT_NEAR(result["volumes"][1]["volume"].get<double>(), 400, 8) << "a fifth of its demand";
}

// A brief of which one use has no volume: the rest is negotiated to its end, and who is missing is named.
TEST(Run, AUseWithoutAVolumeIsNamedAndTheRestSettles) {
  const Workplace place;
  const std::string brief = R"({"id": "brief", "types": {"programme": {"rows": [{"use": "housing", "floor_area": 600,
      "storey_height": 3}, {"use": "hotel", "floor_area": 900}]}}})";
  place.write("s.json",
              scene_text(volume_text("house", "[8, 0, 8]", "1000") + "," + brief,
                         R"({"id": "deal", "kind": "demand", "from": "brief", "to": {"typification": "smart_volume"}})"));
  const Outcome outcome = place.run({"run", "s.json", "--settle", "--json", "r.json"});
  EXPECT_EQ(outcome.code, 0) << outcome.last_line();
  EXPECT_TRUE(outcome.last_line().starts_with("settled after ")) << outcome.last_line();
  EXPECT_EQ(outcome.last_line().find("does not run"), std::string::npos) << outcome.last_line();
  const nlohmann::json result = place.json("r.json");
  EXPECT_NE(result["problems"].dump().find("no volume has the use `hotel`, so all of the 900 m"), std::string::npos)
      << result["problems"].dump();
}

// JSON, table and page say of one volume the same: what was asked for, by hand or brief, what limits leave, what is short.
TEST(Run, WhatIsShortIsToldAlike) {
  const Workplace place;
  place.write(
      "s.json",
      scene_text(
          volume_text("free", "[8, 0, 8]", "2000") +
          R"(, {"id": "cut", "position": [-8, 0, 8], "types": {"smart_volume": {"demand": 2000, "demand_limit": 1500}}})"));
  const Outcome outcome = place.run({"run", "s.json", "--json", "r.json", "--report", "out"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  const nlohmann::json result = place.json("r.json");
  ASSERT_EQ(result["volumes"][0]["id"], "cut");
  const nlohmann::json& cut = result["volumes"][0];
  EXPECT_EQ(cut["asked"], 2000);
  EXPECT_EQ(cut["demand"], 1500);
  EXPECT_NEAR(cut["short_share"].get<double>(), 0.25, 0.01);
  EXPECT_NEAR(cut["short"].get<double>(), 2000 - cut["volume"].get<double>(), 1e-9);
  EXPECT_NE(cut["why_short"].get<std::string>().find("a limit set by hand leaves 1500"), std::string::npos) << cut["why_short"];
  EXPECT_EQ(result["volumes"][1]["why_short"], "");
  EXPECT_EQ(result["worst_short"], "volume cut");
  EXPECT_NE(outcome.out.find("short %"), std::string::npos);
  EXPECT_NE(place.text("out/volumes.csv").find("a limit set by hand leaves"), std::string::npos);
  EXPECT_NE(place.text("out/report.html").find("a limit set by hand leaves"), std::string::npos);
  // A report of a settled scene says settled.
  ASSERT_TRUE(result["settled"]);
  EXPECT_NE(place.text("out/report.html").find("\xE2\x9C\x93 Settled"), std::string::npos);
}

TEST(Run, ReportIsWritten) {
  const Workplace place;
  place.write("s.json", moving_scene());
  EXPECT_EQ(place.run({"run", "s.json", "--report", "out"}).code, 0);
  for (const char* file : {"out/report.html", "out/volumes.csv", "out/volumes.obj"})
    EXPECT_GT(place.text(file).size(), 100u) << file;
}

TEST(Run, InterruptWritesWhatIsThere) {
  const Workplace place;
  place.write("s.json", moving_scene());
  const Outcome outcome = place.shell(
      "timeout --preserve-status -s INT 2 \"$BEHAVIOURLINKS\" run s.json --ticks 1000000000 --log run.log --json r.json --report "
      "out");
  EXPECT_EQ(outcome.code, 130) << outcome.err;
  EXPECT_NE(place.text("run.log").find("\"end\""), std::string::npos);
  EXPECT_GT(place.json("r.json")["ticks"].get<int>(), 0);
  EXPECT_TRUE(std::filesystem::exists(place.path("out/report.html")));
}

TEST(Run, FullDiskLeavesTheOldFileWhole) {
  const Workplace place;
  place.write("s.json", moving_scene());
  const std::string old = scene_text("");
  place.write("saved.json", old);
  // A limit on the size of files stands for the full disk; its signal is ignored, so that writing fails with an error.
  const Outcome outcome = place.shell("trap '' XFSZ; ulimit -f 1; \"$BEHAVIOURLINKS\" run s.json --ticks 2 --save saved.json");
  EXPECT_EQ(outcome.code, 2);
  EXPECT_NE(outcome.err.find("the old file is unchanged"), std::string::npos) << outcome.err;
  EXPECT_EQ(place.text("saved.json"), old);
  const Outcome device = place.run({"run", "s.json", "--ticks", "2", "--json", "/dev/full"});
  EXPECT_EQ(device.code, 2);
  EXPECT_NE(device.err.find("No space left"), std::string::npos) << device.err;
}

}  // namespace

}  // namespace bl::test
