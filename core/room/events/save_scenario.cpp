// Somebody names the state of the scene, to come back to it.
#include "core/base/text.h"
#include "core/room/event_builder.h"

namespace bl::room {

namespace {

struct SaveScenario {
  struct In {
    std::string id, name, note;
  };
  static constexpr Rights kRights{.designer = Ground::always, .recorder = Ground::always, .activity = Activity::any};
  static void declare(EventBuilder<SaveScenario>& e) {
    e.id("save_scenario")
        .label("Save scenario")
        .doc("Names the scene as it is now, so that people can compare it and come back to it.");
    e.argument(&In::id, "id").required().doc("Id of the scenario; must not be taken.");
    e.title(&In::name, "name").doc("What people see.");
    e.words(&In::note, "note").doc("What is good or bad about it, in words.");
  }
  static Result<void> apply(RoomState& state, const In& in, const EventPlace& place) {
    if (!is_identifier(in.id)) return Error{ErrorCode::parse, "id", "`" + in.id + "` cannot be a name"};
    if (state.scenarios.contains(in.id)) return Error{ErrorCode::duplicate, "id", "there is a scenario `" + in.id + "` already"};
    state.scenarios[in.id] = {.name = in.name, .note = in.note, .seat = place.seat, .seq = place.seq, .tick = place.tick};
    return {};
  }
};

}  // namespace

}  // namespace bl::room

BL_EVENT(save_scenario, SaveScenario)
