// Adds the city around the volumes to a picture: lines, surfaces and bodies as plain data, and the legends that explain them.
#pragma once

#include <functional>
#include <vector>

#include "ui/desktop/editor/editor.h"
#include "ui/desktop/view/colouring.h"
#include "ui/desktop/view/view_builder.h"

namespace bl::desktop {

/// `shows`: is that layer on?
void add_urban(const SceneFacts& facts, const ViewChoices& choices, const Picks& picks, const Theme& theme,
               const std::function<bool(const char*)>& shows, ViewScene& scene);
/// One for each kind of thing whose colours stand for numbers, as far as it is shown.
std::vector<Legend> urban_legends(const SceneFacts& facts, const ViewChoices& choices, const Theme& theme,
                                  const std::function<bool(const char*)>& shows);

/// Of the isochrones that are shown; empty where there are none. Apart from the others, since it comes and goes with what is
/// chosen.
Legend isochrone_legend(const SceneFacts& facts, const Isochrones* shown, const Theme& theme);

}  // namespace bl::desktop
