// Buttons that dialogs share.
#pragma once

#include <imgui.h>

#include "ui/desktop/app/theme.h"

namespace bl::desktop {

/// The button that a dialog is there for, in the colour of the accent.
bool chief_button(const Theme& theme, const char* label, ImVec2 size);

}  // namespace bl::desktop
