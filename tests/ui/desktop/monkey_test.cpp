// Random input, as a cat on the desk would give it: the window survives, and what was done can be undone.
#include <cstdlib>
#include <filesystem>
#include <string>

#include <GLFW/glfw3.h>
#include <gtest/gtest.h>

#include "core/base/random.h"
#include "core/file/file_io.h"
#include "tests/support/place/source_folder.h"
#include "tests/support/world.h"
#include "tests/ui/desktop/null_desktop.h"
#include "ui/desktop/panels/dialogs.h"

namespace bl::desktop {
namespace {

// Frames of input; BL_MONKEY_FRAMES sets another number for long runs by hand.
int frame_count() {
  const char* wanted = std::getenv("BL_MONKEY_FRAMES");
  return wanted != nullptr ? std::atoi(wanted) : 4000;
}

class PanelMonkey {
 public:
  PanelMonkey(NullDesktop& desktop, std::uint64_t seed) : desktop_(desktop), random_(seed, 77) {}

  void act() {
    ImGuiIO& io = ImGui::GetIO();
    switch (random_.below(12)) {
      case 0: io.MouseDown[random_.below(3)] ^= true; break;
      case 1: io.MouseWheel = static_cast<float>(random_.uniform(-3, 3)); break;
      case 2: tap(); break;
      case 3: desktop_.hold(random_.below(4) == 0, random_.below(4) == 0, random_.below(8) == 0); break;
      case 4: io.AddInputCharacter(static_cast<unsigned>(32 + random_.below(95))); break;
      case 5: io.MousePos = {coordinate(io.DisplaySize.x), coordinate(io.DisplaySize.y)}; break;
      case 6:
        desktop_.click({coordinate(io.DisplaySize.x), coordinate(io.DisplaySize.y)}, static_cast<int>(random_.below(2)));
        break;
      case 7:
        if (random_.below(40) == 0) io.DisplaySize = {coordinate(1900) + 20, coordinate(1200) + 20};
        break;
      default:
        io.MousePos.x += static_cast<float>(random_.uniform(-40, 40));
        io.MousePos.y += static_cast<float>(random_.uniform(-40, 40));
    }
    desktop_.frames(1);
    stay_inside();
  }

 private:
  float coordinate(float most) { return static_cast<float>(random_.uniform()) * most; }

  void tap() {
    constexpr int kKeys[] = {GLFW_KEY_TAB,  GLFW_KEY_SPACE, GLFW_KEY_ENTER, GLFW_KEY_ESCAPE, GLFW_KEY_DELETE, GLFW_KEY_BACKSPACE,
                             GLFW_KEY_LEFT, GLFW_KEY_RIGHT, GLFW_KEY_UP,    GLFW_KEY_DOWN,   GLFW_KEY_HOME,   GLFW_KEY_F1};
    const std::uint64_t k = random_.below(12 + 36);
    const int key = k < 12 ? kKeys[k] : k < 38 ? GLFW_KEY_A + static_cast<int>(k - 12) : GLFW_KEY_0 + static_cast<int>(k - 38);
    const bool ctrl = random_.below(3) == 0;
    desktop_.key(key, ctrl, random_.below(4) == 0, random_.below(6) == 0);
  }

  // A monkey must neither leave nor reach the disk beyond its folder.
  void stay_inside() {
    desktop_.editor().wants_quit = false;
    if (desktop_.editor().dialogs->is_choosing_file()) desktop_.key(GLFW_KEY_ESCAPE);
    if (!desktop_.editor().document && !desktop_.editor().open(scene_)) ADD_FAILURE() << "the scene no longer opens";
  }

 public:
  std::string scene_;

 private:
  NullDesktop& desktop_;
  Random random_;
};

class MonkeyRun : public ::testing::TestWithParam<const char*> {};

TEST_P(MonkeyRun, SurvivesAndCanBeUndone) {
  // It plays with a copy: a key may well save.
  const std::filesystem::path folder = std::filesystem::path(::testing::TempDir()) / "monkey";
  std::filesystem::create_directories(folder);
  const std::filesystem::path scene = folder / std::filesystem::path(GetParam()).filename();
  std::filesystem::copy_file(test::source_folder() + "/" + GetParam(), scene, std::filesystem::copy_options::overwrite_existing);
  NullDesktop desktop;
  ASSERT_TRUE(desktop.editor().open(scene.string()));
  desktop.frames(2);
  PanelMonkey monkey(desktop, 5);
  monkey.scene_ = scene.string();
  for (int k = 0; k < frame_count(); ++k) {
    monkey.act();
    if (HasFatalFailure()) return;
  }
  ImGui::GetIO().MouseDown[0] = ImGui::GetIO().MouseDown[1] = ImGui::GetIO().MouseDown[2] = false;
  desktop.frames(2);
  while (desktop.editor().document->session().undo().ok()) {}
  desktop.frames(2);
  const SceneReading saved = read_scene(read_file(scene.string()).value(), full_registry());
  EXPECT_TRUE(saved.is_usable());
}

INSTANTIATE_TEST_SUITE_P(Scenes, MonkeyRun, ::testing::Values("scenes/start/quarter.json", "scenes/studies/sixty_volumes.json"));

}  // namespace
}  // namespace bl::desktop
