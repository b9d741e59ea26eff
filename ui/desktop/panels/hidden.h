// Nodes that the 3D view leaves out: a part of the scene's view, as boxes that are collapsed on the canvas are.
#pragma once

#include <set>
#include <string>

#include "ui/desktop/app/editor.h"

namespace bl::desktop {

/// Those that the scene has; read anew after the view has changed only.
class HiddenNodes {
 public:
  const std::set<std::string>& of(const Editor& editor);
  /// "3 volumes hidden"; empty where none is.
  std::string text(const Editor& editor);

 private:
  std::set<std::string> nodes_;
  std::string read_from_;
};

/// Leaves the chosen nodes out of the 3D view; if all of them are, shows them again.
void hide_chosen(Editor& editor);
void show_all(Editor& editor);
bool are_chosen_hidden(const Editor& editor);
bool has_hidden(const Editor& editor);

}  // namespace bl::desktop
