// Draws the 3D view and answers to the mouse.
#include "ui/desktop/panels/scene_view.h"

namespace bl::desktop {

void SceneView::draw(ImVec2) {
  if (ImGui::IsWindowHovered()) editor_->area = Area::view;
}

void SceneView::fit(bool) {}

}  // namespace bl::desktop
