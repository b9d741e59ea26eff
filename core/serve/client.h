// The other end of a room's WebSocket, for windows and for whoever follows a room.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "core/serve/room_address.h"

namespace bl::serve {

/// The room can be talked to. Frames that were sent before this go out now.
struct Opened {};
struct Arrived {
  std::string frame;
};
/// The connection has ended or never came to be; nothing happens after it.
struct Closed {
  int code = 0;  ///< as in CloseCode, or of RFC 6455; 0: broken, or not opened at all
  std::string why;
};
using Happening = std::variant<Opened, Arrived, Closed>;

/// Who connects, as servers see it: a page says which site it is from (Origin). A server lets pages in by the code of a room
/// alone.
enum class ConnectsAs { window, page };

/// One connection, on a thread of its own. Whoever wants to come back makes another one.
class Client {
 public:
  /// `wake` is called on that thread after something has happened, and never after the destructor has returned. `authorities` is
  /// a PEM file of those whose certificates are believed; empty: the system's.
  Client(const RoomAddress& address, std::function<void()> wake, std::string authorities = {},
         ConnectsAs as = ConnectsAs::window);
  /// Sends what waits, says goodbye, and gives both a second.
  ~Client();
  Client(const Client&) = delete;
  Client& operator=(const Client&) = delete;

  /// One text frame. From any thread.
  void send(std::string frame);
  /// What has happened since the last call. From any thread.
  std::vector<Happening> take();

 private:
  struct Core;
  struct Finish;
  std::shared_ptr<Core> core_;
  std::unique_ptr<Finish> finish_;
};

}  // namespace bl::serve
