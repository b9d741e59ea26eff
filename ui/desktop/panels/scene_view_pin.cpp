// A pin at a place where no node stands: something that was skipped lies there.
#include <cmath>

#include "ui/desktop/panels/scene_view.h"

namespace bl::desktop {

void SceneView::draw_pin() {
  if (!pin_) return;
  const bool is_asked_away = ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape), false) && !ImGui::GetIO().WantTextInput;
  if (is_asked_away || editor_->picks.nodes != chosen_at_pin_) return drop_pin();
  const Seen at = seen(pin_->place);
  if (!at.is_in_front) return;
  const Theme& theme = editor_->theme;
  const Colours& c = theme.colours();
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const ImVec2 foot = on_screen(at), head{foot.x, foot.y - theme.px(34)};
  const float r = theme.px(9);
  list.AddCircleFilled(foot, theme.px(3.5f), faded(c.text, 0.35f), 16);
  list.AddTriangleFilled({head.x - 0.72f * r, head.y + 0.7f * r}, {head.x + 0.72f * r, head.y + 0.7f * r}, foot, c.warning);
  list.AddCircleFilled(head, r, c.warning, 24);
  list.AddCircleFilled(head, 0.42f * r, c.panel, 16);
  const float most = std::min(theme.px(300), width() - theme.px(24));
  const ImVec2 extent = ImGui::CalcTextSize(pin_->text.c_str(), nullptr, false, most), pad{theme.px(8), theme.px(5)};
  // Inside the view, whichever side of the pin that is.
  const float left = std::clamp(head.x + theme.px(16), at_.x + theme.px(8),
                                std::max(at_.x + theme.px(8), at_.x + width() - extent.x - 3 * pad.x));
  const float top = head.y - extent.y - theme.px(14);
  list.AddRectFilled({left, top}, {left + extent.x + 2 * pad.x, top + extent.y + 2 * pad.y}, faded(c.raised, 0.95f), theme.px(5));
  list.AddRect({left, top}, {left + extent.x + 2 * pad.x, top + extent.y + 2 * pad.y}, c.warning, theme.px(5));
  list.AddText(ImGui::GetFont(), ImGui::GetFontSize(), {left + pad.x, top + pad.y}, c.text, pin_->text.c_str(), nullptr, most);
}

}  // namespace bl::desktop
