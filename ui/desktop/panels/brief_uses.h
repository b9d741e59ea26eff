// The uses of a scene's briefs: the choices for the use of a volume, and the use of a new volume.
#pragma once

#include <string>
#include <vector>

#include "ui/desktop/panels/workbench.h"

namespace bl::desktop {

/// Those of the briefs in their order without open space, then those that volumes have besides, by name; each once.
std::vector<std::string> known_uses(const Scene& scene);
/// The uses of the briefs, with the largest missing floor area first.
std::vector<std::string> uses_by_need(Workbench& editor);
/// The first values of a new role as JSON. A SmartVolume gets a use, so that the brief has no error; it gets no size, which would
/// be a proposal against the brief. `number`: its number among the nodes of the same step.
std::string first_values(Workbench& editor, const std::string& type, std::size_t number = 0);

/// The notice which uses nodes got by `first_values`, since people were not asked; nothing where none got one.
void tell_uses(Workbench& editor, const std::vector<std::string>& nodes);

}  // namespace bl::desktop
