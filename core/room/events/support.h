// What several events need: seats and areas by name, or a sentence.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "core/define/port_builder.h"
#include "core/room/room_state.h"

namespace bl::room {

/// The roles as choices of an argument.
std::vector<Choice<Role>> role_choices();
/// A seat that is in the room.
Result<Seat*> seat_in(RoomState& state, std::int64_t number);
Result<Area*> area_in(RoomState& state, const std::string& name);
bool is_last_facilitator(const RoomState& state, std::int64_t number);
/// Lays down the pens of areas that are not this seat's any more, and takes it out of who asks for them.
void drop_pens_of(RoomState& state, std::int64_t number);

}  // namespace bl::room
