// Places inside the view of a scene: where two views differ, and what of one is to be had in the other.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "core/define/json_text.h"

namespace bl {

/// The paths at which two views differ, each down to what is no object; where nothing differs but the order of keys or objects
/// without content, the empty path. `changes`, where given, is a patch that led from one to the other: only its keys are looked
/// at. Keys are steps of the paths (`step_of`).
std::vector<std::string> view_differences(const Json& before, const Json& after, const Json* changes = nullptr);

/// The patch that gives a view at these paths what `wanted` has there; null where it has nothing.
Json patch_at(const Json& wanted, const std::set<std::string>& paths);

}  // namespace bl
