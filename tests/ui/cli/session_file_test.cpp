// `replay` and `erase` of session files: hashes are compared as in logs, and a person is taken out for good.
#include <gtest/gtest.h>

#include "core/journal/journal.h"
#include "core/session/session.h"
#include "tests/ui/cli/program.h"

namespace bl::test {
namespace {

using journal::Journal;

// A short session of two people, stored. `is_closed`: with a hash at its end.
void store_session(const std::string& path, bool is_closed = true) {
  const auto reading = read_scene(moving_scene(), full_registry());
  auto session = std::move(*Session::start(full_registry(), reading.scene, nullptr, 1));
  auto file =
      std::move(*Journal::create(path, {.code = "BRKT", .title = "Quarter", .scene = moving_scene()}, full_registry(), {}));
  std::vector<journal::HashRow> hashes;
  for (int tick = 0; tick < 30; ++tick) {
    room::Record record;
    if (tick % 10 == 3) {
      ASSERT_TRUE(session->submit(command<RenameNode>({"east", "East " + std::to_string(tick)}), "1"));
      ASSERT_TRUE(session->submit(command<SetPort>({"guest", {"smart_volume.demand"}, {std::to_string(400 + tick)}}), "2"));
      for (std::size_t k = session->log().size() - 2; k < session->log().size(); ++k)
        record.entries.push_back({session->log()[k], 1700000000000});
    }
    ASSERT_TRUE(file->commit(record));
    session->tick();
    if (tick % 10 == 9 && (is_closed || tick < 20))
      hashes.push_back({file->last_seq(), session->state()->tick, hex_digits(session->state()->hash)});
  }
  ASSERT_TRUE(file->add_hashes(hashes));
  room::Record people;
  people.persons.push_back({2, "Beatrix Quillfeather", "", "en", 0});
  people.texts.push_back({"t1", 2, "comment", "the willow must stay", false});
  people.texts.push_back({"t2", 1, "comment", "words of somebody else", false});
  people.tokens.push_back({2, "a3f1a3f1a3f1a3f1"});
  ASSERT_TRUE(file->commit(people));
  ASSERT_TRUE(file->close());
}

TEST(SessionFile, IsReplayedLikeALog) {
  const Workplace place;
  store_session(place.path("s.blsession"));
  const std::string before = place.text("s.blsession");
  for (const char* threads : {"1", "2"}) {
    const Outcome replay = place.run({"replay", "s.blsession", "--threads", threads});
    EXPECT_EQ(replay.code, 0) << replay.err;
    EXPECT_EQ(replay.err, "");
    EXPECT_EQ(replay.last_line(), "agrees with all 3 checks");
    EXPECT_NE(replay.out.find("6 entries, 30 ticks, hash "), std::string::npos) << replay.out;
  }
  EXPECT_EQ(place.text("s.blsession"), before);
  // As after a crash: the end has no hash.
  store_session(place.path("open.blsession"), false);
  const Outcome open = place.run({"replay", "open.blsession"});
  EXPECT_EQ(open.code, 0) << open.err;
  EXPECT_EQ(open.err,
            "open.blsession: warning: no hash was stored after the last entry, as after a crash: how the session ended is not "
            "compared\n");
  EXPECT_EQ(open.last_line(), "agrees with all 2 checks");
}

TEST(SessionFile, AnotherHashIsFound) {
  const Workplace place;
  store_session(place.path("s.blsession"));
  {
    auto file = std::move(*Journal::open(place.path("s.blsession"), full_registry(), {}));
    const auto hashes = file->load()->hashes;
    journal::HashRow changed = hashes[1];
    changed.hash[0] = changed.hash[0] == '0' ? '1' : '0';
    ASSERT_TRUE(file->add_hashes(std::vector{changed}));
  }
  const Outcome replay = place.run({"replay", "s.blsession"});
  EXPECT_EQ(replay.code, 3);
  EXPECT_TRUE(replay.last_line().starts_with("differs from the log first at tick 20")) << replay.out;
}

TEST(SessionFile, ADamagedOneIsBadInput) {
  const Workplace place;
  store_session(place.path("s.blsession"));
  std::string bytes = place.text("s.blsession");
  bytes.replace(bytes.find("East 13"), 7, "East 31");
  place.write("s.blsession", bytes);
  for (const auto& call : {std::vector<std::string>{"replay", "s.blsession"}, {"erase", "s.blsession", "--seat", "2"}}) {
    const Outcome outcome = place.run(call);
    EXPECT_EQ(outcome.code, 2) << call[0];
    EXPECT_EQ(outcome.err,
              "s.blsession/entry/3: it is not what was stored: a byte of it, or of an entry before it, has changed\n");
  }
  place.write("s.blsession", bytes.substr(0, bytes.size() / 2));
  EXPECT_NE(place.run({"replay", "s.blsession"}).err.find("s.blsession: the file is damaged"), std::string::npos);
  EXPECT_EQ(place.run({"replay", "s.blsession"}).code, 2);
}

TEST(SessionFile, APersonIsErased) {
  const Workplace place;
  store_session(place.path("s.blsession"));
  const Outcome before = place.run({"replay", "s.blsession"});
  EXPECT_NE(place.text("s.blsession").find("Beatrix Quillfeather"), std::string::npos);
  const Outcome erased = place.run({"erase", "s.blsession", "--seat", "2"});
  EXPECT_EQ(erased.code, 0) << erased.err;
  EXPECT_EQ(erased.out, "seat 2: erased 1 name, 1 text, 1 token and 0 answers that named the person\n");
  for (const char* secret : {"Beatrix", "willow", "a3f1a3f1"})
    EXPECT_EQ(place.text("s.blsession").find(secret), std::string::npos) << secret;
  EXPECT_NE(place.text("s.blsession").find("words of somebody else"), std::string::npos);
  EXPECT_EQ(place.run({"replay", "s.blsession"}).out, before.out);
  EXPECT_EQ(place.run({"erase", "s.blsession", "--seat", "2"}).out,
            "seat 2: erased 0 names, 0 texts, 0 tokens and 0 answers that named the person\n");
}

TEST(SessionFile, WhatCannotBeErasedIsSaid) {
  const Workplace place;
  place.write("scene.json", moving_scene());
  EXPECT_EQ(place.run({"erase", "scene.json", "--seat", "2"}).err,
            "scene.json: this is not a session file: it does not begin like one\n");
  EXPECT_EQ(place.text("scene.json"), moving_scene());
  EXPECT_EQ(place.run({"erase", "none.blsession", "--seat", "2"}).err,
            "none.blsession: the file cannot be opened: No such file or directory\n");
  EXPECT_EQ(place.run({"erase", "none.blsession"}).code, 2);
  EXPECT_EQ(place.run({"erase", "none.blsession", "--seat", "0"}).code, 2);
  // In use by this process.
  store_session(place.path("s.blsession"));
  const auto holder = std::move(*Journal::open(place.path("s.blsession"), full_registry(), {}));
  const Outcome busy = place.run({"erase", "s.blsession", "--seat", "2"});
  EXPECT_EQ(busy.code, 2);
  EXPECT_NE(busy.err.find("another program has this file open: process " + std::to_string(getpid())), std::string::npos)
      << busy.err;
  EXPECT_EQ(place.run({"replay", "s.blsession"}).code, 2);
}

}  // namespace
}  // namespace bl::test
