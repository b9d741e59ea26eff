// The facilitator goes back to a scenario, with the running state that it had.
#include "core/base/text.h"
#include "core/room/event_builder.h"

namespace bl::room {

namespace {

struct Restart {
  struct In {
    std::string scenario, state;
  };
  static constexpr Rights kRights{};
  static void declare(EventBuilder<Restart>& e) {
    e.id("restart")
        .label("Go back to scenario")
        .doc("Goes back to a scenario: the scene as it was saved, with the running state of that moment. Ballots stay.");
    e.argument(&In::scenario, "scenario").required().doc("Id of the scenario.");
    e.argument(&In::state, "state").doc("Hash of the running state; the room fills this in.");
  }
  static Result<void> apply(RoomState& state, const In& in, const EventPlace&) {
    if (!state.scenarios.contains(in.scenario))
      return Error{ErrorCode::not_found, "scenario",
                   "there is no scenario `" + in.scenario + "`" + did_you_mean(in.scenario, keys_of(state.scenarios))};
    ++state.epoch;
    return {};
  }
};

}  // namespace

}  // namespace bl::room

BL_EVENT(restart, Restart)
