// The facilitator says what became of a comment.
#include "core/room/event_builder.h"

namespace bl::room {

namespace {

struct AnswerComment {
  struct In {
    std::string comment, answer;
    CommentState state = CommentState::open;
  };
  static constexpr Rights kRights{.recorder = Ground::always};
  static void declare(EventBuilder<AnswerComment>& e) {
    e.id("answer_comment").label("Answer comment").doc("Says what became of a comment, and why.");
    e.argument(&In::comment, "comment").required().doc("Name of the comment.");
    e.argument(&In::state, "state",
               {{CommentState::open, "open", "Nothing is decided."},
                {CommentState::accepted, "accepted", "It is followed."},
                {CommentState::rejected, "rejected", "It is not followed."}})
        .doc("What became of it.");
    e.words(&In::answer, "answer").doc("Why, in words.");
  }
  static Result<void> apply(RoomState& state, const In& in, const EventPlace&) {
    const auto comment = state.comments.find(in.comment);
    if (comment == state.comments.end())
      return Error{ErrorCode::not_found, "comment", "there is no comment `" + in.comment + "`"};
    comment->second.state = in.state;
    comment->second.answer = in.answer;
    return {};
  }
};

}  // namespace

}  // namespace bl::room

BL_EVENT(answer_comment, AnswerComment)
