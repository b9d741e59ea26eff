// The facilitator ends the session.
#include "core/room/event_builder.h"

namespace bl::room {

namespace {

struct CloseRoom {
  struct In {};
  static constexpr Rights kRights{};
  static void declare(EventBuilder<CloseRoom>& e) {
    e.id("close_room").label("Close room").doc("Ends the session: from now on nothing is changed or said.");
  }
  static Result<void> apply(RoomState& state, const In&, const EventPlace&) {
    if (!state.votes.empty())
      return Error{ErrorCode::conflict, "votes", "close the vote `" + state.votes.begin()->first + "` first"};
    state.is_closed = true;
    return {};
  }
};

}  // namespace

}  // namespace bl::room

BL_EVENT(close_room, CloseRoom)
