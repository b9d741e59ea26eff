// Draws the canvas and answers to the mouse.
#include "ui/desktop/panels/canvas/canvas.h"

namespace bl::desktop {

void Canvas::draw(ImVec2) {
  if (ImGui::IsWindowHovered()) editor_->area = Area::canvas;
}

void Canvas::fit(bool) {}

}  // namespace bl::desktop
