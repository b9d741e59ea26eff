// On what grounds a change of a scene is allowed, touch by touch.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/room/rights.h"

namespace bl::room {

/// What a command has done to a copy of the scene.
struct TriedChange {
  const Scene& before;
  const Scene& after;
  const std::vector<Touch>& touches;
};

/// The first touch for which none of the grounds holds, as a refusal. `command` is what made the change; one without an id is an
/// undo.
std::optional<Refusal> why_ungrounded(const Asking& asking, Grounds grounds, const Command& command, const TriedChange& change);

/// `Set value` as it stands inside a sentence.
std::string lower_first(std::string_view label);
std::string_view name_of(Role role);

}  // namespace bl::room
