// Buttons that panes and dialogs share.
#pragma once

#include <imgui.h>

#include "ui/desktop/look/theme.h"

namespace bl::desktop {

/// The main button of a dialog, in the accent colour.
bool chief_button(const Theme& theme, const char* label, ImVec2 size);

/// An area that can be pressed and draws nothing. In a pane that is too narrow it is one pixel wide.
bool press_area(const char* id, ImVec2 size, ImGuiButtonFlags flags = ImGuiButtonFlags_None);

}  // namespace bl::desktop
