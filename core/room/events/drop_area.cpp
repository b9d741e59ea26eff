// The facilitator gives up an area.
#include "core/room/event_builder.h"
#include "core/room/events/support.h"

namespace bl::room {

namespace {

struct DropArea {
  struct In {
    std::string area;
  };
  static constexpr Rights kRights{};
  static void declare(EventBuilder<DropArea>& e) {
    e.id("drop_area").label("Drop area").doc("Nobody may change anything any more because it lies in this area.");
    e.argument(&In::area, "area").required().doc("Name of the area.");
  }
  static Result<void> apply(RoomState& state, const In& in, const EventPlace&) {
    if (auto area = area_in(state, in.area); !area) return area.error();
    state.areas.erase(in.area);
    for (auto& [number, seat] : state.seats) seat.areas.erase(in.area);
    return {};
  }
};

}  // namespace

}  // namespace bl::room

BL_EVENT(drop_area, DropArea)
