// The facilitator sets how fast ticks follow each other, or stops them.
#include "core/room/event_builder.h"

namespace bl::room {

namespace {

struct SetPace {
  struct In {
    double rate = 10;
    bool is_paused = false;
  };
  static constexpr Rights kRights{};
  static void declare(EventBuilder<SetPace>& e) {
    e.id("set_pace").label("Set pace").doc("Sets how many ticks there are in a second, or stops them. No result depends on it.");
    e.argument(&In::rate, "rate").range(1, 20).doc("Ticks in a second.");
    e.argument(&In::is_paused, "is_paused").doc("On where no tick is taken.");
  }
  static Result<void> apply(RoomState& state, const In& in, const EventPlace&) {
    state.rate = in.rate;
    state.is_paused = in.is_paused;
    return {};
  }
};

}  // namespace

}  // namespace bl::room

BL_EVENT(set_pace, SetPace)
