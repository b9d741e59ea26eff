// The table of all events, and what several of them need.
#include <algorithm>

#include "core/base/text.h"
#include "core/room/event_builder.h"
#include "core/room/events/support.h"

namespace bl::room {

// Written by the build from the files of events/.
void register_events(EventKinds& kinds);

const EventKinds& event_kinds() {
  static const EventKinds kKinds = [] {
    EventKinds kinds;
    register_events(kinds);
    return kinds;
  }();
  return kKinds;
}

std::vector<Choice<Role>> role_choices() {
  return {{Role::facilitator, "facilitator", "Leads the session, and may do everything."},
          {Role::designer, "designer", "Changes the scene in areas of their own, and elsewhere by drafts."},
          {Role::stakeholder, "stakeholder", "Has a role card with values to set; proposes drafts."},
          {Role::participant, "participant", "Votes, comments, and sets what the role card allows."},
          {Role::viewer, "viewer", "Sees everything and changes nothing."},
          {Role::recorder, "recorder", "Takes the minutes."},
          {Role::device, "device", "A machine that reports readings for nodes of its own."}};
}

Result<Seat*> seat_in(RoomState& state, std::int64_t number) {
  const auto seat = state.seats.find(number);
  if (seat == state.seats.end() || seat->second.is_removed)
    return Error{ErrorCode::not_found, "seat", "there is no seat " + std::to_string(number)};
  return &seat->second;
}

Result<Area*> area_in(RoomState& state, const std::string& name) {
  const auto area = state.areas.find(name);
  if (area == state.areas.end())
    return Error{ErrorCode::not_found, "area", "there is no area `" + name + "`" + did_you_mean(name, keys_of(state.areas))};
  return &area->second;
}

bool is_last_facilitator(const RoomState& state, std::int64_t number) {
  return std::none_of(state.seats.begin(), state.seats.end(), [&](const auto& entry) {
    return entry.first != number && entry.second.role == Role::facilitator && !entry.second.is_removed;
  });
}

void drop_pens_of(RoomState& state, std::int64_t number) {
  const Seat& seat = state.seats.at(number);
  for (auto& [name, area] : state.areas) {
    if (!seat.is_removed && (seat.role == Role::facilitator || seat.areas.contains(name))) continue;
    std::erase(area.asking, number);
    if (area.pen == number) area.pen = 0;
  }
}

}  // namespace bl::room
