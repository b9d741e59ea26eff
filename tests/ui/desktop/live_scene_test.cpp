// Recordings in the window: each tick reads the rows that belong to it, whatever frames and ticks the screen and the clock make.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "core/base/text.h"
#include "tests/core/live/live_support.h"
#include "tests/support/world.h"
#include "tests/ui/desktop/null_desktop.h"
#include "ui/desktop/shell/live_scene.h"

namespace bl::desktop {
namespace {

constexpr int kTicks = 12;

class Recorded : public ::testing::Test {
 protected:
  Recorded() {
    std::string table = "time,v\n";
    for (int row = 0; row < 40; ++row) table += std::to_string(10 * row) + "," + std::to_string(100 + row) + "\n";
    folder.write("t.csv", table);
    folder.write("scene.json", R"({"format": "behaviourlinks", "version": 1, "nodes": [)" + nodes + R"(], "links": []})");
  }
  // Frames until the clock stands at the tick, or long after.
  void frames_until(LiveScene& live, std::int64_t tick) {
    for (int frame = 0; frame < 2000 && window.editor().document->session().moment()->state->tick < tick; ++frame) {
      window.frames();
      live.frame();
    }
    window.frames();
  }
  double value() { return as_number(value_in(*window.editor().moment->state, "s", "sensor.value")); }

  const std::string nodes = test::sensor("s", "replay:t.csv#v", R"(, "tick_length": 10)");
  const test::Folder folder;
  NullDesktop window;
};

TEST_F(Recorded, GivesTheStatesOfARun) {
  test::LiveWorld run(nodes, "", {folder.path(), false, {}});
  for (int tick = 0; tick < kTicks; ++tick) run.step();
  LiveScene live(window.editor(), false);
  window.editor().open(folder.path("scene.json"), false);
  window.editor().document->session().step(kTicks);
  frames_until(live, kTicks);
  ASSERT_EQ(window.editor().moment->state->tick, kTicks);
  EXPECT_EQ(value(), 100 + kTicks - 1);
  EXPECT_EQ(hex_digits(window.editor().moment->state->hash), run.hash());
}

TEST_F(Recorded, LosesNoRowWhenTheClockRunsFasterThanTheFrames) {
  LiveScene live(window.editor(), false);
  window.editor().open(folder.path("scene.json"), true);
  host::LiveSession& session = window.editor().document->session();
  session.set_rate(1000);
  frames_until(live, kTicks);
  session.play(false);
  session.settle();
  std::int64_t rows = 0;
  for (const LogEntry& entry : session.log()) {
    EXPECT_EQ(entry.command.id, "receive");
    EXPECT_EQ(entry.tick, rows) << "the row of tick " << rows + 1;
    ++rows;
  }
  EXPECT_GE(rows, kTicks);
}

TEST_F(Recorded, WhatDevicesSayIsNoUnsavedChange) {
  LiveScene live(window.editor(), false);
  window.editor().open(folder.path("scene.json"), false);
  Document& document = *window.editor().document;
  EXPECT_FALSE(document.is_unsaved()) << "an opened scene counts as saved";
  document.session().step(kTicks);
  frames_until(live, kTicks);
  ASSERT_GT(document.session().log().size(), 0u);
  EXPECT_FALSE(document.is_unsaved());
  EXPECT_EQ(window.desktop().title(), "scene.json - BehaviourLinks");
  ASSERT_TRUE(window.editor().submit(command<RenameNode>({"s", "Counter"})));
  EXPECT_TRUE(document.is_unsaved());
  document.session().step(3);
  frames_until(live, kTicks + 3);
  window.editor().undo();
  window.frames(2);
  EXPECT_FALSE(document.is_unsaved()) << "what a person has changed is undone, what devices have said since is not";
}

TEST_F(Recorded, GoesBackWithTheClock) {
  LiveScene live(window.editor(), false);
  window.editor().open(folder.path("scene.json"), false);
  host::LiveSession& session = window.editor().document->session();
  session.step(kTicks);
  frames_until(live, kTicks);
  session.rewind(6);
  window.frames();
  ASSERT_EQ(window.editor().moment->state->tick, kTicks - 6);
  session.step(1);
  frames_until(live, kTicks - 5);
  EXPECT_EQ(value(), 100 + kTicks - 6);
}

}  // namespace
}  // namespace bl::desktop
