// The node canvas: entities as boxes, links between their bodies, wired by hand.
#pragma once

#include "ui/desktop/app/editor.h"

namespace bl::desktop {

class Canvas {
 public:
  explicit Canvas(Editor& editor) : editor_(&editor) {}
  /// Fills the current pane, of `size` pixels.
  void draw(ImVec2 size);
  /// Brings everything, or what is chosen, into sight.
  void fit(bool all);

 private:
  Editor* editor_;
};

}  // namespace bl::desktop
