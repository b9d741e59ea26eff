// What a person sends to a room.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/define/payload.h"
#include "core/room/answer.h"

namespace bl::room {

/// A value that the sender has seen at a place: where it is another one by now, the operation is refused as `stale`.
struct Condition {
  std::string key;  ///< such as `nodes/tower/types/smart_volume/demand` or `nodes/tower/name`
  JsonValue was = JsonValue::null();
};

/// What an operation is, and with that the form of its content.
enum class OperationKind : std::uint8_t {
  command,      ///< {"command", "arguments"}
  event,        ///< {"event", "arguments"}
  undo,         ///< {"gesture"?, "of"?}: a gesture, and for the facilitator the seat that made it
  redo,         ///< {"gesture"?}
  rewind,       ///< {"to"}: takes back everything since that entry, whoever did it
  draft_begin,  ///< {"draft", "title"?}
  draft_undo,   ///< {"draft"}: the last step of a draft
  draft_redo,   ///< {"draft"}: the step that was taken back last
  draft_drop    ///< {"draft"}
};

/// Operations of one run (the life of one page or window) are numbered 1, 2, 3, … without gaps, and each is answered exactly
/// once; the same number again gets the same answer.
struct Operation {
  std::string run;
  std::int64_t id = 0;
  OperationKind kind = OperationKind::command;
  JsonValue content = {};
  std::int64_t gesture = 0;  ///< of the sender's own numbering: commands of one gesture are undone together; 0: a new one
  std::string draft = {};    ///< the command is a step of this draft
  std::vector<Condition> conditions = {};
  std::optional<Refusal> unreadable = {};  ///< its form is wrong; it has its number all the same, and is answered
};

}  // namespace bl::room
