// The bar between two panes that people drag.
#pragma once

#include <imgui.h>

namespace bl::desktop {

class Theme;

/// How far it was dragged in this frame [pixels]; `is_upright`: it moves sideways.
float splitter(const char* name, ImVec2 at, ImVec2 size, bool is_upright, const Theme& theme);

}  // namespace bl::desktop
