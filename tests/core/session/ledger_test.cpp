// What entries say of themselves: where they came from, what they are called, who hears of them, and what a rewind does.
#include "core/session/ledger.h"

#include <vector>

#include <gtest/gtest.h>

#include "core/base/text.h"
#include "tests/support/world.h"

namespace bl {
namespace {

constexpr const char* kAttracted = R"({"format": "behaviourlinks", "version": 1, "nodes": [
  {"id": "a", "types": {"smart_volume": {}}}, {"id": "b", "position": [9, 0, 0], "types": {"smart_volume": {}}}],
  "links": [{"id": "l", "kind": "attract", "from": "a", "to": "b"}]})";

Submission rename(const char* name, Source source, const char* label = "") {
  return {.command = command<RenameNode>({"a", name}), .author = "anna", .source = std::move(source), .label = label};
}

TEST(Ledger, AnOperationIsTakenOnce) {
  Ledger ledger(full_registry(), read_scene(kAttracted, full_registry()).scene);
  ASSERT_TRUE(ledger.submit(rename("one", {"window 1", 1}), 0).ok());
  ASSERT_TRUE(ledger.submit(rename("two", {"window 2", 1}), 0).ok());
  const auto again = ledger.submit(rename("three", {"window 1", 1}), 0);
  ASSERT_FALSE(again.ok());
  EXPECT_EQ(again.error().code, ErrorCode::duplicate);
  EXPECT_EQ(again.error().text(), "operation: the operation 1 of `window 1` was applied already, or comes too late");
  EXPECT_EQ(ledger.scene().nodes.at("a").name, "two");
  ASSERT_TRUE(ledger.submit(rename("four", {"window 1", 5}), 0).ok());
  EXPECT_FALSE(ledger.submit(rename("five", {"window 1", 4}), 0).ok());
  ASSERT_TRUE(ledger.undo("anna", 0, 0, {"window 1", 6}).ok());
  EXPECT_FALSE(ledger.undo("anna", 0, 0, {"window 1", 6}).ok());
  EXPECT_EQ(ledger.scene().nodes.at("a").name, "two");
  EXPECT_EQ(ledger.log().back().source, (Source{"window 1", 6}));
}

TEST(Ledger, LinesKeepSourceAndLabel) {
  Ledger ledger(full_registry(), read_scene(kAttracted, full_registry()).scene, 7);
  ASSERT_TRUE(ledger.submit(rename("one", {"window 1", 3}, "Call it one"), 0).ok());
  const std::string line = log_line(ledger.log().back(), full_registry());
  EXPECT_EQ(
      line,
      R"({"seq": 8, "tick": 0, "author": "anna", "gesture": 1, "origin": "window 1", "operation": 3, "label": "Call it one", )"
      R"("command": "rename_node", "arguments": {"id": "a", "name": "one"}})"
      "\n");
  const auto log = read_log(log_header(kAttracted, 7) + line, full_registry());
  ASSERT_TRUE(log.ok()) << log.error().text();
  Ledger again(full_registry(), read_scene(kAttracted, full_registry()).scene, 7);
  ASSERT_TRUE(again.replay(log->entries.front()).ok());
  EXPECT_EQ(log_line(again.log().back(), full_registry()), line);
  EXPECT_FALSE(again.submit(rename("two", {"window 1", 3}), 0).ok()) << "a replay knows what was taken";
}

TEST(Ledger, SeveralListenersHearOfEachEntry) {
  Ledger ledger(full_registry(), read_scene(kAttracted, full_registry()).scene);
  std::vector<std::int64_t> first, second;
  const std::size_t number = ledger.subscribe([&](const LogEntry& entry) { first.push_back(entry.seq); });
  ASSERT_TRUE(ledger.submit(rename("one", {}), 0).ok());
  ledger.subscribe([&](const LogEntry& entry) { second.push_back(entry.seq); });
  ASSERT_TRUE(ledger.submit(rename("two", {}), 0).ok());
  ledger.unsubscribe(number);
  ASSERT_TRUE(ledger.undo("anna", 0).ok());
  EXPECT_EQ(first, (std::vector<std::int64_t>{1, 2}));
  EXPECT_EQ(second, (std::vector<std::int64_t>{2, 3}));
}

// A rewind and what follows it are in the log, which replays to the same hash, also where it goes back twice.
TEST(Ledger, ARewindIsAnEntryThatReplaysToTheSameHash) {
  World world = World::from_text(kAttracted);
  std::string log = log_header(kAttracted);
  world.session().subscribe([&](const LogEntry& entry) { log += log_line(entry, full_registry()); });
  world.session().keep_states({0, 4, 6});
  std::size_t checks = 0;
  const auto check = [&] {
    log += log_line(LogCheck{world.state().tick, hex_digits(world.state().hash), false});
    ++checks;
  };
  const auto move = [&](const char* place) { ASSERT_EQ(world.submit(command<SetPort>({"b", {"node.position"}, {place}})), ""); };
  world.tick(5);
  check();
  move("[3, 4, 0]");
  world.tick(4);
  const std::uint64_t at_nine = world.state().hash;
  check();
  move("[7, 7, 0]");
  ASSERT_TRUE(world.session().rewind(4, "anna").ok());
  EXPECT_EQ(world.state().tick, 4);
  EXPECT_EQ(world.session().rewind(4, "anna").error().text(), "rewind: the state of tick 4 is not kept");
  check();
  world.tick(5);
  EXPECT_NE(world.state().hash, at_nine) << "the scene stayed as it was";
  check();
  ASSERT_TRUE(world.session().rewind(6, "ben").ok());
  ASSERT_EQ(world.submit(command<RemoveLink>({"l"})), "");
  world.tick(6);
  check();
  ASSERT_TRUE(world.session().rewind(0, "ben").ok());
  world.tick(2);
  log += log_line(LogCheck{world.state().tick, hex_digits(world.state().hash), true});
  const auto read = read_log(log, full_registry());
  ASSERT_TRUE(read.ok()) << read.error().text();
  const auto report = replay(*read, full_registry(), 2);
  ASSERT_TRUE(report.ok()) << report.error().text();
  EXPECT_EQ(report->checks, checks + 1);
  EXPECT_FALSE(report->first_mismatch.has_value());
  EXPECT_EQ(report->hash, hex_digits(world.state().hash));
  EXPECT_EQ(report->ticks, 2);
}

TEST(Ledger, ARewindIsNoStepAndCannotBeUndone) {
  World world = World::from_text(kAttracted);
  ASSERT_EQ(world.submit(command<RenameNode>({"a", "A"}), "anna"), "");
  world.session().keep_states({1});
  world.tick(3);
  ASSERT_TRUE(world.session().rewind(1, "anna").ok());
  Ledger& ledger = world.session().ledger();
  const std::int64_t gesture = ledger.log().back().gesture;
  EXPECT_EQ(ledger.undo("anna", 1, gesture).error().text(), "a return cannot be undone: the later states were discarded");
  ASSERT_TRUE(ledger.undo("anna", 1).ok());
  EXPECT_EQ(world.session().scene().nodes.at("a").name, "");
}

TEST(Ledger, WhatIsAbandonedCannotBeBroughtBack) {
  World world = World::from_text(kAttracted);
  std::string log = log_header(kAttracted);
  world.session().subscribe([&](const LogEntry& entry) { log += log_line(entry, full_registry()); });
  ASSERT_EQ(world.submit(command<RenameNode>({"a", "A"}), "anna"), "");
  Ledger& ledger = world.session().ledger();
  const std::int64_t drag = ledger.new_gesture();
  ASSERT_TRUE(ledger.submit(command<RenameNode>({"a", "B"}), "anna", 0, drag).ok());
  ASSERT_TRUE(ledger.submit(command<RenameNode>({"b", "C"}), "anna", 0, drag).ok());
  ASSERT_TRUE(ledger.abandon("anna", 0, drag).ok());
  EXPECT_EQ(ledger.scene().nodes.at("a").name, "A");
  EXPECT_FALSE(ledger.can_redo("anna"));
  EXPECT_FALSE(ledger.redo("anna", 0).ok());
  ASSERT_TRUE(ledger.undo("anna", 0).ok());
  EXPECT_EQ(ledger.scene().nodes.at("a").name, "");
  EXPECT_TRUE(ledger.can_redo("anna"));
  const auto read = read_log(log, full_registry());
  ASSERT_TRUE(read.ok()) << read.error().text();
  World again = World::from_text(kAttracted);
  for (const LogEntry& entry : read->entries) ASSERT_TRUE(again.session().replay(entry).ok());
  EXPECT_FALSE(again.session().scene().nodes.at("a").name == "A");
  ASSERT_TRUE(again.session().redo("anna").ok());
  EXPECT_EQ(again.session().scene().nodes.at("a").name, "A") << "the step before, not what was abandoned";
}

TEST(Ledger, LinesOfRewindsThatCannotBeAreRefused) {
  const auto why = [](const std::string& lines) {
    const auto log = read_log(log_header(kAttracted) + lines, full_registry());
    return log ? "" : log.error().text();
  };
  const std::string head = R"({"seq": 1, "tick": 5, "author": "anna", "gesture": 1, )";
  EXPECT_EQ(why(head + R"("rewind": 3})"), "");
  EXPECT_EQ(why(head + R"("rewind": 5})"), "line 2/rewind: goes back to tick 5, which is not before its own");
  EXPECT_EQ(why(head + R"("rewind": 3, "undoes": 1})"),
            "line 2/undoes: a rewind has no command and undoes none: remove the other fields");
  EXPECT_EQ(why(head + R"("rewind": 3, "command": "batch"})"),
            "line 2/command: a rewind has no command and undoes none: remove the other fields");
  EXPECT_EQ(why(head + R"("rewind": -1})"), "line 2/rewind: expects a whole number from 0 to 2^53");
  const std::string after = R"({"seq": 2, "tick": 2, "author": "anna", "gesture": 2, "rewind": 0})";
  EXPECT_EQ(why(head + "\"rewind\": 3}\n" + after), "line 3/seq: the entries are not in order");
  EXPECT_EQ(why(head + "\"rewind\": 1}\n" + after), "");
  World world = World::from_text(kAttracted);
  world.tick(4);
  const SavedState state = save(world.state());
  const auto early = read_log(
      log_header(write_scene(world.session().scene(), full_registry(), &state)) + head + R"("rewind": 3})", full_registry());
  EXPECT_EQ(early.error().text(), "line 2/rewind: tick 3 lies before the scene of the log, which is at tick 4");
}

}  // namespace
}  // namespace bl
