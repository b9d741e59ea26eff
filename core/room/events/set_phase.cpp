// The facilitator begins another phase of the session.
#include <algorithm>

#include "core/room/event_builder.h"

namespace bl::room {

namespace {

struct SetPhase {
  struct In {
    std::string name;
    std::vector<std::string> activities = {"change", "draft", "comment", "vote"};
    std::vector<std::string> forms;
    std::int64_t ends_at = 0;
  };
  static constexpr Rights kRights{};
  static void declare(EventBuilder<SetPhase>& e) {
    e.id("set_phase").label("Set phase").doc("Begins a phase. What it does not let people do is refused, facilitators excepted.");
    e.title(&In::name, "name").doc("What people see as the title of the phase.");
    e.argument(&In::activities, "activities").doc("What people may do: `change`, `draft`, `comment`, `vote`.");
    e.argument(&In::forms, "forms").doc("Typifications whose nodes participants may add, each within its own settings.");
    e.argument(&In::ends_at, "ends_at").min(0).doc("What the timer counts down to, in milliseconds since 1970; 0 for no timer.");
  }
  static Result<void> apply(RoomState& state, const In& in, const EventPlace&) {
    Phase phase{.name = in.name, .activities = {}, .forms = {in.forms.begin(), in.forms.end()}, .ends_at = in.ends_at};
    for (const std::string& name : in.activities) {
      const auto known = std::find(kActivityNames.begin() + 1, kActivityNames.end(), name);
      if (known == kActivityNames.end())
        return Error{ErrorCode::parse, "activities", "expects `change`, `draft`, `comment` or `vote`, not `" + name + "`"};
      phase.activities.insert(static_cast<Activity>(known - kActivityNames.begin()));
    }
    state.phase = std::move(phase);
    return {};
  }
};

}  // namespace

}  // namespace bl::room

BL_EVENT(set_phase, SetPhase)
