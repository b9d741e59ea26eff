// The facilitator opens or shuts the door of the room.
#include "core/room/event_builder.h"

namespace bl::room {

namespace {

struct SetDoor {
  struct In {
    Door door = Door::open;
  };
  static constexpr Rights kRights{};
  static void declare(EventBuilder<SetDoor>& e) {
    e.id("set_door").label("Set door").doc("Says whether people who have the code of the room get a seat.");
    e.argument(&In::door, "door",
               {{Door::open, "open", "Everybody with the code comes in."},
                {Door::asks, "asks", "Who comes in only watches, until the facilitator gives them a role."},
                {Door::shut, "shut", "Nobody new comes in; who has a seat keeps it."}})
        .doc("Who comes in.");
  }
  static Result<void> apply(RoomState& state, const In& in, const EventPlace&) {
    state.door = in.door;
    return {};
  }
};

}  // namespace

}  // namespace bl::room

BL_EVENT(set_door, SetDoor)
