// `minutes`: the same bytes each time, a page that tools can read, and nothing of people who were erased.
#include <gtest/gtest.h>

#include "tests/core/minutes/told_session.h"
#include "tests/ui/cli/program.h"

namespace bl::test {
namespace {

TEST(MinutesCommand, WritesTheSameBytesEachTime) {
  const Workplace place;
  minutes::ToldSession().store(place.path("s.blsession"));
  const std::string before = place.text("s.blsession");
  const Outcome first = place.run({"minutes", "s.blsession", "--out", "a"});
  EXPECT_EQ(first.code, 0) << first.err;
  EXPECT_EQ(first.err, "");
  EXPECT_EQ(first.last_line(), "7 files written into a");
  EXPECT_EQ(place.run({"minutes", "s.blsession", "--out", "b"}).code, 0);
  EXPECT_EQ(place.run({"minutes", "s.blsession", "--out", "b"}).code, 0) << "its own folder again";
  const Outcome difference = place.shell("diff -r a b");
  EXPECT_EQ(difference.code, 0) << difference.out;
  EXPECT_EQ(place.text("s.blsession"), before);
  const Outcome page = place.shell("xmllint --noout a/minutes.html");
  EXPECT_EQ(page.code, 0) << page.err;
  EXPECT_EQ(place.run({"check", "a/scenes/end.json", "a/scenes/_end.json"}).code, 0);
  const Outcome replay = place.run({"replay", "a/log.jsonl"});
  EXPECT_EQ(replay.code, 0) << replay.err;
}

TEST(MinutesCommand, AnErasedPersonIsNowhere) {
  const Workplace place;
  minutes::ToldSession().store(place.path("s.blsession"));
  ASSERT_EQ(place.run({"minutes", "s.blsession", "--out", "a"}).code, 0);
  for (const char* gone : {minutes::kErasedName, minutes::kErasedWords, "bea.q"})
    EXPECT_EQ(place.shell(std::string("grep -r '") + gone + "' a").code, 1) << gone;
  EXPECT_NE(place.text("a/minutes.html").find("hollow"), std::string::npos);
  // By the command as well: who is erased after the minutes were written is not in the next ones.
  ASSERT_EQ(place.run({"erase", "s.blsession", "--seat", "3"}).code, 0);
  ASSERT_EQ(place.run({"minutes", "s.blsession", "--out", "a"}).code, 0);
  EXPECT_EQ(place.shell("grep -r hollow a").code, 1);
  EXPECT_NE(place.text("a/comments.csv").find("[erased]"), std::string::npos);
}

TEST(MinutesCommand, WhatCannotBeReadIsSaid) {
  const Workplace place;
  minutes::ToldSession().store(place.path("s.blsession"));
  place.write("scene.json", moving_scene());
  EXPECT_EQ(place.run({"minutes", "scene.json", "--out", "a"}).err,
            "scene.json: this is not a session file: it does not begin like one\n");
  EXPECT_EQ(place.run({"minutes", "none.blsession", "--out", "a"}).code, 2);
  EXPECT_EQ(place.run({"minutes", "s.blsession"}).code, 2);
  std::string bytes = place.text("s.blsession");
  const std::size_t at = bytes.find("1772400000000");  // when a phase ends
  ASSERT_NE(at, std::string::npos);
  place.write("damaged.blsession", bytes.replace(at, 4, "1882"));
  const Outcome damaged = place.run({"minutes", "damaged.blsession", "--out", "a"});
  EXPECT_EQ(damaged.code, 2);
  EXPECT_NE(damaged.err.find("it is not what was stored"), std::string::npos) << damaged.err;
  const auto holder = std::move(*journal::Journal::open(place.path("s.blsession"), full_registry(), {}));
  const Outcome busy = place.run({"minutes", "s.blsession", "--out", "a"});
  EXPECT_EQ(busy.code, 2);
  EXPECT_NE(busy.err.find("another program has this file open"), std::string::npos) << busy.err;
  EXPECT_FALSE(std::filesystem::exists(place.path("a"))) << "nothing is made for nothing";
}

TEST(MinutesCommand, AFolderOfOthersIsNotFilled) {
  const Workplace place;
  minutes::ToldSession session;
  session.store(place.path("s.blsession"));
  std::filesystem::create_directories(place.path("mine/scenes"));
  place.write("mine/scenes/other.json", moving_scene());
  const Outcome scenes = place.run({"minutes", "s.blsession", "--out", "mine"});
  EXPECT_EQ(scenes.code, 2);
  EXPECT_NE(scenes.err.find("mine/scenes: is there already and is not of earlier minutes"), std::string::npos) << scenes.err;
  place.write("mine/votes.csv", "my,own,table\n");
  const Outcome table = place.run({"minutes", "s.blsession", "--out", "mine"});
  EXPECT_EQ(table.code, 2);
  EXPECT_NE(table.err.find("--out: mine/votes.csv: is there already"), std::string::npos) << table.err;
  EXPECT_EQ(place.text("mine/votes.csv"), "my,own,table\n");
  EXPECT_FALSE(std::filesystem::exists(place.path("mine/minutes.html")));
}

}  // namespace
}  // namespace bl::test
