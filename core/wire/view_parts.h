// What several views say in the same way.
#pragma once

#include <string>

#include <nlohmann/json_fwd.hpp>

#include "core/wire/views.h"

namespace bl::wire {

void put(View& view, std::string key, const nlohmann::ordered_json& content);
/// The words of a text, or nothing where they are erased.
std::string text_of(const room::Room& room, const std::string& id);
/// The name of the seat that this author is, or the author as it is.
std::string seat_name(const room::RoomState& state, const std::string& author);

}  // namespace bl::wire
