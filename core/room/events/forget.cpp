// A person has been erased: the seat keeps its number and loses its name.
#include "core/room/event_builder.h"
#include "core/room/events/support.h"

namespace bl::room {

namespace {

struct Forget {
  struct In {
    std::int64_t seat = 0;
  };
  static constexpr Rights kRights{};
  static void declare(EventBuilder<Forget>& e) {
    e.id("forget")
        .label("Erase person")
        .doc("Erases the name of a person and all words of theirs, for good. What they have changed stays.");
    e.argument(&In::seat, "seat").required().doc("Number of the seat.");
  }
  static Result<void> apply(RoomState& state, const In& in, const EventPlace&) {
    auto seat = seat_in(state, in.seat);
    if (!seat) return seat.error();
    return {};
  }
};

}  // namespace

}  // namespace bl::room

BL_EVENT(forget, Forget)
