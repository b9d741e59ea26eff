// A document while the clock runs: what is saved is one moment, logs replay, and nothing waits for a late clock.
#include <filesystem>
#include <thread>

#include <gtest/gtest.h>

#include "core/file/file_io.h"
#include "core/session/session.h"
#include "tests/support/world.h"
#include "tests/ui/desktop/null_desktop.h"

namespace bl::desktop {
namespace {

// A clock that plays, has just ticked, and will not tick again for ten seconds.
void play_slowly(host::LiveSession& session) {
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

// Saves the log, reads it again and replays it, which must come to the same hashes.
ReplayReport replay_of_log(Document& document, const std::string& name) {
  const std::string path = ::testing::TempDir() + name;
  EXPECT_TRUE(document.save_log(path).ok());
  const auto text = read_file(path);
  EXPECT_TRUE(text.ok()) << path;
  if (!text) return {};
  const auto log = read_log(*text, full_registry());
  EXPECT_TRUE(log.ok()) << log.error().text();
  if (!log) return {};
  const auto report = replay(*log, full_registry(), 1);
  EXPECT_TRUE(report.ok()) << report.error().text();
  if (!report) return {};
  EXPECT_FALSE(report->first_mismatch.has_value());
  return *report;
}

TEST(RunningDocument, ASaveBetweenTwoTicksOpensAgain) {
  NullDesktop desktop("scenes/start/quarter.json");
  Workbench& editor = desktop.editor();
  desktop.ticks(3);
  play_slowly(editor.document->session());
  ASSERT_TRUE(editor.submit(command<RemoveNode>({"cafe"})));
  const std::string path = ::testing::TempDir() + "between_ticks.json";
  ASSERT_TRUE(editor.document->save(path).ok());
  expect_opens(path);
}

TEST(RunningDocument, ASaveBetweenTwoTicksKeepsAMove) {
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

TEST(RunningDocument, ARewindBetweenTwoTicksLeavesAJournalThatOpens) {
  NullDesktop desktop("scenes/start/quarter.json");
  Workbench& editor = desktop.editor();
  desktop.ticks(5);
  play_slowly(editor.document->session());
  ASSERT_TRUE(editor.submit(command<RemoveNode>({"cafe"})));
  editor.document->session().rewind(2);
  replay_of_log(*editor.document, "rewound_between_ticks.log");
}

// A save leaves the running state and the log as they are: it replays, whatever comes and goes.
TEST(RunningDocument, LogAfterASaveReplays) {
  NullDesktop desktop("scenes/start/quarter.json");
  Workbench& editor = desktop.editor();
  desktop.ticks(5);
  ASSERT_TRUE(editor.submit(command<RemoveNode>({"cafe"})));
  desktop.frames(2);
  ASSERT_TRUE(editor.document->save(::testing::TempDir() + "log_after_save.json").ok());
  editor.undo();
  desktop.ticks(3);
  const ReplayReport report = replay_of_log(*editor.document, "after_save.log");
  EXPECT_EQ(report.hash, hex_digits(editor.state().hash));
}

TEST(RunningDocument, LogSavedAfterAnEditOnAStandingClockReplays) {
  NullDesktop desktop("scenes/start/quarter.json");
  Workbench& editor = desktop.editor();
  desktop.ticks(5);
  ASSERT_TRUE(editor.submit(command<RemoveNode>({"cafe"})));
  desktop.frames(2);
  const ReplayReport report = replay_of_log(*editor.document, "edited_standing.log");
  EXPECT_EQ(report.checks, 1u);
}

// A clock that cannot keep up ticks without a pause; a window that waits for one would stand still.
TEST(RunningDocument, NothingWaitsForAClockThatIsBehind) {
  NullDesktop desktop("scenes/studies/thousand_volumes.json");
  host::LiveSession& session = desktop.editor().document->session();
  session.set_rate(1000);
  session.play(true);
  while (session.moment()->state->tick < 3) std::this_thread::yield();
  ASSERT_TRUE(session.moment()->is_behind());
  session.rewind(1);
  session.settle();
  EXPECT_TRUE(session.moment()->is_playing);
  const auto saved = session.coming_state();
  EXPECT_GE(saved->tick, 1);
}

TEST(RunningDocument, AnUndoThatDoesNotFitAnyMoreSaysWhy) {
  NullDesktop desktop("scenes/start/quarter.json");
  Workbench& editor = desktop.editor();
  editor.undo();
  ASSERT_FALSE(editor.notices.empty());
  EXPECT_EQ(editor.notices.back().text, "Nothing to undo.");
  ASSERT_TRUE(editor.submit(command<AddNode>({"shed", {"{}"}})));
  ASSERT_TRUE(editor.document->session().submit({.command = command<RemoveNode>({"shed"}), .author = "somebody"}).ok());
  editor.undo();
  EXPECT_NE(editor.notices.back().text.find("cannot be undone: somebody has changed nodes/shed since"), std::string::npos)
      << editor.notices.back().text;
}

}  // namespace
}  // namespace bl::desktop
