// Somebody wants to be the only one who changes an area for a while.
#include "core/room/event_builder.h"
#include "core/room/events/support.h"

namespace bl::room {

namespace {

struct AskPen {
  struct In {
    std::string area;
    bool asks = true;
  };
  static constexpr Rights kRights{.designer = Ground::always, .stakeholder = Ground::always};
  static void declare(EventBuilder<AskPen>& e) {
    e.id("ask_pen")
        .label("Ask for the pen")
        .doc(
            "Who has the pen of an area is the only one who changes it. A pen that nobody has is given at once; else its holder "
            "or the "
            "facilitator is asked.");
    e.argument(&In::area, "area").required().doc("Name of the area.");
    e.argument(&In::asks, "asks").doc("Off to wait for it no longer.");
  }
  static Result<void> apply(RoomState& state, const In& in, const EventPlace& place) {
    auto area = area_in(state, in.area);
    if (!area) return area.error();
    const Seat* seat = state.seat(place.seat);
    if (seat == nullptr || (seat->role != Role::facilitator && !seat->areas.contains(in.area)))
      return Error{ErrorCode::conflict, "area", "the area `" + in.area + "` is not yours"};
    if ((*area)->pen == place.seat) return Error{ErrorCode::conflict, "area", "you have the pen of `" + in.area + "` already"};
    std::erase((*area)->asking, place.seat);
    if (in.asks && (*area)->pen == 0) (*area)->pen = place.seat;
    else if (in.asks) (*area)->asking.push_back(place.seat);
    return {};
  }
};

}  // namespace

}  // namespace bl::room

BL_EVENT(ask_pen, AskPen)
