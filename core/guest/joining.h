// Joins a room by its address, over the network.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <string_view>

#include "core/guest/room_guest.h"

namespace bl::guest {

/// Is the text meant as the address of a room, rather than as a file?
bool is_room_address(std::string_view text);
/// What an address names, without the key of an invitation: `HOST:PORT/CODE`. A seat is kept under it.
Result<std::string> room_named(std::string_view address);

struct JoinOptions {
  std::string token = {};   ///< of a seat that was taken before
  std::string name = {};    ///< of the person, where they want to give it
  std::string outbox = {};  ///< folder for what has no answer yet; empty: a crash loses it
  int threads = 1;          ///< of the ticks
  std::function<void(const std::string& token)> keep_token = {};
};
/// Begins to connect, and goes on trying. An error only where the address is none.
Result<std::unique_ptr<RoomGuest>> join_room(const Registry& registry, std::string_view address, JoinOptions options);

}  // namespace bl::guest
