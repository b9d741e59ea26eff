// The facilitator makes all invitations of before void.
#include "core/room/event_builder.h"

namespace bl::room {

namespace {

// The keys themselves never stand in the log: whoever holds the room makes them from a secret and from this number.
struct RenewKeys {
  struct In {};
  static constexpr Rights kRights{};
  static void declare(EventBuilder<RenewKeys>& e) {
    e.id("renew_keys")
        .label("Renew keys")
        .doc("Makes new keys for all roles. The invitations of before open no seat any more; who has a seat keeps it.");
  }
  static Result<void> apply(RoomState& state, const In&, const EventPlace&) {
    ++state.key_renewals;
    return {};
  }
};

}  // namespace

}  // namespace bl::room

BL_EVENT(renew_keys, RenewKeys)
