// The facilitator stops a seat from changing or saying anything, or lets it again.
#include "core/room/event_builder.h"
#include "core/room/events/support.h"

namespace bl::room {

namespace {

struct Mute {
  struct In {
    std::int64_t seat = 0;
    bool is_muted = true;
  };
  static constexpr Rights kRights{};
  static void declare(EventBuilder<Mute>& e) {
    e.id("mute").label("Mute").doc("A muted seat sees everything, and can change, draft, say and vote nothing.");
    e.argument(&In::seat, "seat").required().doc("Number of the seat.");
    e.argument(&In::is_muted, "is_muted").doc("Off to let the person act again.");
  }
  static Result<void> apply(RoomState& state, const In& in, const EventPlace& place) {
    auto seat = seat_in(state, in.seat);
    if (!seat) return seat.error();
    if (in.seat == place.seat) return Error{ErrorCode::conflict, "seat", "nobody can mute themselves"};
    (*seat)->is_muted = in.is_muted;
    return {};
  }
};

}  // namespace

}  // namespace bl::room

BL_EVENT(mute, Mute)
