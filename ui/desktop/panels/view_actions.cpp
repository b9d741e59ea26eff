// The commands of the 3D view and of the panes.
#include <GLFW/glfw3.h>

#include "ui/desktop/app/actions.h"
#include "ui/desktop/panels/scene_view.h"

namespace bl::desktop {

void add_view_actions(std::vector<Action>& list) {
  list.push_back({"View", "Frame selection, or all", {GLFW_KEY_F}, {}, Area::view, has_document,
                  [](Editor& e) { e.view->fit(false); }});
}

}  // namespace bl::desktop
