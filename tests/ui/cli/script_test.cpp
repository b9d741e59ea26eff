// `script`, `run --script` and `check` of Lua files, as a person types them.
#include <gtest/gtest.h>

#include "tests/ui/cli/program.h"

namespace bl::test {

namespace {

const std::string kScene =
    R"({"format": "behaviourlinks", "version": 1, "nodes": [{"id": "foot"}, {"id": "hut", "position": [8, 0, 0]}],
 "links": [{"id": "l", "kind": "lean_uphill", "from": "foot", "to": "hut"}]})";

std::string shipped(const std::string& name) { return std::string(BL_SOURCE_DIR) + "/links/scripts/" + name; }

TEST(Script, GoesIntoASceneRunsAndComesOutAgain) {
  const Workplace place;
  place.write("scene.json", kScene);
  Outcome done = place.run({"script", "scene.json", shipped("lean_uphill.lua"), "--out", "out.json"});
  EXPECT_EQ(done.code, 0) << done.err;
  EXPECT_NE(done.out.find("lean_uphill.lua: link kind `lean_uphill`"), std::string::npos) << done.out;
  EXPECT_EQ(done.err, "") << "the link runs now";
  done = place.run({"run", "out.json", "--save", "end.json"});
  EXPECT_EQ(done.code, 0) << done.err;
  EXPECT_NE(place.text("end.json").find("\"hut\": {\"node.position\": [8, 0, 1.9"), std::string::npos) << place.text("end.json");
  done = place.run({"script", "out.json", "--extract", "scripts"});
  EXPECT_EQ(done.code, 0) << done.err;
  EXPECT_EQ(place.text("scripts/lean_uphill.lua"), read_text(shipped("lean_uphill.lua")));
  done = place.run({"script", "out.json", "--remove", "lean_uphill", "--out", "without.json"});
  EXPECT_EQ(done.code, 0) << done.err;
  EXPECT_EQ(place.text("without.json").find("scripts"), std::string::npos);
  EXPECT_NE(place.text("without.json").find("\"kind\": \"lean_uphill\""), std::string::npos);
  done = place.run({"script", "scene.json", shipped("lean_uphill.lua")});
  EXPECT_EQ(done.code, 2);
  EXPECT_NE(done.err.find("--out"), std::string::npos);
}

TEST(Script, IsTriedForOneRunAndReplayed) {
  const Workplace place;
  place.write("scene.json", kScene);
  Outcome done = place.run({"run", "scene.json", "--script", shipped("lean_uphill.lua"), "--ticks", "5", "--log", "run.log"});
  EXPECT_EQ(done.code, 0) << done.err;
  done = place.run({"replay", "run.log", "--threads", "2"});
  EXPECT_EQ(done.code, 0) << done.err << done.out;
}

TEST(Script, MistakesHaveFileAndLine) {
  const Workplace place;
  place.write("scene.json", kScene);
  place.write("My Link.lua", "return {\n  id = 3\n  doc = 'x'}");
  for (const std::vector<std::string>& words : {std::vector<std::string>{"run", "scene.json", "--script", "My Link.lua"},
                                                {"script", "scene.json", "My Link.lua", "--out", "scene.json"},
                                                {"check", "My Link.lua"}}) {
    const Outcome done = place.run(words);
    EXPECT_EQ(done.code, 2) << words[0];
    EXPECT_NE(done.err.find("my_link.lua:3: '}' expected"), std::string::npos) << done.err;
  }
  EXPECT_EQ(place.text("scene.json"), kScene);
  const Outcome done = place.run({"check", shipped("lean_uphill.lua"), shipped("fair_share.lua")});
  EXPECT_EQ(done.code, 0) << done.err;
  EXPECT_NE(done.out.find("ok: a link script"), std::string::npos) << done.out;
}

}  // namespace

}  // namespace bl::test
