// Writes and reads the running state of a scene file: its section `state`.
#pragma once

#include <optional>
#include <vector>

#include "core/define/json_text.h"
#include "core/graph/state.h"

namespace bl {

Json state_to_json(const SavedState& state, const Registry& types);
/// The running state of `scene` in a file; nothing where it cannot be used, with the reason among the problems. Values that this
/// program does not keep any more, and results of unknown typifications, are reported and left out.
std::optional<SavedState> state_from_json(const Json& json, const Scene& scene, const Registry& types,
                                          std::vector<Problem>& problems);

}  // namespace bl
