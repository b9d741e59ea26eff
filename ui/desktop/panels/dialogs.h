// Windows over the window: files, a new scene, the command palette, the list of keys, questions before something is lost.
#pragma once

#include <string>

#include "ui/desktop/app/editor.h"

namespace bl::desktop {

/// Draws whichever dialog is open; `editor.open_panel` opens one by name.
void draw_dialogs(Editor& editor);
/// Opens a scene, after asking what is to become of unsaved changes.
void open_or_ask(Editor& editor, const std::string& path);
void quit_or_ask(Editor& editor);

}  // namespace bl::desktop
