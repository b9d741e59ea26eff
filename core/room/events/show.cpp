// The facilitator chooses what the big screen shows.
#include "core/room/event_builder.h"

namespace bl::room {

namespace {

struct Show {
  struct In {
    std::string layout;
  };
  static constexpr Rights kRights{};
  static void declare(EventBuilder<Show>& e) {
    e.id("show").label("Show").doc("Chooses what the big screen shows.");
    e.argument(&In::layout, "layout")
        .doc("`plan`, `compare`, `vote`, `comments`, `marks`, `space` or `code`; empty for the plan.");
  }
  static Result<void> apply(RoomState& state, const In& in, const EventPlace&) {
    state.layout = in.layout;
    return {};
  }
};

}  // namespace

}  // namespace bl::room

BL_EVENT(show, Show)
