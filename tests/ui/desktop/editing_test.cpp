// Editing beside a running clock: everything undoable, replayable, and never lost.
#include <unistd.h>

#include <filesystem>
#include <thread>

#include <gtest/gtest.h>

#include "core/file/file_io.h"
#include "core/session/session.h"
#include "tests/support/random_commands.h"
#include "tests/support/world.h"
#include "tests/ui/desktop/null_desktop.h"

namespace bl::desktop {
namespace {

TEST(Editing, TenThousandRandomCommandsUndoneGiveTheSameBytes) {
  NullDesktop desktop("scenes/start/quarter.json");
  const std::string before = desktop.scene_text();
  host::LiveSession& session = desktop.editor().document->session();
  Random random(4, 11);
  int done = 0;
  for (int k = 0; k < 10000; ++k) {
    if (session.submit(random_command(session.scene(), random, k)).ok()) ++done;
    if (k % 2500 == 0) desktop.ticks(1);
  }
  EXPECT_GT(done, 5000);
  int undone = 0;
  while (session.undo().ok()) ++undone;
  EXPECT_EQ(undone, done);
  EXPECT_EQ(desktop.scene_text(), before);
  int redone = 0;
  while (session.redo().ok()) ++redone;
  EXPECT_EQ(redone, done);
}

// The clock runs on its thread while commands come in: what the log says has to lead to the same hash.
TEST(Editing, LogOfATickingThreadReplaysToTheSameHash) {
  NullDesktop desktop("scenes/start/quarter.json");
  host::LiveSession& session = desktop.editor().document->session();
  session.set_rate(1000);
  session.play(true);
  Random random(9, 3);
  for (int k = 0; k < 60; ++k) {
    (void)session.submit(random_command(session.scene(), random, k));
    // Every third command waits for a tick, so that the others fall into ticks that are under way.
    const std::int64_t tick = session.moment()->state->tick;
    while (k % 3 == 0 && session.moment()->state->tick == tick) std::this_thread::yield();
  }
  session.play(false);
  session.settle();
  desktop.frames(1);
  ASSERT_GE(desktop.editor().state().tick, 20);
  const std::string path = ::testing::TempDir() + "running_clock.log";
  ASSERT_TRUE(desktop.editor().document->save_log(path).ok());
  const auto text = read_file(path);
  ASSERT_TRUE(text.ok());
  const auto log = read_log(*text, full_registry());
  ASSERT_TRUE(log.ok()) << log.error().text();
  const auto report = replay(*log, full_registry(), 2);
  ASSERT_TRUE(report.ok()) << report.error().text();
  // What was said after the last tick is in the log, and in no tick yet.
  EXPECT_EQ(report->hash, hex_digits(session.moment()->ticked->hash));
  EXPECT_EQ(report->checks, 1u);
}

TEST(Editing, WhileTheClockStandsChangesAreSeenAndDoNotChangeTheNextTick) {
  NullDesktop desktop("scenes/start/quarter.json");
  host::LiveSession& session = desktop.editor().document->session();
  desktop.ticks(30);
  Random random(3, 3);
  // Things that come and go between two ticks leave their neighbours' states alone.
  ASSERT_TRUE(desktop.editor().submit(command<RemoveNode>({"theatre"})));
  session.settle();
  desktop.frames(1);
  EXPECT_EQ(desktop.editor().state().tick, 30);
  EXPECT_EQ(desktop.editor().state().plan->node_index("theatre"), desktop.editor().state().nodes.size());
  desktop.editor().undo();
  session.settle();
  desktop.frames(1);
  EXPECT_LT(desktop.editor().state().plan->node_index("theatre"), desktop.editor().state().nodes.size());
  for (int k = 0; k < 40; ++k) {
    (void)session.submit(random_command(session.scene(), random, k));
    if (k % 3 == 0) session.settle();
    if (k % 10 == 0) desktop.ticks(1);
  }
  desktop.ticks(5);
  const std::string path = ::testing::TempDir() + "standing_clock.log";
  ASSERT_TRUE(desktop.editor().document->save_log(path).ok());
  const auto log = read_log(read_file(path).value(), full_registry());
  ASSERT_TRUE(log.ok()) << log.error().text();
  const auto report = replay(*log, full_registry(), 2);
  ASSERT_TRUE(report.ok()) << report.error().text();
  EXPECT_EQ(report->hash, hex_digits(desktop.editor().state().hash));
}

TEST(Editing, ALogWithARewindReplaysToTheSameHash) {
  NullDesktop desktop("scenes/start/quarter.json");
  host::LiveSession& session = desktop.editor().document->session();
  desktop.ticks(10);
  ASSERT_TRUE(session.submit(command<SetLinkStrength>({"air", 0.1})).ok());
  desktop.ticks(5);
  session.rewind(9);
  ASSERT_TRUE(session.submit(command<SetLinkStrength>({"air", 0.9})).ok());
  desktop.ticks(4);
  const std::string path = ::testing::TempDir() + "rewound.log";
  ASSERT_TRUE(desktop.editor().document->save_log(path).ok());
  const auto log = read_log(read_file(path).value(), full_registry());
  ASSERT_TRUE(log.ok()) << log.error().text();
  const auto report = replay(*log, full_registry(), 1);
  ASSERT_TRUE(report.ok()) << report.error().text();
  EXPECT_EQ(report->hash, hex_digits(desktop.editor().state().hash));
}

// A gesture of many commands is one step, and redo brings it back.
TEST(Editing, ADragIsOneStep) {
  NullDesktop desktop("scenes/start/quarter.json");
  Workbench& editor = desktop.editor();
  const std::string before = desktop.scene_text();
  const std::int64_t gesture = editor.new_gesture();
  for (int k = 0; k < 30; ++k)
    ASSERT_TRUE(
        editor.submit(command<SetPort>({"library", {"node.position"}, {"[" + std::to_string(60 + k) + ", 44, 9]"}}), gesture));
  ASSERT_EQ(editor.document->history().size(), 1u);
  EXPECT_EQ(editor.document->history().front().label, "Set value · Library, position");
  const std::string after = desktop.scene_text();
  editor.undo();
  EXPECT_EQ(desktop.scene_text(), before);
  EXPECT_TRUE(editor.document->history().front().is_undone);
  editor.redo();
  EXPECT_EQ(desktop.scene_text(), after);
  EXPECT_FALSE(editor.document->history().front().is_undone);
}

TEST(Editing, WhatACrashLeavesIsRecovered) {
  NullDesktop desktop("scenes/start/quarter.json");
  Workbench& editor = desktop.editor();
  ASSERT_TRUE(editor.submit(command<RenameNode>({"library", "Reading room"})));
  ASSERT_TRUE(editor.submit(command<RemoveNode>({"cafe"})));
  // A window that has crashed is a process that is gone, with its journal still there.
  const std::filesystem::path folder = std::filesystem::path(host::person_folder()) / "journals";
  std::filesystem::path journal;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (entry.path().filename().string().starts_with(std::to_string(getpid()) + "-") && entry.path().extension() == ".journal")
      journal = std::max(journal, entry.path());
  ASSERT_FALSE(journal.empty());
  constexpr const char* kGone = "2147483646-1.journal";
  std::filesystem::copy_file(journal, folder / kGone, std::filesystem::copy_options::overwrite_existing);
  const auto remains = host::Journal::find(full_registry());
  ASSERT_EQ(remains.size(), 1u);
  EXPECT_EQ(remains.front().log.entries.size(), 2u);
  std::vector<Problem> problems;
  const auto recovered = Document::recover(full_registry(), remains.front(), 1, problems);
  ASSERT_TRUE(recovered);
  EXPECT_EQ(write_scene(recovered->scene(), full_registry()), desktop.scene_text());
  EXPECT_TRUE(recovered->is_unsaved());
  host::Journal::discard(remains.front());
  EXPECT_TRUE(host::Journal::find(full_registry()).empty());
}

TEST(Editing, SavedSceneOpensAsItWasLeft) {
  NullDesktop desktop("scenes/start/quarter.json");
  Workbench& editor = desktop.editor();
  desktop.ticks(6);
  ASSERT_TRUE(editor.submit(command<RenameNode>({"library", "Reading room"})));
  const std::string path = ::testing::TempDir() + "left.json";
  ASSERT_TRUE(editor.document->save(path).ok());
  EXPECT_FALSE(editor.document->is_unsaved());
  desktop.frames(1);  // what is saved has the new name in it: so has the state from here on
  const std::uint64_t hash = editor.state().hash;
  ASSERT_TRUE(editor.open(path));
  EXPECT_EQ(editor.state().hash, hash);
  EXPECT_EQ(editor.state().tick, 6);
  EXPECT_EQ(editor.name_of("library"), "Reading room");
}

TEST(Editing, ABadSceneLeavesTheOldOneOpenAndSaysWhy) {
  NullDesktop desktop("scenes/start/quarter.json");
  Workbench& editor = desktop.editor();
  const std::string path = ::testing::TempDir() + "bad.json";
  ASSERT_TRUE(write_file(path, R"({"format": "behaviourlinks", "version": 1, "nodes": [{"id": "a", "typos": {}}]})").ok());
  EXPECT_FALSE(editor.open(path));
  ASSERT_FALSE(editor.problems.empty());
  EXPECT_EQ(editor.problems.front().error.place, "nodes/a/typos");
  EXPECT_EQ(editor.scene().nodes.size(), 21u);
  desktop.frames(2);
}

}  // namespace
}  // namespace bl::desktop
