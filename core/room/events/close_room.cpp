// The facilitator ends the session.
#include "core/room/event_builder.h"

namespace bl::room {

namespace {

struct CloseRoom {
  struct In {
    bool shares_minutes = false;
  };
  static constexpr Rights kRights{};
  static void declare(EventBuilder<CloseRoom>& e) {
    e.id("close_room").label("Close room").doc("Ends the session: from now on nothing is changed or said.");
    e.argument(&In::shares_minutes, "shares_minutes").doc("On to let everybody who took part open the minutes.");
  }
  static Result<void> apply(RoomState& state, const In& in, const EventPlace&) {
    if (!state.votes.empty())
      return Error{ErrorCode::conflict, "votes", "close the vote `" + state.votes.begin()->first + "` first"};
    state.is_closed = true;
    state.shares_minutes = in.shares_minutes;
    return {};
  }
};

}  // namespace

}  // namespace bl::room

BL_EVENT(close_room, CloseRoom)
