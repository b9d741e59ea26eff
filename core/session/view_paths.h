// Places inside the view of a scene: where two views differ, and patches from one to the other.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "core/define/json_text.h"

namespace bl {

/// The paths at which two views differ, each down to a value that is no object; the empty path where only the order of keys or
/// empty objects differ. `changes`, where given, is a patch that led from one to the other; only its keys are compared. Keys are
/// steps of the paths (`step_of`).
std::vector<std::string> view_differences(const Json& before, const Json& after, const Json* changes = nullptr);

/// The patch that gives a view the values of `wanted` at these paths; null where it has none.
Json patch_at(const Json& wanted, const std::set<std::string>& paths);

}  // namespace bl
