// Keys and menus over the declared actions.
#include "ui/desktop/app/actions.h"

#include <cstring>

#include <GLFW/glfw3.h>

namespace bl::desktop {

namespace {

std::string name_of_key(int key) {
  struct Named {
    int key;
    const char* name;
  };
  constexpr Named kNames[] = {{GLFW_KEY_SPACE, "Space"},       {GLFW_KEY_TAB, "Tab"},
                              {GLFW_KEY_ENTER, "Enter"},       {GLFW_KEY_ESCAPE, "Esc"},
                              {GLFW_KEY_DELETE, "Del"},        {GLFW_KEY_BACKSPACE, "Backspace"},
                              {GLFW_KEY_HOME, "Home"},         {GLFW_KEY_LEFT, "Left"},
                              {GLFW_KEY_RIGHT, "Right"},       {GLFW_KEY_UP, "Up"},
                              {GLFW_KEY_DOWN, "Down"},         {GLFW_KEY_KP_ADD, "Num +"},
                              {GLFW_KEY_KP_SUBTRACT, "Num -"}, {GLFW_KEY_KP_DECIMAL, "Num ."},
                              {GLFW_KEY_MENU, "Menu"}};
  for (const Named& named : kNames)
    if (named.key == key) return named.name;
  if (key >= GLFW_KEY_F1 && key <= GLFW_KEY_F12) return "F" + std::to_string(key - GLFW_KEY_F1 + 1);
  if (key > 32 && key < 127) return std::string(1, static_cast<char>(key));
  return "?";
}

void run(const Action& action, Editor& editor) {
  if (action.can == nullptr || action.can(editor)) action.run(editor);
}

}  // namespace

std::string text_of(const Chord& chord) {
  if (chord.key == 0) return "";
  return std::string(chord.ctrl ? "Ctrl+" : "") + (chord.shift ? "Shift+" : "") + (chord.alt ? "Alt+" : "") +
         name_of_key(chord.key);
}

bool is_pressed(const Chord& chord, bool repeats) {
  const ImGuiIO& io = ImGui::GetIO();
  return chord.key != 0 && io.KeyCtrl == chord.ctrl && io.KeyShift == chord.shift && io.KeyAlt == chord.alt &&
         ImGui::IsKeyPressed(chord.key, repeats);
}

bool has_document(const Editor& editor) { return editor.document != nullptr; }
bool has_picks(const Editor& editor) {
  return has_document(editor) && (!editor.picks.nodes.empty() || !editor.picks.links.empty());
}

std::span<const Action> actions() {
  static const std::vector<Action> all = [] {
    std::vector<Action> list;
    add_file_actions(list);
    add_edit_actions(list);
    add_canvas_actions(list);
    add_view_actions(list);
    add_clock_actions(list);
    add_help_actions(list);
    return list;
  }();
  return all;
}

void run_pressed_actions(Editor& editor) {
  const bool is_elsewhere =
      ImGui::GetIO().WantTextInput || ImGui::IsPopupOpen(nullptr, ImGuiPopupFlags_AnyPopupId | ImGuiPopupFlags_AnyPopupLevel);
  for (const Action& action : actions()) {
    if (is_elsewhere && !action.is_always) continue;
    if (action.area != Area::none && action.area != editor.area) continue;
    if (is_pressed(action.chord, action.repeats) || is_pressed(action.other, action.repeats)) run(action, editor);
  }
}

void draw_menus(Editor& editor) {
  const char* menu = nullptr;
  bool is_open = false;
  for (const Action& action : actions()) {
    const bool is_same_menu = menu != nullptr && std::strcmp(menu, action.menu) == 0;
    if (menu == nullptr || std::strcmp(menu, action.menu) != 0) {
      if (is_open) ImGui::EndMenu();
      menu = action.menu;
      is_open = ImGui::BeginMenu(menu);
    }
    if (!is_open) continue;
    if (is_same_menu && action.begins_group) ImGui::Separator();
    const bool is_possible = action.can == nullptr || action.can(editor);
    const bool is_on = action.is_on != nullptr && action.is_on(editor);
    if (ImGui::MenuItem(action.label, text_of(action.chord).c_str(), is_on, is_possible)) action.run(editor);
  }
  if (is_open) ImGui::EndMenu();
}

}  // namespace bl::desktop
