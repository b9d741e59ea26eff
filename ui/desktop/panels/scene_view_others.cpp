// The others of a room in the 3D view: rings around what they have selected, and their cursors, in their colours.
#include <algorithm>

#include "core/guest/room_guest.h"
#include "core/reading/figures.h"
#include "ui/desktop/panels/inspector_cell.h"
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

// Whoever changes something has to see that it is not the scene of all.
void SceneView::draw_draft_banner() {
  const guest::RoomGuest* room = editor_->document->room();
  if (room == nullptr || room->draft() == nullptr) return;
  const guest::DraftWork& draft = *room->draft();
  const std::string words = "Your draft" + (draft.title().empty() ? std::string() : ": " + draft.title()) + ", " +
                            reading::counted(draft.step_count(), "change") + ". Nobody else sees it.";
  const Theme& theme = editor_->theme;
  ImFont* font = theme.fonts().strong;
  const ImVec2 extent = font->CalcTextSizeA(font->FontSize, 1e4f, 0, words.c_str());
  const ImVec2 corner{at_.x + std::max(theme.px(8), (size_.x - extent.x) / 2), at_.y + theme.px(10)};
  const ImVec2 low{corner.x - theme.px(10), corner.y - theme.px(4)};
  const ImVec2 high{corner.x + extent.x + theme.px(10), corner.y + extent.y + theme.px(4)};
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddRectFilled(low, high, theme.colours().accent, theme.px(6));
  list.AddText(font, font->FontSize, corner, theme.colours().on_accent, words.c_str());
  list.AddRect({at_.x + 1, at_.y + 1}, {at_.x + size_.x - 1, at_.y + size_.y - 1}, theme.colours().accent, 0, 0, theme.px(2));
  note_area(*editor_, "view/draft", low, high);
}

}  // namespace bl::desktop
