// What a room remembers about its windows: which tick they were told of, the last snapshot, and where people are.
#pragma once

#include <cstdint>
#include <deque>
#include <limits>
#include <map>
#include <memory>
#include <string>

#include "core/define/payload.h"
#include "core/wire/messages.h"

namespace bl::serve {

/// What a window was sent last about the ticks.
struct TickMark {
  std::int64_t tick = -1, hashed = -1;
  bool is_resting = false;
};

/// A snapshot as a frame, for all who ask within a moment.
struct PackedScene {
  std::int64_t seq = 0, tick = 0;
  double at = 0;  ///< on the clock of the room [s]
  std::shared_ptr<const std::string> frame;
};

/// Where somebody is. It is never stored.
struct Presence {
  JsonValue state = JsonValue::null();  ///< null: gone
  bool is_told = false;
  double gone_at = std::numeric_limits<double>::infinity();  ///< set where the connection has ended [s]
};

struct Windows {
  TickMark mark;
  std::deque<wire::TickOut> untold;  ///< later ticks, which have read what is not stored yet
  PackedScene packed;
  std::map<std::int64_t, Presence> presences;  ///< by seat
  double presence_at = 0;                      ///< when presences were told last [s]
};

}  // namespace bl::serve
