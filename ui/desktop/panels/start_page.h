// The page where no scene is open: what to do first, recent files, and the shipped scenes as pictures.
#pragma once

#include <memory>

#include "ui/desktop/panels/scene_pictures.h"
#include "ui/desktop/panels/workbench.h"

namespace bl::desktop {

class StartPage {
 public:
  explicit StartPage(Workbench& editor) : editor_(&editor) {}
  void draw();
  /// Pictures are made only while the page is looked at.
  void leave() { pictures_.reset(); }

 private:
  void draw_beginnings(float width);
  void draw_shipped();
  bool draw_card(const ScenePicture& picture, float width);

  Workbench* editor_;
  std::unique_ptr<ScenePictures> pictures_;
};

}  // namespace bl::desktop
