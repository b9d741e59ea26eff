// The facilitator lets some ticks come, whether the clock runs or not.
#include "core/room/event_builder.h"

namespace bl::room {

namespace {

struct StepClock {
  struct In {
    std::int64_t ticks = 1;
  };
  static constexpr Rights kRights{};
  static void declare(EventBuilder<StepClock>& e) {
    e.id("step_clock").label("Step").doc("Takes some ticks while the clock stands. No result depends on it.");
    e.argument(&In::ticks, "ticks").range(1, 1000).doc("How many.");
  }
  // The ticks are taken by whoever runs the room; the log says that they were wanted.
  static Result<void> apply(RoomState&, const In&, const EventPlace&) { return {}; }
};

}  // namespace

}  // namespace bl::room

BL_EVENT(step_clock, StepClock)
