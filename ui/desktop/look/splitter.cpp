// A pane as thin as the gap, which follows the mouse.
#include "ui/desktop/look/splitter.h"

#include "ui/desktop/look/buttons.h"
#include "ui/desktop/look/theme.h"

namespace bl::desktop {

float splitter(const char* name, ImVec2 at, ImVec2 size, bool is_upright, const Theme& theme) {
  ImGui::SetNextWindowPos(at);
  ImGui::SetNextWindowSize(size);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 0);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0, 0});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, {1, 1});
  ImGui::PushStyleColor(ImGuiCol_WindowBg, theme.colours().window);
  ImGui::Begin(name, nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                   ImGuiWindowFlags_NoNav | ImGuiWindowFlags_NoFocusOnAppearing);
  ImGui::PopStyleColor();
  ImGui::PopStyleVar(3);
  press_area(name, size);
  const bool is_active = ImGui::IsItemActive(), is_hot = is_active || ImGui::IsItemHovered();
  if (is_hot) {
    ImGui::SetMouseCursor(is_upright ? ImGuiMouseCursor_ResizeEW : ImGuiMouseCursor_ResizeNS);
    ImGui::GetWindowDrawList()->AddRectFilled(at, {at.x + size.x, at.y + size.y}, theme.colours().accent);
  }
  const ImVec2 moved = is_active ? ImGui::GetIO().MouseDelta : ImVec2(0, 0);
  ImGui::End();
  return is_upright ? moved.x : moved.y;
}

}  // namespace bl::desktop
