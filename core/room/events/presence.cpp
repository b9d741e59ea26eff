// Somebody comes back to their seat, or leaves it for a while.
#include "core/room/event_builder.h"
#include "core/room/events/support.h"

namespace bl::room {

namespace {

struct Presence {
  struct In {
    std::int64_t seat = 0;
    bool is_here = true;
  };
  static constexpr Rights kRights{.facilitator = {}};
  static void declare(EventBuilder<Presence>& e) {
    e.id("presence")
        .label("Come or leave")
        .doc("Somebody comes back to their seat, or leaves it for a while; the seat stays theirs.");
    e.argument(&In::seat, "seat").required().doc("Number of the seat.");
    e.argument(&In::is_here, "is_here").doc("Off where the person has left.");
  }
  static Result<void> apply(RoomState& state, const In& in, const EventPlace&) {
    auto seat = seat_in(state, in.seat);
    if (!seat) return seat.error();
    (*seat)->is_here = in.is_here;
    return {};
  }
};

}  // namespace

}  // namespace bl::room

BL_EVENT(presence, Presence)
