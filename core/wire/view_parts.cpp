// Texts and names come from the room, and may be erased there.
#include "core/wire/view_parts.h"

#include <utility>

#include <nlohmann/json.hpp>

#include "core/define/json_text.h"

namespace bl::wire {

void put(View& view, std::string key, const Json& content) { view[std::move(key)] = write_json_line(content); }

std::string text_of(const room::Room& room, const std::string& id) {
  const room::TextRecord* text = room.text(id);
  return text == nullptr ? "" : text->body;
}

std::string seat_name(const room::RoomState& state, const std::string& author) {
  const auto seat = state.seats.find(room::RoomState::seat_of_author(author));
  return seat == state.seats.end() ? author : seat->second.name;
}

}  // namespace bl::wire
