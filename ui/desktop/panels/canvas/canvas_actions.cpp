// The commands of the node canvas.
#include <GLFW/glfw3.h>

#include "ui/desktop/app/actions.h"
#include "ui/desktop/panels/canvas/canvas.h"

namespace bl::desktop {

void add_canvas_actions(std::vector<Action>& list) {
  list.push_back({"Canvas", "Fit selection, or all", {GLFW_KEY_F}, {}, Area::canvas, has_document,
                  [](Editor& e) { e.canvas->fit(false); }});
  list.push_back({"Canvas", "Fit all", {GLFW_KEY_HOME}, {}, Area::canvas, has_document, [](Editor& e) { e.canvas->fit(true); }});
}

}  // namespace bl::desktop
