// The facilitator gives a seat another role, other areas or another role card.
#include "core/room/event_builder.h"
#include "core/room/events/support.h"

namespace bl::room {

namespace {

struct SetRole {
  struct In {
    std::int64_t seat = 0;
    Role role = Role::viewer;
    std::vector<std::string> areas;
    std::string card;
  };
  static constexpr Rights kRights{};
  static void declare(EventBuilder<SetRole>& e) {
    e.id("set_role").label("Set role").doc("Gives a seat a role, with its areas and its role card. It holds from this entry on.");
    e.argument(&In::seat, "seat").required().doc("Number of the seat.");
    e.argument(&In::role, "role", role_choices()).required().doc("What the person may do.");
    e.argument(&In::areas, "areas").doc("Areas that the person may change.");
    e.argument(&In::card, "card").doc("Node with the role card; empty for none.");
  }
  static Result<void> apply(RoomState& state, const In& in, const EventPlace& place) {
    auto seat = seat_in(state, in.seat);
    if (!seat) return seat.error();
    for (const std::string& area : in.areas)
      if (auto known = area_in(state, area); !known) return known.error();
    if (!in.card.empty() && !place.scene.nodes.contains(in.card))
      return Error{ErrorCode::not_found, "card", "there is no node `" + in.card + "`"};
    if ((*seat)->role == Role::facilitator && in.role != Role::facilitator && is_last_facilitator(state, in.seat))
      return Error{ErrorCode::conflict, "role", "a room needs a facilitator: make somebody else one first"};
    (*seat)->role = in.role;
    (*seat)->areas = {in.areas.begin(), in.areas.end()};
    (*seat)->card = in.card;
    (*seat)->is_waiting = false;
    drop_pens_of(state, in.seat);
    return {};
  }
};

}  // namespace

}  // namespace bl::room

BL_EVENT(set_role, SetRole)
