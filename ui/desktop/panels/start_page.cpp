// The page before a scene is open.
#include "ui/desktop/panels/panels.h"

namespace bl::desktop {

void draw_start_page(Editor&) {}

}  // namespace bl::desktop
