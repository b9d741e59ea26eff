// The facilitator sends somebody out of the room.
#include "core/room/event_builder.h"
#include "core/room/events/support.h"

namespace bl::room {

namespace {

struct RemoveSeat {
  struct In {
    std::int64_t seat = 0;
  };
  static constexpr Rights kRights{};
  static void declare(EventBuilder<RemoveSeat>& e) {
    e.id("remove_seat").label("Remove").doc("Sends somebody out: the seat is closed, and what it has said stays.");
    e.argument(&In::seat, "seat").required().doc("Number of the seat.");
  }
  static Result<void> apply(RoomState& state, const In& in, const EventPlace& place) {
    auto seat = seat_in(state, in.seat);
    if (!seat) return seat.error();
    if (in.seat == place.seat) return Error{ErrorCode::conflict, "seat", "nobody can remove themselves"};
    (*seat)->is_removed = true;
    (*seat)->is_here = false;
    (*seat)->is_waiting = false;
    drop_pens_of(state, in.seat);
    return {};
  }
};

}  // namespace

}  // namespace bl::room

BL_EVENT(remove_seat, RemoveSeat)
