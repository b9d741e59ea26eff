// Windows over the window.
#include "ui/desktop/panels/dialogs.h"

namespace bl::desktop {

void draw_dialogs(Editor&) {}
void open_or_ask(Editor& editor, const std::string& path) { editor.open(path); }
void quit_or_ask(Editor& editor) { editor.wants_quit = true; }

}  // namespace bl::desktop
