// The holder of a pen or the facilitator gives it to somebody, or lays it down.
#include "core/room/event_builder.h"
#include "core/room/events/support.h"

namespace bl::room {

namespace {

struct GivePen {
  struct In {
    std::string area;
    std::int64_t seat = 0;
  };
  static constexpr Rights kRights{.designer = Ground::always, .stakeholder = Ground::always};
  static void declare(EventBuilder<GivePen>& e) {
    e.id("give_pen")
        .label("Give the pen")
        .doc(
            "Gives the pen of an area to somebody who works in it. Its holder may do this, and the facilitator; the room itself "
            "does it "
            "where a holder does not answer.");
    e.argument(&In::area, "area").required().doc("Name of the area.");
    e.argument(&In::seat, "seat").min(0).doc("Number of the seat that gets it; 0 to lay it down.");
  }
  static Result<void> apply(RoomState& state, const In& in, const EventPlace& place) {
    auto area = area_in(state, in.area);
    if (!area) return area.error();
    const Seat* giver = state.seat(place.seat);
    const bool may = place.seat == 0 || (*area)->pen == place.seat || (giver != nullptr && giver->role == Role::facilitator);
    if (!may) return Error{ErrorCode::conflict, "area", "somebody else has the pen of `" + in.area + "`"};
    if (in.seat != 0) {
      const auto seat = seat_in(state, in.seat);
      if (!seat) return seat.error();
      if ((*seat)->role != Role::facilitator && !(*seat)->areas.contains(in.area))
        return Error{ErrorCode::conflict, "seat", "the area `" + in.area + "` is not one of that seat's"};
    }
    (*area)->pen = in.seat;
    std::erase((*area)->asking, in.seat);
    return {};
  }
};

}  // namespace

}  // namespace bl::room

BL_EVENT(give_pen, GivePen)
