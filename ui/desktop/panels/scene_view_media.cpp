// What is to be said beside pictures in the 3D view: the name of a file that is missing, and why a picture is veiled.
#include "ui/desktop/panels/scene_view.h"

namespace bl::desktop {

void SceneView::draw_media_notes() {
  if (!shows("media")) return;
  const Theme& theme = editor_->theme;
  const Colours& c = theme.colours();
  ImDrawList& list = *ImGui::GetWindowDrawList();
  ImFont* font = theme.fonts().small;
  for (const MediaFacts& media : facts_->media) {
    const std::string path = media.file.front() == '/' || choices_.folder.empty() ? media.file : choices_.folder + "/" + media.file;
    const std::string missing = renderer_->why_missing(path);
    const std::string text = missing.empty() ? media.message : media.file + ": " + missing;
    if (text.empty()) continue;
    const Seen at = seen(media.picture.middle());
    if (!at.is_in_front || at.x < 0 || at.y < 0 || at.x > width() || at.y > height()) continue;
    const float most = theme.px(190);
    const ImVec2 extent = font->CalcTextSizeA(font->FontSize, 1e4f, most, text.c_str()), middle = on_screen(at);
    const ImVec2 low{middle.x - extent.x / 2, middle.y - extent.y / 2}, pad{theme.px(6), theme.px(4)};
    list.AddRectFilled({low.x - pad.x, low.y - pad.y}, {low.x + extent.x + pad.x, low.y + extent.y + pad.y}, faded(c.raised, 0.86f),
                       theme.px(4));
    list.AddText(font, font->FontSize, low, missing.empty() ? c.text : c.warning, text.c_str(), nullptr, most);
  }
}

}  // namespace bl::desktop
