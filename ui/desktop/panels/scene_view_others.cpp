// The others of a room in the 3D view: rings around what they have selected, and their cursors, in their colours.
#include <algorithm>

#include "ui/desktop/panels/scene_view.h"

namespace bl::desktop {

std::optional<Point3> SceneView::cursor() const {
  if (!is_hovered_ || !facts_) return std::nullopt;
  return place_under(ImGui::GetIO().MousePos);
}

void SceneView::draw_others() {
  if (editor_->others.empty()) return;
  const Theme& theme = editor_->theme;
  ImDrawList& list = *ImGui::GetWindowDrawList();
  ImFont* font = theme.fonts().small;
  const auto name_at = [&](const Other& other, ImVec2 at) {
    const ImVec2 extent = font->CalcTextSizeA(font->FontSize, 1e4f, 0, other.name.c_str());
    list.AddRectFilled({at.x - theme.px(3), at.y}, {at.x + extent.x + theme.px(3), at.y + extent.y}, other.colour, theme.px(3));
    list.AddText(font, font->FontSize, at, IM_COL32(255, 255, 255, 255), other.name.c_str());
  };
  for (const Other& other : editor_->others) {
    for (const std::string& id : other.holds) {
      const std::uint32_t node = seen_index(id);
      if (node >= facts_->state->nodes.size()) continue;
      const Seen at = seen(place_of(node));
      if (!at.is_in_front) continue;
      const ImVec2 p = on_screen(at);
      list.AddCircle(p, theme.px(14), other.colour, 32, theme.px(2));
      name_at(other, {p.x + theme.px(12), p.y - theme.px(24)});
    }
    if (!other.cursor) continue;
    const Seen at = seen(*other.cursor);
    if (!at.is_in_front) continue;
    const ImVec2 p = on_screen(at);
    list.AddTriangleFilled(p, {p.x + theme.px(4), p.y + theme.px(13)}, {p.x + theme.px(11), p.y + theme.px(9)}, other.colour);
    name_at(other, {p.x + theme.px(12), p.y + theme.px(10)});
  }
}

}  // namespace bl::desktop
