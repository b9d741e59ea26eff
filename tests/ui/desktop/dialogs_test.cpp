// Dialogs by keyboard alone: palette, new scene, and the question before something is lost.
#include <set>

#include <GLFW/glfw3.h>
#include <gtest/gtest.h>

#include "core/file/file_io.h"
#include "tests/ui/desktop/null_desktop.h"
#include "ui/desktop/app/actions.h"
#include "ui/desktop/app/fuzzy.h"

namespace bl::desktop {
namespace {

TEST(Dialogs, PaletteRunsWhatIsTyped) {
  NullDesktop desktop("scenes/start/quarter.json");
  desktop.key(GLFW_KEY_K, true);
  desktop.frames(3);
  desktop.type("one tick");
  desktop.frames(1);
  desktop.key(GLFW_KEY_ENTER);
  desktop.editor().document->session().settle();
  desktop.frames(2);
  EXPECT_EQ(desktop.editor().state().tick, 1);
}

TEST(Dialogs, NewSceneFromFilesByKeyboard) {
  NullDesktop desktop;
  desktop.key(GLFW_KEY_N, true);
  desktop.frames(3);
  desktop.type(BL_SOURCE_DIR "/tests/data/plan_dutch.geojson");
  desktop.key(GLFW_KEY_TAB);
  desktop.frames(2);
  desktop.type(BL_SOURCE_DIR "/tests/data/functions.csv");
  desktop.frames(1);
  desktop.key(GLFW_KEY_ENTER);
  desktop.frames(3);
  ASSERT_TRUE(desktop.editor().document);
  EXPECT_GT(desktop.editor().scene().nodes.size(), 5u);
  EXPECT_EQ(desktop.desktop().title(), "* Untitled scene - BehaviourLinks") << "no file holds it";
  desktop.key(GLFW_KEY_W, true);
  desktop.frames(2);
  EXPECT_TRUE(desktop.editor().document) << "closing it asks first";
}

TEST(Dialogs, EachFileThatWouldBeReplacedIsAskedAbout) {
  NullDesktop desktop("scenes/start/quarter.json");
  const std::string folder = ::testing::TempDir();
  for (const char* name : {"asked_one.json", "asked_two.json"}) ASSERT_TRUE(write_file(folder + "/" + name, "old\n"));
  desktop.key(GLFW_KEY_S, true, true);
  desktop.frames(3);
  const auto enter = [&](const std::string& name) {
    desktop.key(GLFW_KEY_A, true);
    desktop.type(folder + "/" + name);
    desktop.frames(1);
    desktop.key(GLFW_KEY_ENTER);
    desktop.frames(3);
  };
  const auto content = [&](const std::string& name) { return read_file(folder + "/" + name).value(); };
  enter("asked_one.json");
  enter("asked_two.json");
  EXPECT_EQ(content("asked_one.json"), "old\n");
  EXPECT_EQ(content("asked_two.json"), "old\n") << "the question was about the other one";
  desktop.key(GLFW_KEY_ENTER);
  desktop.frames(3);
  EXPECT_EQ(content("asked_one.json"), "old\n");
  EXPECT_NE(content("asked_two.json"), "old\n");
  EXPECT_EQ(desktop.editor().document->name(), "asked_two.json");
}

TEST(Dialogs, AFileThatCannotBeWrittenLeavesTheDialogWithItsName) {
  NullDesktop desktop("scenes/start/quarter.json");
  desktop.key(GLFW_KEY_S, true, true);
  desktop.frames(3);
  desktop.key(GLFW_KEY_A, true);
  desktop.type("/proc/nowhere/scene.json");
  desktop.key(GLFW_KEY_ENTER);
  desktop.frames(4);
  EXPECT_TRUE(ImGui::IsPopupOpen(nullptr, ImGuiPopupFlags_AnyPopupId | ImGuiPopupFlags_AnyPopupLevel));
  EXPECT_EQ(desktop.editor().document->name(), "quarter.json");
  desktop.key(GLFW_KEY_ESCAPE);
  desktop.frames(3);
  EXPECT_FALSE(ImGui::IsPopupOpen(nullptr, ImGuiPopupFlags_AnyPopupId | ImGuiPopupFlags_AnyPopupLevel));
}

TEST(Dialogs, QuittingWithUnsavedChangesAsks) {
  NullDesktop desktop("scenes/start/quarter.json");
  ASSERT_TRUE(desktop.editor().submit(command<RenameNode>({"library", "Reading room"})));
  desktop.key(GLFW_KEY_Q, true);
  desktop.frames(2);
  EXPECT_FALSE(desktop.editor().wants_quit);
  desktop.key(GLFW_KEY_ESCAPE);
  desktop.editor().undo();
  desktop.key(GLFW_KEY_Q, true);
  EXPECT_TRUE(desktop.editor().wants_quit);
}

// A key that means two things at one place and time is a trap.
TEST(Actions, KeysAreUniqueWhereTheyCount) {
  NullDesktop desktop("scenes/start/quarter.json");
  Editor& editor = desktop.editor();
  editor.picks.only_node("library");
  for (const bool is_beamer : {false, true})
    for (const Area area : {Area::canvas, Area::view}) {
      editor.is_beamer = is_beamer;
      if (is_beamer && area == Area::canvas) continue;  // there is no canvas then
      std::set<std::string> taken;
      for (const Action& action : actions())
        for (const Chord& chord : {action.chord, action.other}) {
          const bool counts = action.area == Area::none || action.area == area;
          if (chord.key == 0 || !counts || (action.can != nullptr && !action.can(editor))) continue;
          EXPECT_TRUE(taken.insert(text_of(chord)).second) << text_of(chord) << " of " << action.label;
        }
    }
}

TEST(Actions, EachSaysWhatItDoesAndCanBeRun) {
  for (const Action& action : actions()) {
    EXPECT_NE(action.run, nullptr) << action.label;
    EXPECT_FALSE(std::string(action.label).empty());
    EXPECT_EQ(text_of(action.chord).find('?'), std::string::npos) << action.label;
  }
}

TEST(Fuzzy, StartsOfWordsComeFirst) {
  EXPECT_LT(fuzzy_score("xyz", "Set value"), 0);
  EXPECT_GT(fuzzy_score("sv", "Set value"), fuzzy_score("sv", "absolve"));
  EXPECT_GT(fuzzy_score("rew", "Rewind five seconds"), fuzzy_score("rew", "Take a picture of the window"));
  EXPECT_LT(fuzzy_score("a", ""), 0);
}

}  // namespace
}  // namespace bl::desktop
