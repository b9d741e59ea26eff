// The desktop as a whole, without a window.
#include <GLFW/glfw3.h>
#include <gtest/gtest.h>

#include "tests/ui/desktop/null_desktop.h"

namespace bl::desktop {
namespace {

TEST(Desktop, OpensASceneAndTicks) {
  NullDesktop desktop("scenes/start/quarter.json");
  EXPECT_EQ(desktop.editor().state().tick, 0);
  desktop.ticks(3);
  EXPECT_EQ(desktop.editor().state().tick, 3);
  EXPECT_EQ(desktop.desktop().title(), "quarter.json - BehaviourLinks");
}

TEST(Desktop, UndoTakesBackAndTheMarkOfUnsavedGoes) {
  NullDesktop desktop("scenes/start/quarter.json");
  const std::string before = desktop.scene_text();
  ASSERT_TRUE(desktop.editor().submit(command<RenameNode>({"library", "Reading room"})));
  desktop.frames(1);
  EXPECT_EQ(desktop.desktop().title(), "* quarter.json - BehaviourLinks");
  desktop.key(GLFW_KEY_Z, true);
  EXPECT_EQ(desktop.scene_text(), before);
  EXPECT_EQ(desktop.desktop().title(), "quarter.json - BehaviourLinks");
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

}  // namespace
}  // namespace bl::desktop
