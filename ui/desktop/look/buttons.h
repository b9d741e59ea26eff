// Buttons that panes and dialogs share.
#pragma once

#include <imgui.h>

#include "ui/desktop/look/theme.h"

namespace bl::desktop {

/// The button that a dialog is there for, in the colour of the accent.
bool chief_button(const Theme& theme, const char* label, ImVec2 size);

/// A place to press, without a look of its own. A pane may be too narrow for it: then it has a pixel.
bool press_area(const char* id, ImVec2 size, ImGuiButtonFlags flags = ImGuiButtonFlags_None);

}  // namespace bl::desktop
