// What a server says is read with care: fields that are missing or have another form are as if nobody had said them.
#include "core/guest/people.h"

#include <nlohmann/json.hpp>

#include "core/base/text.h"
#include "core/room/room_state.h"

namespace bl::guest {

namespace {

bool flag_in(const Json& json, const char* key) {
  return json.is_object() && json.contains(key) && json[key].is_boolean() && json[key].get<bool>();
}

std::optional<std::int64_t> seat_of(const std::string& key) {
  if (key.empty() || key.size() > 9 || key.find_first_not_of("0123456789") != std::string::npos) return std::nullopt;
  return std::stoll(key);
}

}  // namespace

std::string text_in(const Json& json, const char* key) {
  return json.is_object() && json.contains(key) && json[key].is_string() ? json[key].get<std::string>() : std::string();
}

std::int64_t number_in(const Json& json, const char* key, std::int64_t otherwise) {
  return json.is_object() && json.contains(key) && json[key].is_number_integer() ? json[key].get<std::int64_t>() : otherwise;
}

void People::take_view(const Json& set) {
  if (!set.is_object()) return;
  if (set.contains("title")) title = text_in(set, "title");
  if (set.contains("paused")) is_paused = flag_in(set, "paused");
  if (set.contains("closed")) is_closed = flag_in(set, "closed");
  if (set.contains("rate") && set["rate"].is_number()) rate = set["rate"].get<double>();
  if (set.contains("seats") && set["seats"].is_object()) {
    seats.clear();
    for (const auto& [key, one] : set["seats"].items())
      if (const auto seat = seat_of(key))
        seats[*seat] = {text_in(one, "role"), text_in(one, "name"), text_in(one, "colour"), flag_in(one, "here")};
  }
  if (set.contains("areas") && set["areas"].is_object()) {
    areas.clear();
    for (const auto& [key, one] : set["areas"].items()) {
      PenArea& area = areas[key];
      if (one.is_object() && one.contains("pen") && one["pen"].is_number_integer()) area.holder = one["pen"].get<std::int64_t>();
      if (one.is_object() && one.contains("asking") && one["asking"].is_array())
        for (const Json& seat : one["asking"])
          if (seat.is_number_integer()) area.asking.push_back(seat.get<std::int64_t>());
    }
  }
}

void People::take_presence(const Json& by_seat) {
  if (!by_seat.is_object()) return;
  for (const auto& [key, one] : by_seat.items()) {
    const auto seat = seat_of(key);
    if (!seat) continue;
    if (!one.is_object()) {
      whereabouts.erase(*seat);
      continue;
    }
    Whereabouts& where = whereabouts[*seat] = {};
    where.is_hidden = flag_in(one, "hidden");
    if (one.contains("camera")) where.camera = JsonValue::of(one["camera"]);
    if (one.contains("holds") && one["holds"].is_array())
      for (const Json& id : one["holds"])
        if (id.is_string()) where.holds.push_back(id.get<std::string>());
    if (!one.contains("cursor") || !one["cursor"].is_array() || one["cursor"].size() != 3) continue;
    const Json& cursor = one["cursor"];
    if (cursor[0].is_number() && cursor[1].is_number() && cursor[2].is_number())
      where.cursor = {cursor[0].get<double>(), cursor[1].get<double>(), cursor[2].get<double>()};
  }
}

std::string People::name_of(const std::string& author) const {
  const auto found = seats.find(room::RoomState::seat_of_author(author));
  return found == seats.end() || found->second.name.empty() ? author : found->second.name;
}

}  // namespace bl::guest
