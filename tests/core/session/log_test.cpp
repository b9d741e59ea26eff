// Logs that were cut, put together or written by hand: what is missing is told, what cannot be is refused with its line.
#include "core/session/log.h"

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/base/stop.h"
#include "core/base/text.h"
#include "core/session/gestures.h"
#include "tests/support/world.h"

namespace bl {
namespace {

constexpr const char* kScene = R"({"format": "behaviourlinks", "version": 1, "nodes": [
  {"id": "a", "types": {"smart_volume": {}}}, {"id": "b"}], "links": [{"id": "l", "kind": "keep_distance", "from": "a", "to": "b"}]})";

std::string entry(int seq, std::int64_t tick, int gesture, const std::string& more = "") {
  return R"({"seq": )" + std::to_string(seq) + R"(, "tick": )" + std::to_string(tick) + R"(, "author": "anna", "gesture": )" +
         std::to_string(gesture) + more + R"(, "command": "rename_node", "arguments": {"id": "a", "name": "Name )" +
         std::to_string(seq) + "\"}}\n";
}

std::string mark(const char* kind, std::int64_t tick) {
  return std::string("{\"") + kind + R"(": {"tick": )" + std::to_string(tick) + R"(, "hash": "0123456789abcdef"}})" + "\n";
}

std::string why_refused(const std::string& lines, LogUse use = LogUse::replay) {
  const auto log = read_log(log_header(kScene) + lines, full_registry(), use);
  return log ? "" : log.error().text();
}

TEST(Log, WhatCannotBeIsRefusedWithItsLine) {
  EXPECT_EQ(why_refused(entry(1, 0, 1) + mark("check", 3) + entry(2, 5, 2) + mark("end", 7)), "");
  EXPECT_EQ(why_refused(mark("check", 60) + mark("check", 30)),
            "line 3/tick: the checks are not in order: tick 30 comes after tick 60");
  EXPECT_EQ(why_refused(mark("end", 60) + mark("end", 60)), "line 3: is a second end of the log; were two logs put together?");
  EXPECT_EQ(why_refused(mark("end", 60) + entry(1, 60, 1)),
            "line 3: stands after the end of the log; were two logs put together?");
  EXPECT_EQ(why_refused(mark("end", 60) + mark("check", 120)),
            "line 3: stands after the end of the log; were two logs put together?");
  EXPECT_EQ(why_refused(entry(1, 0, 1) + entry(2, 9007199254740992, 2)),
            "line 3/tick: tick 9007199254740992 is more than 100000000 ticks after the line before, longer than any session");
  EXPECT_EQ(why_refused(mark("end", 9007199254740992)),
            "line 2/tick: tick 9007199254740992 is more than 100000000 ticks after the line before, longer than any session");
  EXPECT_EQ(why_refused(entry(1, 0, 1, R"(, "undoes": 7)")), "line 2/undoes: there is no gesture 7 of anna that could be undone");
  EXPECT_EQ(why_refused(entry(1, 0, 1) + entry(2, 0, 2, R"(, "undoes": 1)") + entry(3, 0, 3, R"(, "undoes": 1)")),
            "line 4/undoes: there is no gesture 1 of anna that could be undone");
  EXPECT_EQ(why_refused(entry(1, 0, 1) + entry(2, 0, 2, R"(, "redoes": 1)")),
            "line 3/redoes: there is no gesture 1 of anna that could be redone");
  EXPECT_EQ(why_refused(entry(1, 0, 1) + entry(2, 0, 2, R"(, "undoes": 1, "redoes": 1)")),
            "line 3/undoes: an entry is either an undo or a redo, not both: remove one of the marks");
  EXPECT_EQ(why_refused(entry(1, 5, 1) + entry(2, 3, 2)), "line 3/seq: the entries are not in order");
  EXPECT_EQ(why_refused(R"({"check": {"tick": 3, "hash": "green"}})"), "line 2/hash: expects 16 hexadecimal digits");
}

// A check says what the state was after its tick: what people do before that tick cannot stand behind it.
TEST(Log, EntriesAndChecksStandInOneOrder) {
  EXPECT_EQ(why_refused(mark("check", 60) + entry(1, 30, 1)),
            "line 3/tick: the lines are not in order: an entry of tick 30 comes after a check of tick 60");
  EXPECT_EQ(why_refused(entry(1, 60, 1) + mark("check", 30)),
            "line 3/tick: the lines are not in order: a check of tick 30 comes after an entry of tick 60");
  EXPECT_EQ(why_refused(entry(1, 60, 1) + mark("end", 30)),
            "line 3/tick: the lines are not in order: a check of tick 30 comes after an entry of tick 60");
  EXPECT_EQ(why_refused(mark("check", 60) + entry(1, 60, 1) + mark("end", 60)), "");
  EXPECT_EQ(why_refused(entry(1, 60, 1) + mark("end", 59)), "") << "the tick of the entry has failed";
  EXPECT_EQ(why_refused(mark("check", 60) + entry(1, 30, 1), LogUse::recovery), "") << "who recovers compares nothing";
}

// Stopped anywhere on the way, a tick has not been: not for the state, not for the log, and not for the tick after it.
TEST(Log, AnInterruptedTickLeavesALogThatReplays) {
  const auto change = [](World& world) {
    ASSERT_EQ(world.submit(command<SetPort>({"a", {"smart_volume.demand"}, {"77"}})), "");
    ASSERT_EQ(world.submit(command<RemoveNode>({"b"})), "");
    ASSERT_EQ(world.submit(command<AddNode>({"c", {R"({"types": {"smart_volume": {}}})"}})), "");
  };
  World world = World::from_text(kScene), whole = World::from_text(kScene);
  std::string log = log_header(kScene);
  world.session().subscribe([&](const LogEntry& e) { log += log_line(e, full_registry()); });
  for (World* each : {&world, &whole}) {
    each->tick(3);
    change(*each);
  }
  const std::uint64_t before = world.state().hash;
  int stops = 0;
  for (bool is_done = false; !is_done; ++stops) {
    int asked = 0;
    {
      const StopScope scope([&] { return ++asked > stops; });
      is_done = world.session().tick();
    }
    if (is_done) break;
    ASSERT_EQ(world.state().hash, before) << stops;
    ASSERT_EQ(world.state().tick, 3) << stops;
    const auto read = read_log(log + log_line(LogCheck{3, hex_digits(world.state().hash), true}), full_registry());
    ASSERT_TRUE(read.ok()) << read.error().text();
    const auto report = replay(*read, full_registry(), 1);
    ASSERT_TRUE(report.ok()) << report.error().text();
    ASSERT_FALSE(report->first_mismatch.has_value()) << stops;
    // What is saved then fits the scene that it is saved with, and goes on in the same way.
    const SavedState saved = save(*world.session().coming_state());
    World loaded = World::from_text(write_scene(world.session().scene(), full_registry(), &saved));
    ASSERT_EQ(loaded.state().tick, 3);
    ASSERT_EQ(loaded.state().hash, world.session().coming_state()->hash);
  }
  EXPECT_GT(stops, 3);
  whole.tick();
  EXPECT_EQ(world.state().hash, whole.state().hash);
}

// A log that goes on from a saved scene begins at the number after those that the scene holds, and a replay keeps all numbers.
TEST(Log, NumbersGoOnFromTheBaseAndAreKept) {
  const auto log = read_log(log_header(kScene, 41) + entry(42, 0, 1) + entry(45, 0, 2) + mark("end", 2), full_registry());
  ASSERT_TRUE(log.ok()) << log.error().text();
  EXPECT_EQ(log->base, 41);
  Ledger ledger(full_registry(), read_scene(log->scene, full_registry()).scene);
  for (const LogEntry& each : log->entries) ASSERT_TRUE(ledger.replay(each).ok());
  ASSERT_TRUE(ledger.submit(command<RenameNode>({"b", "B"}), "ben", 0).ok());
  EXPECT_EQ(ledger.log()[0].seq, 42);
  EXPECT_EQ(ledger.log()[1].seq, 45);
  EXPECT_EQ(ledger.log()[2].seq, 46);
  EXPECT_EQ(ledger.replay(log->entries[1]).error().text(), "seq: the entry 45 is in the log already");
  const auto early = read_log(log_header(kScene, 41) + entry(41, 0, 1), full_registry());
  EXPECT_EQ(early.error().text(), "line 2/seq: the scene of the log holds all entries up to number 41 already");
}

TEST(Log, SaysWhichAuthorsAreDevices) {
  const Command renaming = command<RenameNode>({"a", "A"});
  const std::string line = log_line(LogEntry{1, 0, 1, {"osc://9000/x", AuthorKind::device}, renaming}, full_registry());
  EXPECT_NE(line.find(R"("kind": "device")"), std::string::npos) << line;
  const auto log = read_log(log_header(kScene) + line, full_registry());
  ASSERT_TRUE(log.ok()) << log.error().text();
  EXPECT_EQ(log->entries.front().author.kind, AuthorKind::device);
  EXPECT_EQ(why_refused(entry(1, 0, 1, R"(, "kind": "ghost")")), "line 2/kind: expects `person`, `device` or `program`");
}

// Logs of the programs before: no base, no kinds of authors, and then neither rewinds nor sources. Their batches are read as
// ever.
TEST(Log, OlderVersionsAreReadAndReplay) {
  World world = World::from_text(kScene);
  std::string lines = R"({"seq": 1, "tick": 0, "author": "anna", "gesture": 1, "command": "batch", "arguments": {"commands": [)"
                      R"({"command": "rename_node", "arguments": {"id": "a", "name": "A"}}, )"
                      R"({"command": "set_port", "arguments": {"node": "a", "port": "node.position", "value": [1, 2, 3]}}]}})"
                      "\n";
  const Command rename = command<RenameNode>({"a", "A"}), move = command<SetPort>({"a", {"node.position"}, {"[1, 2, 3]"}});
  ASSERT_EQ(world.submit(command<Batch>({std::vector{rename, move}}), "anna"), "");
  EXPECT_EQ(log_line(world.session().log().front(), full_registry()), lines) << "the form of a line has not changed";
  world.tick(2);
  lines += log_line(LogCheck{.tick = 2, .hash = hex_digits(world.state().hash), .is_end = true});
  for (const char* version : {"1", "2", "3", "4", "5"}) {
    std::string header = log_header(kScene);
    header.replace(header.find("\"hashes\""), header.find("\"scene\"") - header.find("\"hashes\""), "");
    header.replace(header.find("\"version\": 6"), 12, std::string("\"version\": ") + version);
    const auto log = read_log(header + lines, full_registry());
    ASSERT_TRUE(log.ok()) << log.error().text();
    const auto report = replay(*log, full_registry(), 1);
    ASSERT_TRUE(report.ok()) << report.error().text();
    EXPECT_EQ(report->checks, 1u);
    EXPECT_EQ(report->incomparable, 1u) << "its hashes are of another scheme, whatever they are";
    EXPECT_FALSE(report->first_mismatch.has_value()) << version;
  }
}

TEST(Log, LinesBeforeItsSceneAreRefused) {
  World world = World::from_text(kScene);
  world.tick(40);
  const SavedState state = save(world.state());
  const std::string header = log_header(write_scene(world.session().scene(), full_registry(), &state));
  const auto early = read_log(header + entry(1, 39, 1), full_registry());
  ASSERT_FALSE(early.ok());
  EXPECT_EQ(early.error().text(), "line 2/tick: tick 39 lies before the scene of the log, which is at tick 40");
  EXPECT_TRUE(read_log(header + entry(1, 40, 1), full_registry()).ok());
}

// A recovery wants what people did: it takes the undo of what is not there for a step like any other.
TEST(Log, ARecoveryTakesWhatOlderProgramsWrote) {
  EXPECT_EQ(why_refused(entry(1, 0, 4, R"(, "undoes": 3)") + entry(2, 9007199254740992, 5), LogUse::recovery), "");
  const auto log = read_log(log_header(kScene) + entry(1, 0, 4, R"(, "undoes": 3)") + entry(2, 0, 5, R"(, "undoes": 4)"),
                            full_registry(), LogUse::recovery);
  ASSERT_TRUE(log.ok()) << log.error().text();
  EXPECT_EQ(log->entries[0].undoes, 0);
  EXPECT_EQ(log->entries[1].undoes, 4);
}

// Wherever it is cut between two lines, what is left can be used, and does not pass for the whole.
TEST(Log, CutBetweenTwoLinesItHasNoEndAndReplaysAsFarAsItGoes) {
  World world = World::from_text(kScene);
  std::vector<std::string> lines{log_header(kScene)};
  world.session().subscribe([&](const LogEntry& e) { lines.push_back(log_line(e, full_registry())); });
  for (int k = 0; k < 20; ++k) {
    if (k % 3 == 0) {
      ASSERT_EQ(world.submit(command<SetPort>({"a", {"node.position"}, {"[" + std::to_string(k) + ", 2, 0]"}})), "");
    }
    if (k == 10) { ASSERT_TRUE(world.session().undo("test").ok()); }
    world.tick();
    if (k % 5 == 4) lines.push_back(log_line(LogCheck{world.state().tick, hex_digits(world.state().hash), false}));
  }
  lines.push_back(log_line(LogCheck{world.state().tick, hex_digits(world.state().hash), true}));
  std::string text;
  for (std::size_t cut = 1; cut <= lines.size(); ++cut) {
    text += lines[cut - 1];
    const auto log = read_log(text, full_registry());
    ASSERT_TRUE(log.ok()) << log.error().text();
    EXPECT_EQ(log->has_end, cut == lines.size());
    EXPECT_FALSE(log->is_cut_off);
    const auto report = replay(*log, full_registry(), 1);
    ASSERT_TRUE(report.ok()) << report.error().text();
    EXPECT_FALSE(report->first_mismatch.has_value()) << cut;
    EXPECT_EQ(report->checks, log->checks.size());
    EXPECT_EQ(report->ticks, log->last_tick);
  }
}

// What a window writes after a save begins in the middle of a session.
TEST(Log, UndosOfWhatWasBeforeItAreStepsLikeAnyOther) {
  World world = World::from_text(kScene);
  const auto rename = [&](const char* name) { ASSERT_EQ(world.submit(command<RenameNode>({"a", name})), ""); };
  rename("one");
  rename("two");
  const std::size_t begin = world.session().log().size();
  const std::string start = write_scene(world.session().scene(), full_registry());
  rename("three");
  for (int k = 0; k < 3; ++k) ASSERT_TRUE(world.session().undo("test").ok());
  for (int k = 0; k < 3; ++k) ASSERT_TRUE(world.session().redo("test").ok());
  ASSERT_TRUE(world.session().undo("test").ok());
  Gestures gestures;
  std::string text = log_header(start);
  for (std::size_t i = begin; i < world.session().log().size(); ++i) {
    const LogEntry fitting = gestures.fitted(world.session().log()[i]);
    ASSERT_TRUE(gestures.check(fitting).ok());
    gestures.take(fitting);
    text += log_line(fitting, full_registry());
  }
  const auto log = read_log(text, full_registry());
  ASSERT_TRUE(log.ok()) << log.error().text();
  World again = World::from_text(log->scene);
  for (const LogEntry& each : log->entries) {
    const auto done = again.session().replay(each);
    ASSERT_TRUE(done.ok()) << done.error().text();
  }
  EXPECT_EQ(hash_of(again.session().scene()), hash_of(world.session().scene()));
  EXPECT_TRUE(again.session().undo("test").ok());
}

}  // namespace
}  // namespace bl
