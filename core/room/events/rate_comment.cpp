// Somebody agrees with a comment, or does not.
#include "core/room/event_builder.h"

namespace bl::room {

namespace {

struct RateComment {
  struct In {
    std::string comment;
    std::int64_t rating = 0;
  };
  static constexpr Rights kRights{.designer = Ground::always,
                                  .stakeholder = Ground::always,
                                  .participant = Ground::always,
                                  .recorder = Ground::always,
                                  .activity = Activity::comment};
  static void declare(EventBuilder<RateComment>& e) {
    e.id("rate_comment").label("Rate comment").doc("Agrees with a comment of somebody else, or disagrees.");
    e.argument(&In::comment, "comment").required().doc("Name of the comment.");
    e.argument(&In::rating, "rating").required().range(-1, 1).doc("1 agrees, -1 disagrees, 0 takes it back.");
  }
  static Result<void> apply(RoomState& state, const In& in, const EventPlace& place) {
    const auto comment = state.comments.find(in.comment);
    if (comment == state.comments.end())
      return Error{ErrorCode::not_found, "comment", "there is no comment `" + in.comment + "`"};
    if (comment->second.seat == place.seat) return Error{ErrorCode::conflict, "comment", "nobody rates their own comment"};
    if (in.rating == 0) comment->second.ratings.erase(place.seat);
    else comment->second.ratings[place.seat] = static_cast<int>(in.rating);
    return {};
  }
};

}  // namespace

}  // namespace bl::room

BL_EVENT(rate_comment, RateComment)
