// Nodes that the 3D view leaves out: a part of the scene's view, as boxes that are collapsed on the canvas are.
#pragma once

#include <set>
#include <string>

#include "ui/desktop/panels/workbench.h"

namespace bl::desktop {

/// Those that the scene has; read anew after the view has changed only.
class HiddenNodes {
 public:
  const std::set<std::string>& of(const Workbench& editor);
  /// "3 volumes hidden"; empty where none is.
  std::string text(const Workbench& editor);

 private:
  std::set<std::string> nodes_;
  std::string read_from_;
};

/// Leaves the chosen nodes out of the 3D view; if all of them are, shows them again.
void hide_chosen(Workbench& editor);
void show_all(Workbench& editor);
bool are_chosen_hidden(const Workbench& editor);
bool has_hidden(const Workbench& editor);

}  // namespace bl::desktop
