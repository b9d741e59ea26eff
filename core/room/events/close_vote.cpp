// The facilitator closes a vote.
#include "core/room/event_builder.h"

namespace bl::room {

namespace {

struct CloseVote {
  struct In {
    std::string vote;
  };
  static constexpr Rights kRights{};
  static void declare(EventBuilder<CloseVote>& e) {
    e.id("close_vote").label("Close vote").doc("Ballots are no longer taken. What ties secret ballots to people is destroyed.");
    e.argument(&In::vote, "vote").required().doc("Node that carries the vote.");
  }
  static Result<void> apply(RoomState& state, const In& in, const EventPlace&) {
    if (state.votes.erase(in.vote) == 0) return Error{ErrorCode::not_found, "vote", "the vote `" + in.vote + "` is not open"};
    return {};
  }
};

}  // namespace

}  // namespace bl::room

BL_EVENT(close_vote, CloseVote)
