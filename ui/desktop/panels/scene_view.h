// The 3D view as a panel: camera, picking, gizmo, labels and the card of the nearest node.
#pragma once

#include "ui/desktop/app/editor.h"
#include "ui/desktop/view/renderer.h"

namespace bl::desktop {

class SceneView {
 public:
  SceneView(Editor& editor, Renderer& renderer) : editor_(&editor), renderer_(&renderer) {}
  /// Fills the current pane, of `size` pixels.
  void draw(ImVec2 size);
  void fit(bool all);

 private:
  Editor* editor_;
  Renderer* renderer_;
};

}  // namespace bl::desktop
