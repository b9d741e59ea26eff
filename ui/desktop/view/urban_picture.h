// Adds the city around the volumes to a picture: lines, surfaces and bodies as plain data, and the legends that explain them.
#pragma once

#include <functional>
#include <vector>

#include "ui/desktop/app/editor.h"
#include "ui/desktop/view/colouring.h"
#include "ui/desktop/view/scene_facts.h"
#include "ui/desktop/view/view_scene.h"

namespace bl::desktop {

/// `shows`: is that layer on?
void add_urban(const SceneFacts& facts, const Picks& picks, const Theme& theme, const std::function<bool(const char*)>& shows,
               ViewScene& scene);
/// One for each kind of thing whose colours stand for numbers, as far as it is shown.
std::vector<Legend> urban_legends(const SceneFacts& facts, const Theme& theme, const std::function<bool(const char*)>& shows);

}  // namespace bl::desktop
