// The second laptop: it keeps a copy of a room's session file, so that it can go on with the room when the first is gone.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "core/base/result.h"
#include "core/host/clock.h"
#include "core/serve/room_address.h"

namespace bl::serve {

struct SecondOptions {
  RoomAddress first;
  std::string token;           ///< the key that the first has printed, or a facilitator's token
  std::string path;            ///< of the copy
  std::string address = {};    ///< where pages find the room once this laptop has it; empty: nobody knows
  std::string authorities;     ///< as Client has them
  bool is_safe = false;        ///< people get an answer only once this laptop has stored it, too
  double take_over_after = 0;  ///< so long after the first was heard last [s]; 0: only when somebody says so
  std::int64_t opened_at = 0;  ///< [ms since 1970]
  host::Clock* clock = &host::real_clock();
  std::function<bool()> is_over, is_told_to_take_over;  ///< asked some ten times a second
  std::function<void(const std::string&)> say;          ///< one sentence for the facilitator
};

enum class SecondEnd : std::uint8_t {
  over,       ///< stopped
  takes_over  ///< the copy is closed, and ready to be served
};

/// Follows until the one or the other. An error where the first refuses the token, or the copy cannot be written.
Result<SecondEnd> follow(const SecondOptions& options);

}  // namespace bl::serve
