// A room as one page without scripts: plan, figures, votes and comments, with forms.
#pragma once

#include <optional>
#include <string>

#include "core/define/payload.h"
#include "core/room/operation.h"
#include "core/serve/http.h"
#include "core/serve/room_host.h"

namespace bl::serve {

/// The style sheet of both.
std::string plain_style();
/// The page that asks for a seat, with the plan.
std::string plain_door(RoomHost& room, const std::string& notice);
/// What a form asks for.
struct PlainWish {
  room::OperationKind kind = room::OperationKind::command;
  JsonValue content;
};

/// The page of somebody who has a seat. The token stands in its forms only, never in an address. `taken` has just been stored:
/// its ballot is shown although no tick has read it yet, which takes until the next tick, and in a paused room longer.
std::string plain_room(RoomHost& room, std::int64_t seat, const std::string& token, const std::string& notice,
                       const PlainWish* taken = nullptr);

/// What a form asks for, or why it cannot be understood.
std::variant<PlainWish, std::string> wish_of_vote(RoomHost& room, std::int64_t seat,
                                                  const std::map<std::string, std::string>& fields);
std::variant<PlainWish, std::string> wish_of_comment(RoomHost& room, std::int64_t seat,
                                                     const std::map<std::string, std::string>& fields);

}  // namespace bl::serve
