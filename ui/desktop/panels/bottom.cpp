// The tabs below canvas and 3D view.
#include "ui/desktop/panels/panels.h"

namespace bl::desktop {

void draw_bottom(Editor& editor) {
  if (!ImGui::BeginTabBar("bottom")) return;
  if (ImGui::BeginTabItem("Problems")) {
    draw_problems(editor);
    ImGui::EndTabItem();
  }
  if (ImGui::BeginTabItem("Statistics")) {
    draw_statistics(editor);
    ImGui::EndTabItem();
  }
  if (ImGui::BeginTabItem("History")) {
    draw_history(editor);
    ImGui::EndTabItem();
  }
  ImGui::EndTabBar();
}

void draw_problems(Editor&) {}
void draw_statistics(Editor&) {}
void draw_history(Editor&) {}

}  // namespace bl::desktop
