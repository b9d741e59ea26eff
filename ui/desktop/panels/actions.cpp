// Keys and menus over the declared actions.
#include "ui/desktop/panels/actions.h"

#include <cstring>

#include <GLFW/glfw3.h>
#include <imgui_internal.h>

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
                              {GLFW_KEY_PAGE_UP, "PgUp"},      {GLFW_KEY_PAGE_DOWN, "PgDn"},
                              {GLFW_KEY_MENU, "Menu"}};
  for (const Named& named : kNames)
    if (named.key == key) return named.name;
  if (key >= GLFW_KEY_F1 && key <= GLFW_KEY_F12) return "F" + std::to_string(key - GLFW_KEY_F1 + 1);
  if (key > 32 && key < 127) return std::string(1, static_cast<char>(key));
  return "?";
}

void run(const Action& action, Workbench& editor) {
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

bool has_document(const Workbench& editor) { return editor.document != nullptr; }
bool has_picks(const Workbench& editor) {
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

void run_pressed_actions(Workbench& editor) {
  // The key that closes a menu does nothing else: the menu is gone before this frame has begun.
  const bool is_elsewhere = ImGui::GetIO().WantTextInput || !editor.menu_opening.menu.empty() ||
                            ImGui::IsPopupOpen(nullptr, ImGuiPopupFlags_AnyPopupId | ImGuiPopupFlags_AnyPopupLevel);
  for (const Action& action : actions()) {
    if (is_elsewhere && !action.is_always) continue;
    if (action.area != Area::none && action.area != editor.area) continue;
    if (action.yields_to_fields && editor.area == Area::panels && ImGui::GetIO().NavVisible) continue;
    if (is_pressed(action.chord, action.repeats) || is_pressed(action.other, action.repeats)) run(action, editor);
  }
}

namespace {

bool is_same_text(const char* a, const char* b) { return a == b || (a != nullptr && b != nullptr && std::strcmp(a, b) == 0); }

// Whether a release in this frame is that of the press which has opened the menu where the mouse is.
bool is_opening_release(const MenuOpening& opening) {
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  const float far = ImGui::GetTextLineHeightWithSpacing(), x = mouse.x - opening.x, y = mouse.y - opening.y;
  return opening.is_held && ImGui::IsMouseReleased(0) && x * x + y * y < far * far;
}

// Walks along the menus of the bar; those of one menu, and of one submenu, stand together in the list of actions.
class MenuBar {
 public:
  explicit MenuBar(Workbench& editor) : editor_(&editor), is_deaf_(is_opening_release(editor.menu_opening)) {}

  void draw(const Action& action) {
    const bool is_same_menu = is_same_text(menu_, action.menu),
               is_same_submenu = is_same_menu && is_same_text(submenu_, action.submenu);
    if (!is_same_submenu) close_submenu();
    if (!is_same_menu) {
      close_menu();
      menu_ = action.menu;
      is_open_ = ImGui::BeginMenu(menu_);
      if (is_open_) note_open(menu_);
    }
    if (!is_open_) return;
    const bool is_seen = !is_same_submenu || submenu_ == nullptr || is_submenu_open_;
    if (is_same_menu && action.begins_group && is_seen) ImGui::Separator();
    if (!is_same_submenu && action.submenu != nullptr) {
      submenu_ = action.submenu;
      is_submenu_open_ = ImGui::BeginMenu(submenu_);
      if (is_submenu_open_) note_open(std::string(menu_) + "/" + submenu_);
    }
    if (submenu_ == nullptr || is_submenu_open_) draw_item(action);
  }

  void end() {
    close_submenu();
    close_menu();
    MenuOpening& opening = editor_->menu_opening;
    const bool is_down = ImGui::IsMouseDown(0) || ImGui::IsMouseReleased(0);
    if (opening.menu != open_) opening = {open_, ImGui::GetIO().MousePos.x, ImGui::GetIO().MousePos.y, is_down && !open_.empty()};
    if (!ImGui::IsMouseDown(0) && !is_newly_open_) opening.is_held = false;
  }

 private:
  void note_open(std::string path) {
    open_ = std::move(path);
    is_newly_open_ = open_ != editor_->menu_opening.menu;
  }
  void close_submenu() {
    if (submenu_ != nullptr && is_submenu_open_) ImGui::EndMenu();
    submenu_ = nullptr;
    is_submenu_open_ = false;
  }
  void close_menu() {
    if (is_open_) ImGui::EndMenu();
    is_open_ = false;
  }
  void draw_item(const Action& action) {
    const bool is_possible = action.can == nullptr || action.can(*editor_);
    const bool is_on = action.is_on != nullptr && action.is_on(*editor_);
    ImGui::PushItemFlag(ImGuiItemFlags_SelectableDontClosePopup, is_deaf_);
    const bool is_taken = ImGui::MenuItem(action.label, text_of(action.chord).c_str(), is_on, is_possible);
    ImGui::PopItemFlag();
    if (is_taken && !is_deaf_) action.run(*editor_);
  }

  Workbench* editor_;
  bool is_deaf_;
  const char *menu_ = nullptr, *submenu_ = nullptr;
  bool is_open_ = false, is_submenu_open_ = false, is_newly_open_ = false;
  std::string open_;  // the innermost menu that is open in this frame
};

}  // namespace

void draw_menus(Workbench& editor) {
  MenuBar bar(editor);
  for (const Action& action : actions()) bar.draw(action);
  bar.end();
}

}  // namespace bl::desktop
