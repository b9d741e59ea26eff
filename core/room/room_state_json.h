// The state of a room as JSON, as messages and pages show it.
#pragma once

#include "core/define/json_text.h"
#include "core/room/room_state.h"

namespace bl::room {

/// Seats, areas, phase, comments, proposals, scenarios, marks, open votes, makers and settings. Words are named, not held.
Json to_json(const RoomState& state);

}  // namespace bl::room
