// What a room's server and a laptop that follows it say to each other. Bytes travel as text, because all frames are text.
#pragma once

#include <cstdint>
#include <string>

#include "core/wire/message_builder.h"

namespace bl::serve {

/// From the follower, after its hello: the copy may begin.
struct Follow {
  bool is_safe = false;  ///< answers wait for this laptop as well
  std::string address;   ///< where pages find the room once this laptop has taken it over; empty: it does not know
  static void declare(wire::MessageBuilder<Follow>& m);
};
/// From the server: a part of the session file.
struct CopyPart {
  std::int64_t n = 0;  ///< the number of the last change that is in it
  std::string part, digest;
  std::int64_t size = 0;  ///< of the file [bytes]
  bool is_last = false;
  static void declare(wire::MessageBuilder<CopyPart>& m);
};
/// From the server: what has been stored since.
struct Changes {
  std::int64_t n = 0;
  std::string bytes;
  static void declare(wire::MessageBuilder<Changes>& m);
};
/// From the follower: it has stored all up to this one.
struct Kept {
  std::int64_t n = 0;
  static void declare(wire::MessageBuilder<Kept>& m);
};

}  // namespace bl::serve
