// Somebody shows a draft to the facilitator.
#include "core/room/event_builder.h"

namespace bl::room {

namespace {

struct Propose {
  struct In {
    std::string draft, title, why;
    std::int64_t steps = 0;
  };
  static constexpr Rights kRights{
      .designer = Ground::always, .stakeholder = Ground::always, .participant = Ground::always, .activity = Activity::draft};
  static void declare(EventBuilder<Propose>& e) {
    e.id("propose").label("Propose").doc("Shows a draft to the facilitator, who accepts it or not.");
    e.argument(&In::draft, "draft").required().doc("Name of the draft.");
    e.title(&In::title, "title").doc("What it is called.");
    e.words(&In::why, "why").doc("What it is good for, in words.");
    e.argument(&In::steps, "steps").min(0).doc("How many steps it has; the room fills this in.");
  }
  static Result<void> apply(RoomState& state, const In& in, const EventPlace& place) {
    const auto known = state.proposals.find(in.draft);
    if (known != state.proposals.end() && known->second.state != ProposalState::rejected)
      return Error{ErrorCode::duplicate, "draft",
                   "the draft `" + in.draft + "` is " + std::string(kProposalStateNames[static_cast<int>(known->second.state)]) +
                       " already"};
    state.proposals[in.draft] = {.seat = place.seat, .title = in.title, .why = in.why, .steps = in.steps};
    return {};
  }
};

}  // namespace

}  // namespace bl::room

BL_EVENT(propose, Propose)
