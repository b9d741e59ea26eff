// Somebody who is connected to a room, without what connects them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

namespace bl::serve {

/// Why a connection is closed, as the page is told.
enum class CloseCode : std::uint16_t {
  bad_frame = 4400,
  no_seat = 4401,
  removed = 4403,
  no_hello = 4408,
  replaced = 4409,
  too_large = 4413,
  flood = 4429,
  draining = 4503
};

class Guest {
 public:
  virtual ~Guest() = default;
  /// Frames are shared by all who get the same one.
  virtual void send(std::shared_ptr<const std::string> frame) = 0;
  virtual void close(CloseCode code, const std::string& why) = 0;
  /// What the other side has not taken yet [bytes].
  virtual std::size_t unsent() const = 0;
};

}  // namespace bl::serve
