// The running state in a scene file: its section `state`, out and in.
#pragma once

#include <optional>
#include <vector>

#include "core/define/json_text.h"
#include "core/graph/state.h"

namespace bl {

Json state_to_json(const SavedState& state, const Registry& types);
/// What a file says of the run of `scene`; nothing where it cannot be used, which is then among the problems. Figures that this
/// program does not keep any more are told and left out, and so is what a run has made of typifications that it does not know.
std::optional<SavedState> state_from_json(const Json& json, const Scene& scene, const Registry& types,
                                          std::vector<Problem>& problems);

}  // namespace bl
