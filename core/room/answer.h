// What a room answers to an operation: that it is done, with its number, or why it is not.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

#include "core/base/result.h"
#include "core/define/payload.h"

namespace bl::room {

/// Why an operation was refused: a closed list, which pages translate. `text` of a refusal says more, in English.
enum class Reason : std::uint8_t {
  bad,       ///< it has not the form that it should have
  gone,      ///< what it is about is not there any more
  right,     ///< the role may not do this
  area,      ///< it is outside the person's own area, or somebody else has the pen of that area
  phase,     ///< not in this phase of the session
  range,     ///< beyond the range of the role card, or of the value itself
  budget,    ///< there is not that much left to give, such as coins of a vote
  stale,     ///< somebody has changed it since; nothing of an undo is left to be undone
  conflict,  ///< the scene does not allow it
  locked,    ///< the value is locked, or the person is muted
  closed,    ///< the vote or the room is closed
  rate,      ///< too many in a short time
  size,      ///< too large, or too many of them
  storage,   ///< the room cannot be stored at the moment
  draining,  ///< the room is being closed or moved
  gap,       ///< the operations before it have not come
};
std::string_view name_of(Reason reason);
std::optional<Reason> reason_named(std::string_view name);

/// An operation that changed nothing. `args` is an object with what its sentence needs in other languages, such as
/// {"area": "north", "holder": "Heron"}.
struct Refusal {
  Reason why = Reason::bad;
  std::string place, text;
  JsonValue args = {};
  bool operator==(const Refusal&) const = default;
};

/// An operation that stands in the log; `seq` is its last entry, or the last entry of the log where it has none of its own (a
/// step of a draft, a secret ballot).
struct Acknowledgement {
  std::int64_t seq = 0, tick = 0;
  bool operator==(const Acknowledgement&) const = default;
};

using Answer = std::variant<Acknowledgement, Refusal>;

}  // namespace bl::room
