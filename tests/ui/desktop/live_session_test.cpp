// The clock's thread beside people's: what is saved is one moment, nothing waits for a late clock, and no edit is lost.
#include <atomic>
#include <filesystem>
#include <new>
#include <thread>

#include <gtest/gtest.h>

#include "core/define/link_builder.h"
#include "core/file/file_io.h"
#include "core/session/session.h"
#include "tests/support/world.h"
#include "tests/ui/desktop/null_desktop.h"

namespace bl::desktop {
namespace {

// A link kind that people can make fail, or wait, in the middle of a tick; it changes nothing.
struct Trap {
  struct In {
    double number = 0;
  };
  struct Ends {
    Point3 to;
  };
  struct Out {
    std::optional<Vector3> to;
  };
  static inline std::atomic<bool> fails_to_begin = false, fails = false, waits = false;
  static inline std::atomic<int> begun = 0;

  static void declare(LinkBuilder<Trap>& l) {
    l.id("trap").label("Trap").doc("Fails when it is told to.");
    l.param(&In::number, "number").doc("A number.");
    l.reads(&Ends::to, End::to, "node.position", Unit::metre);
    l.proposes(&Out::to, End::to, "node.position", Unit::metre);
  }
  static Result<Out> evaluate(const In&, const Ends&, const Tick&) {
    ++begun;
    while (waits) std::this_thread::yield();
    if (fails) throw std::bad_alloc();
    return Out{};
  }
  static void disarm() { fails_to_begin = fails = waits = false; }
};

const Registry& registry_with_trap() {
  static const Registry kRegistry = [] {
    Registry registry = full_registry();
    LinkDefinition trap = LinkBuilder<Trap>::build();
    trap.instantiate = [made = trap.instantiate](std::span<const Value> values) {
      if (Trap::fails_to_begin) throw std::bad_alloc();
      return made(values);
    };
    registry.add(std::move(trap));
    return registry;
  }();
  return kRegistry;
}

constexpr const char* kTrapScene = R"({"format": "behaviourlinks", "version": 1,
  "nodes": [{"id": "a", "types": {"control": {}}}, {"id": "b", "types": {"control": {}}}],
  "links": [{"id": "trap", "kind": "trap", "from": "a", "to": "b"}]})";

std::unique_ptr<Document> trap_document() {
  std::vector<Problem> problems;
  auto document = Document::from_text(registry_with_trap(), kTrapScene, "", 1, problems);
  EXPECT_TRUE(document) << (problems.empty() ? "" : problems.front().error.text());
  return document;
}

// A clock that plays, has just ticked, and will not tick again for ten seconds.
void play_slowly(LiveSession& session) {
  const std::int64_t tick = session.moment()->state->tick;
  session.set_rate(0.1);
  session.play(true);
  while (session.moment()->state->tick == tick) std::this_thread::yield();
}

void expect_opens(const std::string& path) {
  std::vector<Problem> problems;
  EXPECT_TRUE(Document::open(full_registry(), path, 1, problems));
  for (const Problem& problem : problems) ADD_FAILURE() << problem.error.text();
}

TEST(LiveSession, ASaveBetweenTwoTicksOpensAgain) {
  NullDesktop desktop("scenes/start/quarter.json");
  Workbench& editor = desktop.editor();
  desktop.ticks(3);
  play_slowly(editor.document->session());
  ASSERT_TRUE(editor.submit(command<RemoveNode>({"cafe"})));
  const std::string path = ::testing::TempDir() + "between_ticks.json";
  ASSERT_TRUE(editor.document->save(path).ok());
  expect_opens(path);
}

TEST(LiveSession, ASaveBetweenTwoTicksKeepsAMove) {
  NullDesktop desktop("scenes/start/quarter.json");
  Workbench& editor = desktop.editor();
  desktop.ticks(3);
  play_slowly(editor.document->session());
  ASSERT_TRUE(editor.submit(command<SetPort>({"cafe", {"node.position"}, {"[1, 2, 3]"}})));
  const std::string path = ::testing::TempDir() + "moved_between_ticks.json";
  ASSERT_TRUE(editor.document->save(path).ok());
  std::vector<Problem> problems;
  const auto opened = Document::open(full_registry(), path, 1, problems);
  ASSERT_TRUE(opened);
  EXPECT_EQ(std::get<Vector3>(value_in(*opened->session().moment()->state, "cafe", "node.position")), (Vector3{1, 2, 3}));
}

TEST(LiveSession, ARewindBetweenTwoTicksLeavesAJournalThatOpens) {
  NullDesktop desktop("scenes/start/quarter.json");
  Workbench& editor = desktop.editor();
  desktop.ticks(5);
  play_slowly(editor.document->session());
  ASSERT_TRUE(editor.submit(command<RemoveNode>({"cafe"})));
  editor.document->session().rewind(2);
  const std::string path = ::testing::TempDir() + "rewound_between_ticks.log";
  ASSERT_TRUE(editor.document->save_log(path).ok());
  const auto log = read_log(read_file(path).value(), full_registry());
  ASSERT_TRUE(log.ok()) << log.error().text();
  const auto report = replay(*log, full_registry(), 1);
  ASSERT_TRUE(report.ok()) << report.error().text();
  EXPECT_FALSE(report->first_mismatch.has_value());
}

// What is saved is also what the next tick goes on from: the log that begins with the save replays, whatever comes and goes.
TEST(LiveSession, LogAfterASaveReplays) {
  NullDesktop desktop("scenes/start/quarter.json");
  Workbench& editor = desktop.editor();
  desktop.ticks(5);
  ASSERT_TRUE(editor.submit(command<RemoveNode>({"cafe"})));
  desktop.frames(2);
  ASSERT_TRUE(editor.document->save(::testing::TempDir() + "log_after_save.json").ok());
  editor.undo();
  desktop.ticks(3);
  const std::string path = ::testing::TempDir() + "after_save.log";
  ASSERT_TRUE(editor.document->save_log(path).ok());
  const auto log = read_log(read_file(path).value(), full_registry());
  ASSERT_TRUE(log.ok()) << log.error().text();
  const auto report = replay(*log, full_registry(), 1);
  ASSERT_TRUE(report.ok()) << report.error().text();
  EXPECT_FALSE(report->first_mismatch.has_value());
  EXPECT_EQ(report->hash, hex_digits(editor.state().hash));
}

TEST(LiveSession, LogSavedAfterAnEditOnAStandingClockReplays) {
  NullDesktop desktop("scenes/start/quarter.json");
  Workbench& editor = desktop.editor();
  desktop.ticks(5);
  ASSERT_TRUE(editor.submit(command<RemoveNode>({"cafe"})));
  desktop.frames(2);
  const std::string path = ::testing::TempDir() + "edited_standing.log";
  ASSERT_TRUE(editor.document->save_log(path).ok());
  const auto log = read_log(read_file(path).value(), full_registry());
  ASSERT_TRUE(log.ok()) << log.error().text();
  const auto report = replay(*log, full_registry(), 1);
  ASSERT_TRUE(report.ok()) << report.error().text();
  EXPECT_EQ(report->checks, 1u);
  EXPECT_FALSE(report->first_mismatch.has_value());
}

// A clock that cannot keep up ticks without a pause; a window that waits for one would stand still.
TEST(LiveSession, NothingWaitsForAClockThatIsBehind) {
  NullDesktop desktop("scenes/studies/thousand_volumes.json");
  LiveSession& session = desktop.editor().document->session();
  session.set_rate(1000);
  session.play(true);
  while (session.moment()->state->tick < 3) std::this_thread::yield();
  ASSERT_TRUE(session.moment()->is_behind());
  session.rewind(1);
  session.settle();
  EXPECT_TRUE(session.moment()->is_playing);
  const auto saved = session.take_on_changes();
  EXPECT_GE(saved->tick, 1);
}

TEST(LiveSession, AHigherRateCountsAtOnce) {
  NullDesktop desktop("scenes/start/quarter.json");
  LiveSession& session = desktop.editor().document->session();
  play_slowly(session);
  const std::int64_t tick = session.moment()->state->tick;
  const auto begin = std::chrono::steady_clock::now();
  session.set_rate(1000);
  while (session.moment()->state->tick == tick) std::this_thread::yield();
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(5)) << "it was to tick after ten seconds";
}

TEST(LiveSession, AnEditOutlivesATickThatCannotBegin) {
  const auto document = trap_document();
  ASSERT_TRUE(document);
  LiveSession& session = document->session();
  session.step(1);
  session.settle();
  Trap::fails_to_begin = true;
  ASSERT_TRUE(session.submit(command<SetPort>({"a", {"control.value"}, {"7"}})).ok());
  ASSERT_TRUE(session.submit(command<RenameNode>({"a", "Anna"})).ok());  // a name asks for a new plan
  session.step(1);
  session.settle();
  EXPECT_NE(session.moment()->failure, "");
  EXPECT_EQ(session.moment()->state->tick, 1);
  Trap::disarm();
  session.step(1);
  session.settle();
  EXPECT_EQ(session.moment()->failure, "");
  EXPECT_EQ(std::get<double>(value_in(*session.moment()->state, "a", "control.value")), 7);
}

TEST(LiveSession, AFailureStaysUntilATickGoesWell) {
  const auto document = trap_document();
  ASSERT_TRUE(document);
  LiveSession& session = document->session();
  Trap::fails = true;
  session.step(1);
  session.settle();
  Trap::disarm();
  ASSERT_NE(session.moment()->failure, "");
  session.set_rate(0.1);
  session.play(false);
  ASSERT_TRUE(session.submit(command<SetPort>({"a", {"control.value"}, {"3"}})).ok());
  session.settle();
  EXPECT_NE(session.moment()->failure, "");
  session.step(1);
  session.settle();
  EXPECT_EQ(session.moment()->failure, "");
}

// The tick that an edit was made for never comes: what follows stands in the log behind it all the same.
TEST(LiveSession, LogAroundAFailedTickCanBeRead) {
  const auto document = trap_document();
  ASSERT_TRUE(document);
  LiveSession& session = document->session();
  Trap::fails = Trap::waits = true;
  const int begun = Trap::begun;
  session.step(1);
  while (Trap::begun == begun) std::this_thread::yield();
  ASSERT_TRUE(session.submit(command<RenameNode>({"a", "During"})).ok());
  Trap::waits = false;
  session.settle();
  Trap::disarm();
  ASSERT_NE(session.moment()->failure, "");
  ASSERT_TRUE(session.submit(command<RenameNode>({"b", "After"})).ok());
  const std::string path = ::testing::TempDir() + "failed_tick.log";
  ASSERT_TRUE(document->save_log(path).ok());
  const auto log = read_log(read_file(path).value(), registry_with_trap());
  ASSERT_TRUE(log.ok()) << log.error().text();
  EXPECT_EQ(log->entries.size(), 2u);
}

TEST(LiveSession, AnUndoThatDoesNotFitAnyMoreSaysWhy) {
  NullDesktop desktop("scenes/start/quarter.json");
  Workbench& editor = desktop.editor();
  editor.undo();
  ASSERT_FALSE(editor.notices.empty());
  EXPECT_EQ(editor.notices.back().text, "Nothing to undo.");
  ASSERT_TRUE(editor.submit(command<AddNode>({"shed", {"{}"}})));
  ASSERT_TRUE(editor.document->session().replay({0, 0, 99, "somebody", command<RemoveNode>({"shed"}), 0, 0}).ok());
  editor.undo();
  EXPECT_NE(editor.notices.back().text.find("cannot be undone: somebody has changed nodes/shed since"), std::string::npos)
      << editor.notices.back().text;
}

}  // namespace
}  // namespace bl::desktop
