// Dialogs by keyboard alone: palette, new scene, and the question before something is lost.
#include <set>

#include <GLFW/glfw3.h>
#include <gtest/gtest.h>

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
  EXPECT_EQ(desktop.desktop().title(), "Untitled scene - BehaviourLinks");
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
