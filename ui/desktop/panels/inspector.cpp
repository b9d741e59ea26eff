// What is chosen, with all of its ports.
#include "ui/desktop/panels/panels.h"

namespace bl::desktop {

void draw_inspector(Editor&) {}

}  // namespace bl::desktop
