// Nodes that are hidden from 3D: neither drawn nor picked, marked on the canvas, undone, kept in the scene, and easily shown
// again.
#include <GLFW/glfw3.h>
#include <gtest/gtest.h>

#include "tests/ui/desktop/null_desktop.h"
#include "ui/desktop/panels/canvas/board.h"
#include "ui/desktop/panels/canvas/canvas.h"
#include "ui/desktop/panels/hidden.h"
#include "ui/desktop/panels/scene_view.h"

namespace bl::desktop {
namespace {

class HiddenTest : public ::testing::Test {
 protected:
  HiddenTest() : desktop("scenes/start/quarter.json") {
    desktop.ticks(40);
    desktop.move_to({1440 - 330 - 30, 130});
    desktop.key(GLFW_KEY_1);
    desktop.frames(30);
    before = desktop.scene_text();
    logic_before = desktop.logic_text();
  }
  // The first edit stores where boxes lie, and showing them again takes nothing of that back.
  void expect_nothing_hidden() {
    EXPECT_EQ(editor().scene().view.find("hidden"), std::string::npos);
    EXPECT_EQ(desktop.logic_text(), logic_before);
  }
  Workbench& editor() { return desktop.editor(); }
  SceneView& view() { return *editor().view; }
  bool is_drawn(const std::string& id) { return view().facts()->volume_of(editor().index_of(id)) != nullptr; }
  ImVec2 spot_of(const std::string& id) {
    const auto ref = editor().state().plan->find(editor().index_of(id), {"node", "position", ""});
    const Seen at = view().place_in_window(std::get<Vector3>(editor().state().value(*ref)));
    return {static_cast<float>(at.x), static_cast<float>(at.y)};
  }
  void hide(const std::set<std::string>& nodes) {
    editor().picks.clear();
    editor().picks.nodes = nodes;
    desktop.key(GLFW_KEY_H, false, true);
    desktop.frames(2);
  }

  NullDesktop desktop;
  std::string before, logic_before;
};

TEST_F(HiddenTest, WhatIsHiddenIsNeitherDrawnNorPicked) {
  const ImVec2 spot = spot_of("theatre");
  desktop.move_to(spot);
  EXPECT_EQ(view().pointed_at(), "theatre");
  hide({"theatre"});
  editor().picks.clear();
  EXPECT_FALSE(is_drawn("theatre"));
  EXPECT_TRUE(is_drawn("library"));
  for (const LinkFacts& link : view().facts()->links)
    EXPECT_TRUE(link.from != editor().index_of("theatre") && link.to != editor().index_of("theatre"));
  desktop.move_to({spot.x + 3, spot.y});
  EXPECT_NE(view().pointed_at(), "theatre");
  desktop.click(spot);
  EXPECT_FALSE(editor().picks.nodes.contains("theatre"));
  desktop.key(GLFW_KEY_Z, true);
  desktop.frames(2);
  EXPECT_TRUE(is_drawn("theatre"));
  EXPECT_EQ(desktop.scene_text(), before);
}

TEST_F(HiddenTest, TheSameKeyShowsItAgain) {
  hide({"theatre", "library"});
  hide({"theatre", "library", "cafe"});
  EXPECT_FALSE(is_drawn("cafe"));
  hide({"theatre", "library", "cafe"});
  EXPECT_TRUE(is_drawn("theatre") && is_drawn("library") && is_drawn("cafe"));
  expect_nothing_hidden();
  EXPECT_EQ(editor().document->history().size(), 3u);
}

TEST_F(HiddenTest, TheCornerSaysSoAndAClickShowsAll) {
  EXPECT_EQ(view().hidden_note().z, 0);
  hide({"theatre", "library", "cafe"});
  HiddenNodes hidden;
  EXPECT_EQ(hidden.text(editor()), "3\xC2\xA0volumes hidden");
  const ImVec4 note = view().hidden_note();
  ASSERT_GT(note.z, note.x);
  desktop.click({(note.x + note.z) / 2, (note.y + note.w) / 2});
  desktop.frames(2);
  EXPECT_TRUE(is_drawn("theatre"));
  EXPECT_EQ(view().hidden_note().z, 0);
  expect_nothing_hidden();
}

TEST_F(HiddenTest, TheTickDoesNotNotice) {
  NullDesktop other("scenes/start/quarter.json");
  other.ticks(40);
  hide({"theatre", "programme"});
  desktop.ticks(5);
  other.ticks(5);
  EXPECT_EQ(editor().state().hash, other.editor().state().hash);
}

TEST_F(HiddenTest, TheCanvasMarksItAndForgetsItWithTheNode) {
  hide({"theatre"});
  const canvas::Model& model = editor().canvas->board().model;
  EXPECT_TRUE(model.boxes[model.find_box("theatre")].is_hidden);
  EXPECT_FALSE(model.boxes[model.find_box("library")].is_hidden);
  desktop.move_to({300, 300});
  desktop.key(GLFW_KEY_DELETE);
  desktop.frames(2);
  EXPECT_EQ(editor().scene().view.find("hidden"), std::string::npos);
  desktop.key(GLFW_KEY_Z, true);
  desktop.key(GLFW_KEY_Z, true);
  EXPECT_EQ(desktop.scene_text(), before);
}

TEST_F(HiddenTest, MovingByKeySaysWhyNothingMoves) {
  hide({"theatre"});
  desktop.key(GLFW_KEY_G);
  EXPECT_FALSE(view().is_moving());
  EXPECT_FALSE(editor().notices.empty());
}

TEST_F(HiddenTest, EverythingCanBeHidden) {
  std::set<std::string> all;
  for (const auto& [id, node] : editor().scene().nodes) all.insert(id);
  hide(all);
  EXPECT_TRUE(view().facts()->volumes.empty());
  EXPECT_TRUE(view().facts()->marks.empty());
  for (const auto& layer : layers()) set_layer(editor().person, layer.id, true);
  desktop.ticks(2);
  view().fit(true);
  desktop.frames(30);
  desktop.key(GLFW_KEY_H, false, false, true);
  desktop.frames(2);
  expect_nothing_hidden();
}

}  // namespace
}  // namespace bl::desktop
