// The look of the buttons that panes and dialogs share.
#include "ui/desktop/look/buttons.h"

#include <algorithm>

namespace bl::desktop {

bool chief_button(const Theme& theme, const char* label, ImVec2 size) {
  const Colours& c = theme.colours();
  ImGui::PushStyleColor(ImGuiCol_Button, faded(c.accent, 0.85f));
  ImGui::PushStyleColor(ImGuiCol_ButtonHovered, c.accent);
  ImGui::PushStyleColor(ImGuiCol_ButtonActive, faded(c.accent, 0.7f));
  ImGui::PushStyleColor(ImGuiCol_Text, c.window);
  const bool is_pressed = ImGui::Button(label, size);
  ImGui::PopStyleColor(4);
  return is_pressed;
}

bool press_area(const char* id, ImVec2 size, ImGuiButtonFlags flags) {
  return ImGui::InvisibleButton(id, {std::max(1.0f, size.x), std::max(1.0f, size.y)}, flags);
}

}  // namespace bl::desktop
