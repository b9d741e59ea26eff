// The facilitator accepts a proposal, or says why not.
#include "core/room/event_builder.h"

namespace bl::room {

namespace {

struct DecideProposal {
  struct In {
    std::string draft, answer;
    bool is_accepted = false;
    Numbers keep;
    std::int64_t kept = 0;
  };
  static constexpr Rights kRights{};
  static void declare(EventBuilder<DecideProposal>& e) {
    e.id("decide_proposal")
        .label("Decide")
        .doc("Accepts a proposal or rejects it. Of an accepted one, the commands stand before this entry.");
    e.argument(&In::draft, "draft").required().doc("Name of the draft.");
    e.argument(&In::is_accepted, "is_accepted").doc("Whether it is taken, wholly or in part.");
    e.words(&In::answer, "answer").doc("Why, in words.");
    e.argument(&In::keep, "keep").doc("Numbers of the steps that are taken, from 0; none for all of them.");
    e.argument(&In::kept, "kept").min(0).doc("How many of its steps were taken; the room fills this in.");
  }
  static Result<void> apply(RoomState& state, const In& in, const EventPlace& place) {
    const auto proposal = state.proposals.find(in.draft);
    if (proposal == state.proposals.end() || proposal->second.state != ProposalState::proposed)
      return Error{ErrorCode::not_found, "draft", "there is no open proposal `" + in.draft + "`"};
    proposal->second.state = in.is_accepted ? ProposalState::accepted : ProposalState::rejected;
    proposal->second.by = place.seat;
    proposal->second.answer = in.answer;
    proposal->second.kept = in.kept;
    return {};
  }
};

}  // namespace

}  // namespace bl::room

BL_EVENT(decide_proposal, DecideProposal)
