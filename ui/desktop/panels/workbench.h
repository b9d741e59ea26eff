// What panels share besides the editor: the other panels, for actions that concern them.
#pragma once

#include <memory>
#include <string>

#include "ui/desktop/document/hosting.h"
#include "ui/desktop/editor/editor.h"

namespace bl::desktop {

class Canvas;
class Dialogs;
class SceneView;

/// How a menu of the menu bar was opened.
struct MenuOpening {
  std::string menu;      ///< the innermost that is open; empty: none
  float x = 0, y = 0;    ///< where the mouse was then
  bool is_held = false;  ///< by a press whose release has not been seen yet
};

/// The editor with its panels. Each pointer is there while the window has that panel; tests may have none of them.
class Workbench : public Editor {
 public:
  using Editor::Editor;

  Canvas* canvas = nullptr;
  SceneView* view = nullptr;
  Dialogs* dialogs = nullptr;
  MenuOpening menu_opening;
  std::unique_ptr<Hosting> hosting;  ///< the room of the document, where this window has opened it
  std::string server_program;        ///< the program that serves rooms; empty: the one beside this one

  /// Saves the document with the places of all boxes that people have seen since they changed something.
  Result<void> save(const std::string& path);
};

}  // namespace bl::desktop
