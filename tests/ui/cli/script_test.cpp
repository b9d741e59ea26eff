// `script`, `run --script` and `check` of Lua files, as a person types them.
#include <gtest/gtest.h>

#include "tests/support/place/source_folder.h"
#include "tests/ui/cli/program.h"

namespace bl::test {

namespace {

const std::string kScene =
    R"({"format": "behaviourlinks", "version": 1, "nodes": [{"id": "foot"}, {"id": "hut", "position": [8, 0, 0]}],
 "links": [{"id": "l", "kind": "lean_uphill", "from": "foot", "to": "hut"}]})";

std::string shipped(const std::string& name) { return test::source_folder() + "/links/scripts/" + name; }

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

// What fails whatever it reads never works, and a check says so; what refuses some values and takes others is sound.
TEST(Script, CheckTriesEvaluate) {
  const Workplace place;
  const std::string head =
      "return {id = 'mine', doc = 'A try.', reads = {volume = {at = 'from', port = 'smart_volume.volume', unit = 'm3'}},\n"
      "  proposes = {demand = {at = 'to', port = 'smart_volume.demand', unit = 'm3'}},\n  evaluate = function(params, ends)\n";
  place.write("mine.lua", head + "    return {demand = nothing.here}\n  end}\n");
  const Outcome fails = place.run({"check", "mine.lua"});
  EXPECT_EQ(fails.code, 2) << fails.out;
  EXPECT_NE(fails.err.find("mine.lua:4"), std::string::npos) << fails.err;
  place.write("scene.json", R"({"format": "behaviourlinks", "version": 1, "nodes": [], "links": []})");
  EXPECT_EQ(place.run({"script", "scene.json", "mine.lua", "--out", "out.json"}).code, 0);
  const Outcome unused = place.run({"check", "out.json"});
  EXPECT_EQ(unused.code, 2) << "no link uses it, and still it is wrong: " << unused.out;
  EXPECT_NE(unused.err.find("scripts/mine"), std::string::npos) << unused.err;
  place.write(
      "mine.lua",
      head + "    if ends.volume == 0 then error('nothing to read') end\n    return {demand = 1 / ends.volume}\n  end}\n");
  const Outcome sound = place.run({"check", "mine.lua"});
  EXPECT_EQ(sound.code, 0) << sound.err;
  for (const auto& file : std::filesystem::directory_iterator(test::source_folder() + "/links/scripts"))
    if (file.path().extension() == ".lua") {
      const Outcome shipped_one = place.run({"check", file.path().string()});
      EXPECT_EQ(shipped_one.code, 0) << shipped_one.err;
    }
}

// A trial with values that no scene could have says nothing of a script: sound ones pass, and doubts are no errors.
TEST(Script, CheckTriesWhatAPortCanHold) {
  const Workplace place;
  const auto check = [&](const std::string& reads, const std::string& body) {
    place.write("mine.lua",
                "return {id = 'mine', doc = 'A try.',\n"
                "  params = {{id = 'word', default = '', doc = 'A word that people have to give.'}},\n  reads = {" +
                    reads +
                    "},\n  proposes = {demand = {at = 'to', port = 'smart_volume.demand', unit = 'm3'}},\n"
                    "  evaluate = function(params, ends)\n    " +
                    body + "\n    return {demand = 100}\n  end}\n");
    return place.run({"check", "mine.lua"});
  };
  const std::string open = "open = {at = 'from', port = 'street.open', unit = 'ratio'}",
                    place_read = "p = {at = 'from', port = 'node.position', unit = 'm'}";
  for (const auto& [reads, body] :
       {std::pair<std::string, std::string>{open, "if not (ends.open > 0 and ends.open <= 1) then error('no share') end"},
        {open, "if not (ends.open > 0 and ends.open < 1) then error('no share between') end"},
        {place_read, "if params.word == '' then error('say the word first') end"}}) {
    const Outcome sound = check(reads, body);
    EXPECT_EQ(sound.code, 0) << body << sound.err;
    EXPECT_EQ(sound.err, "") << body;
  }
  // Nobody knows the only word that it takes: a doubt. A name that does not exist: an error.
  const Outcome doubt = check(place_read, "if params.word ~= 'sesame' then error('another word') end");
  EXPECT_EQ(doubt.code, 0) << doubt.err;
  EXPECT_NE(doubt.err.find("warning: "), std::string::npos) << doubt.err;
  EXPECT_NE(doubt.err.find("another word"), std::string::npos) << doubt.err;
  EXPECT_EQ(check(place_read, "nothing.here = 1").code, 2);
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

// A scene that somebody sent must not command the terminal by what its script says.
TEST(Script, WhatItSaysIsTextOnTheTerminal) {
  const Workplace place;
  place.write("scene.json", kScene);
  place.write("lean_uphill.lua",
              "return {id = 'lean_uphill', doc = 'x', proposes = {move = {at = 'to', port = 'node.position'}},\n"
              "evaluate = function() error('\\27[31mRED\\7\\u{9b}2J\\u{202e}') end}");
  const Outcome done = place.run({"run", "scene.json", "--script", "lean_uphill.lua", "--ticks", "2"});
  for (const std::string& text : {done.out, done.err}) {
    EXPECT_EQ(text.find('\x1b'), std::string::npos) << text;
    EXPECT_EQ(text.find('\x07'), std::string::npos) << text;
    EXPECT_EQ(text.find("\xc2\x9b"), std::string::npos) << text;
    EXPECT_EQ(text.find("\xe2\x80\xae"), std::string::npos) << text;
  }
  EXPECT_NE(done.out.find("\\x1b[31mRED\\x07\\u009b2J\\u202e"), std::string::npos) << done.out;
  place.write("name.json",
              "{\"format\": \"behaviourlinks\", \"version\": 1, \"nodes\": [{\"id\": \"a\", \"name\": \"\\u001b]0;x\\u0007\","
              " \"types\": {\"smart_volume\": {}}}], \"links\": []}");
  const Outcome named = place.run({"run", "name.json", "--ticks", "1"});
  EXPECT_EQ(named.out.find('\x1b'), std::string::npos) << named.out;
  EXPECT_NE(named.out.find("\\x1b]0;x\\x07"), std::string::npos) << named.out;
}

TEST(Script, ALinkThatDoesNotFitIsAnError) {
  const Workplace place;
  std::string scene = kScene;
  scene.replace(scene.find("\"to\": \"hut\""), 11, "\"to\": \"hat\"");
  place.write("scene.json", scene);
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{"run", "scene.json", "--script", shipped("lean_uphill.lua")},
        {"script", "scene.json", shipped("lean_uphill.lua"), "--out", "out.json"}}) {
    const Outcome done = place.run(words);
    EXPECT_EQ(done.code, 2) << done.out;
    EXPECT_NE(done.err.find("links/l/to: there is no node `hat`, did you mean `hut`?"), std::string::npos) << done.err;
  }
  EXPECT_FALSE(std::filesystem::exists(place.path("out.json")));
}

TEST(Script, TheSameIdInAnotherFileIsExplained) {
  const Workplace place;
  place.write("scene.json", kScene);
  place.write("copy.lua", read_text(shipped("lean_uphill.lua")));
  ASSERT_EQ(place.run({"script", "scene.json", shipped("lean_uphill.lua"), "--out", "a.json"}).code, 0);
  const Outcome done = place.run({"run", "a.json", "--script", "copy.lua"});
  EXPECT_EQ(done.code, 2);
  EXPECT_NE(done.err.find("copy.lua: scripts/copy: the scene's script `lean_uphill` has this id already; name your file "
                          "lean_uphill.lua to replace it"),
            std::string::npos)
      << done.err;
}

TEST(Script, OtherFilesAreReplacedByForceAlone) {
  const Workplace place;
  place.write("scene.json", kScene);
  place.write("precious.json", "hello");
  const std::vector<std::string> words{"script", "scene.json", shipped("lean_uphill.lua"), "--out", "precious.json"};
  const Outcome refused = place.run(words);
  EXPECT_EQ(refused.code, 2);
  EXPECT_NE(refused.err.find("exists already"), std::string::npos) << refused.err;
  EXPECT_EQ(place.text("precious.json"), "hello");
  std::vector<std::string> forced = words;
  forced.emplace_back("--force");
  EXPECT_EQ(place.run(forced).code, 0);
  EXPECT_EQ(place.run({"script", "scene.json", shipped("lean_uphill.lua"), "--out", "scene.json"}).code, 0) << "the scene itself";
}

TEST(Script, LinksThatRestAreToldInTheLastLine) {
  const Workplace place;
  std::string scene = kScene;
  scene.replace(scene.find("lean_uphill"), 11, "ratioo");
  place.write("scene.json", scene);
  const Outcome done = place.run({"run", "scene.json"});
  EXPECT_NE(done.err.find("unknown link kind `ratioo`: kept as it is, not run, did you mean `ratio`?"), std::string::npos)
      << done.err;
  EXPECT_NE(done.last_line().find("(1 link does not run)"), std::string::npos) << done.out;
}

TEST(Script, ParametersOfLinksAreSetFromTheCommandLine) {
  const Workplace place;
  place.write("scene.json", moving_scene());
  const Outcome done = place.run({"run", "scene.json", "--set", "apart/minimum=17 m", "--save", "end.json", "--ticks", "2"});
  EXPECT_EQ(done.code, 0) << done.err;
  EXPECT_NE(place.text("end.json").find("\"minimum\": 17"), std::string::npos);
  const Outcome wrong = place.run({"run", "scene.json", "--set", "apart/minimun=17"});
  EXPECT_EQ(wrong.code, 2);
  EXPECT_NE(wrong.err.find("did you mean `minimum`?"), std::string::npos) << wrong.err;
}

}  // namespace

}  // namespace bl::test
