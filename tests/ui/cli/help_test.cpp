// The program explains itself, and says what it does not understand.
#include <gtest/gtest.h>

#include "tests/support/place/source_folder.h"
#include "tests/ui/cli/program.h"

namespace bl::test {

namespace {

const std::vector<std::string> kCommands = {"run",     "open",    "new",   "check",  "docs",   "schema",  "replay",
                                            "erase",   "minutes", "cells", "fit",    "assign", "import",  "script",
                                            "compare", "place",   "add",   "export", "serve",  "rehearse"};

TEST(Help, AloneIsAnOverview) {
  const Workplace place;
  for (const auto& arguments : {std::vector<std::string>{}, {"--help"}}) {
    const Outcome outcome = place.run(arguments);
    EXPECT_EQ(outcome.code, 0);
    for (const std::string& command : kCommands) EXPECT_NE(outcome.out.find("  " + command), std::string::npos) << command;
    EXPECT_EQ(outcome.err, "");
  }
}

TEST(Help, EachCommandHasAnExample) {
  const Workplace place;
  for (const std::string& command : kCommands) {
    const Outcome outcome = place.run({command, "--help"});
    EXPECT_EQ(outcome.code, 0) << command;
    EXPECT_NE(outcome.out.find("Example:\n  behaviourlinks"), std::string::npos) << command;
    EXPECT_EQ(outcome.out.find('\033'), std::string::npos) << "colours where there is no terminal";
  }
}

TEST(Help, VersionIsOneLine) {
  const Outcome outcome = Workplace().run({"--version"});
  EXPECT_EQ(outcome.code, 0);
  EXPECT_TRUE(outcome.out.starts_with("behaviourlinks 0.")) << outcome.out;
}

TEST(Help, UnknownWordsAreBadInput) {
  const Workplace place;
  const Outcome command = place.run({"rnu"});
  EXPECT_EQ(command.code, 2);
  EXPECT_NE(command.err.find("did you mean `run`?"), std::string::npos) << command.err;
  const Outcome option = place.run({"run", "a.json", "--tikcs", "5"});
  EXPECT_EQ(option.code, 2);
  EXPECT_NE(option.err.find("--tikcs"), std::string::npos) << option.err;
  EXPECT_EQ(place.run({"run"}).code, 2);
  EXPECT_EQ(place.run({"run", "a.json", "--threads", "0"}).code, 2);
  EXPECT_EQ(place.run({"run", "a.json", "--ticks", "5", "--settle"}).code, 2);
}

TEST(Docs, ListsAndExplainsTypes) {
  const Workplace place;
  const Outcome list = place.run({"docs", "--list"});
  EXPECT_EQ(list.code, 0);
  EXPECT_NE(list.out.find("keep_distance"), std::string::npos);
  const Outcome page = place.run({"docs", "smart_volume"});
  EXPECT_EQ(page.code, 0);
  EXPECT_NE(page.out.find("storey_height"), std::string::npos);
  const Outcome typo = place.run({"docs", "smart_volum"});
  EXPECT_EQ(typo.code, 2);
  EXPECT_NE(typo.err.find("did you mean `smart_volume`?; `behaviourlinks docs --list`"), std::string::npos) << typo.err;
  EXPECT_NE(place.run({"docs", "zzz"}).err.find("no type `zzz`; `behaviourlinks docs --list`"), std::string::npos);
  EXPECT_EQ(place.run({"docs", "--out", "pages"}).code, 0);
  EXPECT_TRUE(std::filesystem::exists(place.path("pages/nodes/smart_volume.md")));
  EXPECT_TRUE(std::filesystem::exists(place.path("pages/links/demand.md")));
}

// A script is not one of the program's types: its page is had from the scene that holds it, or from its own file.
TEST(Docs, ExplainsWhatScriptsDeclare) {
  const Workplace place;
  const std::string lua = (std::filesystem::path(test::source_folder()) / "links/scripts/fair_share.lua").string();
  const Outcome without = place.run({"docs", "fair_share"});
  EXPECT_EQ(without.code, 2);
  EXPECT_NE(without.err.find("--from SCENE"), std::string::npos) << without.err;
  const Outcome page = place.run({"docs", lua});
  EXPECT_EQ(page.code, 0) << page.err;
  EXPECT_NE(page.out.find("fair_share"), std::string::npos) << page.out;
  EXPECT_EQ(place.run({"docs", "fair_share", "--from", lua}).out, page.out);
  EXPECT_NE(place.run({"docs", "--list", "--from", lua}).out.find("fair_share"), std::string::npos);
  place.write("scene.json", R"({"format": "behaviourlinks", "version": 1, "nodes": [{"id": "a"}]})");
  EXPECT_EQ(place.run({"docs", "scene.json"}).code, 2);
  ASSERT_EQ(place.run({"script", "scene.json", lua, "--out", "scene.json"}).code, 0);
  EXPECT_EQ(place.run({"docs", "scene.json"}).out, page.out);
  EXPECT_EQ(place.run({"docs", "fair_share", "--from", "scene.json"}).out, page.out);
  place.write("broken.lua", "return {");
  const Outcome broken = place.run({"docs", "broken.lua"});
  EXPECT_EQ(broken.code, 2);
  EXPECT_NE(broken.err.find("broken.lua"), std::string::npos) << broken.err;
  EXPECT_EQ(place.run({"docs", "none.json"}).code, 2);
}

TEST(Schema, IsJson) {
  const Workplace place;
  const Outcome outcome = place.run({"schema"});
  EXPECT_EQ(outcome.code, 0);
  EXPECT_TRUE(nlohmann::json::parse(outcome.out).contains("$schema"));
  EXPECT_EQ(place.run({"schema", "--out", "s.json"}).code, 0);
  EXPECT_EQ(place.text("s.json"), outcome.out);
}

}  // namespace

}  // namespace bl::test
