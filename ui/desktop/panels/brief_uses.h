// The uses that a scene's briefs speak of: what is offered where a use is asked for, and what a new volume is for.
#pragma once

#include <string>
#include <vector>

#include "ui/desktop/panels/workbench.h"

namespace bl::desktop {

/// Those of the briefs in their order, then those that volumes have besides, by name; each once.
std::vector<std::string> known_uses(const Scene& scene);
/// Those of the briefs, the one that most floor area is missing of first.
std::vector<std::string> uses_by_need(Workbench& editor);
/// What a node says of a role that it is just given, as JSON: of a SmartVolume its use, so that no brief stumbles over it;
/// nothing of its size, which would be a voice against the brief. `number`: the how manieth one in the same step.
std::string first_values(Workbench& editor, const std::string& type, std::size_t number = 0);

/// What a volume is for was not asked: says which uses nodes have got by `first_values`; nothing where none has one.
void tell_uses(Workbench& editor, const std::vector<std::string>& nodes);

}  // namespace bl::desktop
