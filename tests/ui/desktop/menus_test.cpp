// The menu bar: it fits the window, and no menu acts on the release that opened it.
#include <imgui_internal.h>

#include <GLFW/glfw3.h>
#include <gtest/gtest.h>

#include "tests/ui/desktop/null_desktop.h"
#include "ui/desktop/panels/actions.h"

namespace bl::desktop {
namespace {

std::vector<std::string> menu_names() {
  std::vector<std::string> names;
  for (const Action& action : actions())
    if (names.empty() || names.back() != action.menu) names.push_back(action.menu);
  return names;
}

ImVec2 beside(ImVec2 at, float x, float y) { return {at.x + x, at.y + y}; }

ImGuiWindow* open_menu_window(int depth = 0) {
  char name[32];
  std::snprintf(name, sizeof(name), "##Menu_%02d", depth);
  ImGuiWindow* window = ImGui::FindWindowByName(name);
  return window != nullptr && window->Active ? window : nullptr;
}

class Menus : public ::testing::Test {
 protected:
  void open(ImVec2 size) {
    desktop = nullptr;  // one context at a time
    desktop = std::make_unique<NullDesktop>("scenes/start/quarter.json", size);
    desktop->editor().picks.only_node("library");
    desktop->frames(2);
  }
  // The middle of a menu's title: titles stand beside each other from the left edge on.
  ImVec2 title(const std::string& wanted) {
    const ImGuiStyle& style = ImGui::GetStyle();
    float x = style.FramePadding.x;
    for (const std::string& name : menu_names()) {
      const float width = ImGui::CalcTextSize(name.c_str()).x + 2 * style.ItemSpacing.x;
      if (name == wanted) return {x + width / 2, 10};
      x += width;
    }
    return {-1, -1};
  }
  // All that an action could change.
  std::string standing() {
    Workbench& e = desktop->editor();
    const PersonSettings& p = e.person;
    std::string text = desktop->scene_text() + (e.is_beamer ? " beamer" : "") + (e.wants_quit ? " quit" : "") +
                       (e.wants_picture ? " picture" : "") + (p.is_dark ? " dark" : " light") + std::to_string(p.scale) +
                       p.navigation + (p.shows_side ? " side" : "") + (p.shows_bottom ? " bottom" : "") +
                       std::to_string(e.picks.nodes.size()) + std::to_string(e.document->history().size()) +
                       (e.moment->is_playing ? " plays" : "") + std::to_string(e.moment->wanted_rate);
    for (const auto& [layer, is_on] : p.layers) text += layer + (is_on ? "+" : "-");
    return text;
  }

  std::unique_ptr<NullDesktop> desktop;
};

TEST_F(Menus, NoneActsOnTheReleaseThatOpenedIt) {
  for (const ImVec2 size : {ImVec2(1280, 720), ImVec2(1600, 1000), ImVec2(900, 300), ImVec2(640, 200)}) {
    open(size);
    const std::string before = standing();
    for (const std::string& name : menu_names()) {
      desktop->move_to(title(name));
      desktop->press();
      EXPECT_NE(open_menu_window(), nullptr) << name << " does not open";
      desktop->frames(24);  // a calm finger
      desktop->release();
      EXPECT_EQ(standing(), before) << name << " in " << size.x << " x " << size.y;
      EXPECT_NE(open_menu_window(), nullptr) << name << " stays open";
      desktop->key(GLFW_KEY_ESCAPE);
      desktop->frames(2);
      ASSERT_EQ(open_menu_window(), nullptr);
      ASSERT_EQ(standing(), before) << name << " in " << size.x << " x " << size.y;
    }
  }
}

TEST_F(Menus, AClickOnAnEntryActsAndSoDoesADragToIt) {
  open({1280, 720});
  Workbench& editor = desktop->editor();
  ASSERT_FALSE(editor.is_beamer);
  desktop->click(title("View"));
  ASSERT_NE(open_menu_window(), nullptr);
  const ImVec2 first = beside(open_menu_window()->Pos, 40, ImGui::GetStyle().WindowPadding.y + 6);
  desktop->click(first);
  EXPECT_TRUE(editor.is_beamer) << "the first entry was clicked";
  desktop->key(GLFW_KEY_F1);
  ASSERT_FALSE(editor.is_beamer);
  desktop->drag(title("View"), first);
  EXPECT_TRUE(editor.is_beamer) << "who presses, goes on to the entry and lets go means it";
}

TEST_F(Menus, EachFitsAnOrdinaryWindowBelowTheBar) {
  open({1280, 720});
  for (const std::string& name : menu_names()) {
    desktop->click(title(name));
    const ImGuiWindow* menu = open_menu_window();
    ASSERT_NE(menu, nullptr) << name;
    EXPECT_GE(menu->Pos.y, 12) << name << " lies over the bar";
    EXPECT_LE(menu->Pos.y + menu->Size.y, 720) << name;
    desktop->key(GLFW_KEY_ESCAPE);
    desktop->frames(2);
  }
}

TEST_F(Menus, SubmenusHoldWhatBelongsTogether) {
  open({1280, 720});
  std::map<std::string, int> counts;
  std::map<std::string, int> runs;  // entries of one submenu stand together: else it would open twice
  const char* last = nullptr;
  for (const Action& action : actions()) {
    if (action.submenu != nullptr) {
      ++counts[action.submenu];
      if (last == nullptr || std::string(last) != action.submenu) ++runs[action.submenu];
    }
    last = action.submenu;
  }
  for (const char* name : {"Layers", "Mouse", "Scale", "Sun", "Kept views", "Align", "Zoom", "Go"}) {
    EXPECT_GE(counts[name], 3) << name;
    EXPECT_EQ(runs[name], 1) << name;
  }
  // Opened by resting the mouse on it, an entry of it acts.
  desktop->click(title("View"));
  const ImGuiWindow* menu = open_menu_window();
  ASSERT_NE(menu, nullptr);
  const ImVec2 corner = menu->Pos;
  const float right = menu->Size.x;
  const std::string before = standing();
  for (float y = 12; y < menu->Size.y && open_menu_window(1) == nullptr; y += 10) {
    desktop->move_to(beside(corner, right / 2, y));
    desktop->frames(30);
  }
  const ImGuiWindow* submenu = open_menu_window(1);
  ASSERT_NE(submenu, nullptr);
  EXPECT_EQ(standing(), before);
  desktop->click(beside(submenu->Pos, 40, ImGui::GetStyle().WindowPadding.y + 30));
  EXPECT_NE(standing(), before) << "the second entry of the submenu";
}

}  // namespace
}  // namespace bl::desktop
