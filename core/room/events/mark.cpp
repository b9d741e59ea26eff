// Something goes into the minutes: a decision, or whatever was said.
#include "core/room/event_builder.h"

namespace bl::room {

namespace {

struct MarkEvent {
  struct In {
    std::string kind = "decision", text;
  };
  static constexpr Rights kRights{.recorder = Ground::always};
  static void declare(EventBuilder<MarkEvent>& e) {
    e.id("mark").label("Mark").doc("Puts a decision, or whatever was said, into the minutes, at this tick.");
    e.argument(&In::kind, "kind").doc("What it is, such as `decision`, `question` or `task`.");
    e.words(&In::text, "text").required().doc("What the minutes say.");
  }
  static Result<void> apply(RoomState& state, const In& in, const EventPlace& place) {
    state.marks.push_back({.seat = place.seat, .seq = place.seq, .tick = place.tick, .kind = in.kind, .text = in.text});
    return {};
  }
};

}  // namespace

}  // namespace bl::room

BL_EVENT(mark, MarkEvent)
