// The desktop as a whole, without a window.
#include <GLFW/glfw3.h>
#include <gtest/gtest.h>

#include "tests/ui/desktop/null_desktop.h"
#include "ui/desktop/panels/canvas/board.h"
#include "ui/desktop/panels/canvas/canvas.h"

namespace bl::desktop {
namespace {

TEST(Desktop, OpensASceneAndTicks) {
  NullDesktop desktop("scenes/start/quarter.json");
  EXPECT_EQ(desktop.editor().state().tick, 0);
  desktop.ticks(3);
  EXPECT_EQ(desktop.editor().state().tick, 3);
  EXPECT_EQ(desktop.desktop().title(), "quarter (copy, not saved yet) - BehaviourLinks");
}

TEST(Desktop, UndoTakesBackAndTheMarkOfUnsavedGoes) {
  NullDesktop desktop("scenes/start/quarter.json");
  const std::string before = desktop.scene_text();
  ASSERT_TRUE(desktop.editor().submit(command<RenameNode>({"library", "Reading room"})));
  desktop.frames(1);
  EXPECT_EQ(desktop.desktop().title(), "* quarter (copy, not saved yet) - BehaviourLinks");
  desktop.key(GLFW_KEY_Z, true);
  EXPECT_EQ(desktop.scene_text(), before);
  EXPECT_EQ(desktop.desktop().title(), "quarter (copy, not saved yet) - BehaviourLinks");
  desktop.key(GLFW_KEY_Y, true);
  EXPECT_EQ(desktop.editor().name_of("library"), "Reading room");
}

TEST(Desktop, RewindsAndGoesTheSameWayAgain) {
  NullDesktop desktop("scenes/start/quarter.json");
  desktop.ticks(12);
  const std::uint64_t hash = desktop.editor().state().hash;
  desktop.editor().document->session().rewind(7);
  desktop.frames(1);
  EXPECT_EQ(desktop.editor().state().tick, 5);
  desktop.ticks(7);
  EXPECT_EQ(desktop.editor().state().hash, hash);
}

TEST(Desktop, KeysOnTheCanvasLeaveTheMouseAlone) {
  NullDesktop desktop("scenes/start/quarter.json");
  desktop.click({1350, 400});  // into the inspector, where Home walks to the first field
  desktop.move_to({200, 500});
  desktop.key(GLFW_KEY_HOME);
  EXPECT_FALSE(ImGui::GetIO().NavVisible);
  desktop.frames(60);
  const double before = desktop.editor().canvas->zoom();
  desktop.wheel(2);
  desktop.frames(60);
  EXPECT_GT(desktop.editor().canvas->zoom(), 1.2 * before);
}

TEST(Desktop, PanesTakeTurnsWithTheKeys) {
  NullDesktop desktop("scenes/start/quarter.json");
  desktop.move_to({200, 500});
  Workbench& editor = desktop.editor();
  EXPECT_EQ(editor.area, Area::canvas);
  desktop.key(GLFW_KEY_F6);
  EXPECT_EQ(editor.area, Area::view);
  desktop.key(GLFW_KEY_F6);
  EXPECT_EQ(editor.area, Area::panels) << "the mouse rests over the canvas and has no say";
  desktop.key(GLFW_KEY_DOWN);
  EXPECT_TRUE(ImGui::GetIO().NavVisible);
  const std::string before = desktop.scene_text();
  desktop.key(GLFW_KEY_A, true);
  desktop.key(GLFW_KEY_DELETE);
  EXPECT_EQ(desktop.scene_text(), before) << "what deletes nodes on the canvas does not do so from a field";
  desktop.key(GLFW_KEY_F6);
  EXPECT_EQ(editor.area, Area::canvas);
  desktop.key(GLFW_KEY_F6);
  desktop.key(GLFW_KEY_F6);
  desktop.move_to({220, 480});
  EXPECT_EQ(editor.area, Area::canvas);
}

TEST(Desktop, DelFromTheListsRemovesWhatIsChosenAndFromAFieldDoesNot) {
  NullDesktop desktop("scenes/start/quarter.json");
  Workbench& editor = desktop.editor();
  editor.picks.only_node("library");
  editor.area = Area::panels;
  desktop.frames(3);
  desktop.key(GLFW_KEY_DOWN);
  ASSERT_TRUE(ImGui::GetIO().NavVisible);
  desktop.key(GLFW_KEY_DELETE);
  EXPECT_TRUE(editor.scene().nodes.contains("library")) << "keys walk over the fields";
  desktop.click({1350, 880});  // below the fields: nobody walks over them any more
  editor.area = Area::panels;
  editor.picks.only_node("library");
  desktop.frames(2);
  ASSERT_FALSE(ImGui::GetIO().NavVisible);
  desktop.key(GLFW_KEY_DELETE);
  EXPECT_FALSE(editor.scene().nodes.contains("library"));
  desktop.key(GLFW_KEY_Z, true);
  EXPECT_TRUE(editor.scene().nodes.contains("library")) << "one step";
  editor.picks.only_node("library");
  editor.is_beamer = true;
  desktop.frames(2);
  desktop.key(GLFW_KEY_DELETE);
  EXPECT_TRUE(editor.scene().nodes.contains("library")) << "who shows a scene changes nothing";
}

TEST(Desktop, AWindowOpensNoLargerThanItsScreen) {
  const auto opens = [](Extent wished, Extent room) {
    const Extent size = fitting_window(wished, room);
    return std::pair(size.width, size.height);
  };
  EXPECT_EQ(opens({1440, 900}, {2560, 1440}), std::pair(1440, 900));
  EXPECT_EQ(opens({1440, 900}, {1440, 900}), std::pair(1440, 900));
  EXPECT_EQ(opens({1440, 900}, {0, 0}), std::pair(1440, 900)) << "nothing is known of the screen";
  const auto [width, height] = opens({1440, 900}, {1280, 720});
  EXPECT_LT(width, 1280);
  EXPECT_LT(height, 720);
  EXPECT_GT(width * height, 1200 * 600);
  EXPECT_EQ(opens({1000, 2000}, {1280, 720}).first, 1000) << "the other length stays as it was wished";
}

// The lines' colours are the theme's, also where nothing is edited in between.
TEST(Desktop, LinesTakeTheColoursOfTheThemeAtOnce) {
  NullDesktop desktop("scenes/start/quarter.json");
  Workbench& editor = desktop.editor();
  const auto colours = [&] {
    desktop.frames(2);
    std::vector<ImU32> all;
    for (const canvas::Line& line : editor.canvas->board().model.lines) all.push_back(line.family.colour);
    return all;
  };
  const auto dark = colours();
  editor.theme.apply(false, 1);
  const auto light = colours();
  editor.theme.apply(true, 1);
  EXPECT_NE(light, dark);
  EXPECT_EQ(colours(), dark);
}

TEST(Desktop, PanesWithoutRoomHarmNobody) {
  NullDesktop desktop("scenes/start/quarter.json");
  desktop.editor().picks.only_node("library");
  for (float width = 4; width < 700; width += 9) {
    ImGui::GetIO().DisplaySize = {width, 900 - width};
    desktop.frames(1);
  }
  EXPECT_TRUE(desktop.editor().document);
}

}  // namespace
}  // namespace bl::desktop
