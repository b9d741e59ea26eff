// The facilitator opens a vote.
#include "core/room/event_builder.h"

namespace bl::room {

namespace {

struct OpenVoteEvent {
  struct In {
    std::string vote;
    std::int64_t ends_at = 0;
  };
  static constexpr Rights kRights{};
  static void declare(EventBuilder<OpenVoteEvent>& e) {
    e.id("open_vote").label("Open vote").doc("From now on people can give and change their ballots.");
    e.argument(&In::vote, "vote").required().doc("Node that carries the vote.");
    e.argument(&In::ends_at, "ends_at").min(0).doc("What the timer counts down to, in milliseconds since 1970; 0 for no timer.");
  }
  static Result<void> apply(RoomState& state, const In& in, const EventPlace& place) {
    const auto node = place.scene.nodes.find(in.vote);
    if (node == place.scene.nodes.end() || !node->second.types.contains("vote"))
      return Error{ErrorCode::not_found, "vote", "there is no vote `" + in.vote + "`"};
    if (state.votes.contains(in.vote)) return Error{ErrorCode::duplicate, "vote", "the vote `" + in.vote + "` is open already"};
    const PortValues& settings = node->second.types.at("vote");
    const auto secret = settings.find("is_secret");
    state.opened.insert(in.vote);
    state.votes[in.vote] = {in.ends_at, secret != settings.end() && std::get<bool>(secret->second)};
    return {};
  }
};

}  // namespace

}  // namespace bl::room

BL_EVENT(open_vote, OpenVoteEvent)
