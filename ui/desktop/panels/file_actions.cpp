// The commands of the menus File, Edit and Help.
#include <GLFW/glfw3.h>

#include "ui/desktop/app/actions.h"
#include "ui/desktop/panels/dialogs.h"

namespace bl::desktop {

void add_file_actions(std::vector<Action>& list) {
  list.push_back({"File", "Quit", {GLFW_KEY_Q, true}, {}, Area::none, nullptr, quit_or_ask});
}

void add_edit_actions(std::vector<Action>& list) {
  list.push_back({"Edit", "Undo", {GLFW_KEY_Z, true}, {}, Area::none, has_document, [](Editor& e) { e.undo(); }, true});
  list.push_back({"Edit", "Redo", {GLFW_KEY_Y, true}, {GLFW_KEY_Z, true, true}, Area::none, has_document,
                  [](Editor& e) { e.redo(); }, true});
}

void add_help_actions(std::vector<Action>&) {}

}  // namespace bl::desktop
