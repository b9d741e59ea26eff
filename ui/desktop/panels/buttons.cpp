// The look of the buttons that dialogs share.
#include "ui/desktop/panels/buttons.h"

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

}  // namespace bl::desktop
