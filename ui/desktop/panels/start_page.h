// The page where no scene is open: what to do first, recent files, and the shipped scenes as pictures.
#pragma once

#include <memory>

#include "ui/desktop/app/editor.h"
#include "ui/desktop/panels/scene_pictures.h"

namespace bl::desktop {

class StartPage {
 public:
  explicit StartPage(Editor& editor) : editor_(&editor) {}
  void draw();
  /// Pictures are made only while the page is looked at.
  void leave() { pictures_.reset(); }

 private:
  void draw_beginnings(float width);
  void draw_shipped();
  bool draw_card(const ScenePicture& picture, float width);

  Editor* editor_;
  std::unique_ptr<ScenePictures> pictures_;
};

}  // namespace bl::desktop
