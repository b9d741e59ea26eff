// Somebody gets a seat in the room.
#include "core/room/event_builder.h"
#include "core/room/events/support.h"

namespace bl::room {

namespace {

// The room itself says so, once it has seen an invitation.
struct Join {
  struct In {
    std::int64_t seat = 0;
    Role role = Role::viewer;
    std::string name, colour, card;
    std::vector<std::string> areas;
    bool waits = false;
  };
  static constexpr Rights kRights{.facilitator = {}};
  static void declare(EventBuilder<Join>& e) {
    e.id("join").label("Join").doc("Somebody gets a seat in the room.");
    e.argument(&In::seat, "seat").required().min(1).doc("Number of the seat.");
    e.argument(&In::role, "role", role_choices()).doc("What the person may do.");
    e.argument(&In::name, "name").doc("The pseudonym that others see.");
    e.argument(&In::colour, "colour").doc("The colour of the person's marks, such as `#1b9e77`.");
    e.argument(&In::areas, "areas").doc("Areas that the person may change.");
    e.argument(&In::card, "card").doc("Node with the role card; empty for none.");
    e.argument(&In::waits, "waits").doc("On where the door asks: the person watches until the facilitator gives them a role.");
  }
  static Result<void> apply(RoomState& state, const In& in, const EventPlace&) {
    if (state.seats.contains(in.seat))
      return Error{ErrorCode::duplicate, "seat", "the seat " + std::to_string(in.seat) + " is taken"};
    state.seats[in.seat] = {.role = in.role,
                            .name = in.name,
                            .colour = in.colour,
                            .areas = {in.areas.begin(), in.areas.end()},
                            .card = in.card,
                            .is_here = true,
                            .is_waiting = in.waits};
    return {};
  }
};

}  // namespace

}  // namespace bl::room

BL_EVENT(join, Join)
