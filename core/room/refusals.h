// Refusals from errors, and places of a scene by the keys that messages use.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "core/define/json_text.h"
#include "core/graph/scene.h"
#include "core/graph/touch.h"
#include "core/room/answer.h"
#include "core/room/room_state.h"
#include "core/session/commands.h"

namespace bl::room {

Refusal refuse(Reason why, std::string place, std::string text, Json args = Json::object());
Refusal refusal_of(Reason why, const Error& error);
/// Of a command that the scene does not take: `gone` where it names something that is not there.
Refusal refusal_of_scene(const Error& error);

/// A field as a whole number, or `otherwise` where there is none; nothing where it is something else.
std::optional<std::int64_t> whole_number(const Json& object, const char* field, std::int64_t otherwise);

/// `nodes/tower/name` as a place; nothing where it is none.
std::optional<Touch> touch_named(const std::string& key);
/// The value at a place as people have set it, as JSON: of a port, a name, a lock, a link's parameter or strength, a setting.
/// Nothing where there is no such place.
std::optional<JsonValue> value_at(const Scene& scene, const Registry& registry, const Touch& place);

/// Why a ballot cannot be given now; nothing where the vote is open.
std::optional<Refusal> why_no_ballot(const RoomState& state, const Command& cast_vote);
bool is_secret(const RoomState& state, const Command& cast_vote);

}  // namespace bl::room
