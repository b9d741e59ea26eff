// The address of a room, as it stands in a QR code or in an e-mail.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "core/base/result.h"

namespace bl::serve {

struct RoomAddress {
  std::string host;  ///< a name, or an address without brackets
  std::uint16_t port = 8080;
  std::string code;    ///< in capitals
  std::string invite;  ///< may be empty: who comes by the code alone
  bool is_secure = false;

  /// `HOST:PORT`, with brackets around an IPv6 address, as the field Host wants it.
  std::string host_and_port() const;
  bool operator==(const RoomAddress&) const = default;
};

/// Reads `room://HOST[:PORT]/CODE[#k=INVITE]`, and the same with http:// or https://, as the QR code has it. Without a port,
/// rooms are at 8080, and pages where their protocol has them.
Result<RoomAddress> room_address(std::string_view text);

}  // namespace bl::serve
