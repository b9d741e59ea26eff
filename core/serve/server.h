// One port for pages and connections: HTTP and WebSocket on one thread.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "core/serve/pages.h"

namespace bl::serve {

struct ServerOptions {
  std::string address = "0.0.0.0";
  std::uint16_t port = 8080;     ///< 0: any free one
  std::string page_folder;       ///< of the built page; may be empty
  std::string certificate, key;  ///< PEM files; both for TLS, or neither
  std::string watched_folder =
      {};             ///< of the session files: how much is free there, and how this computer is, is told; empty: nothing
  std::string proxy;  ///< the address of a proxy in front of the server; what it says of those it asks for is believed
};

class Server {
 public:
  /// Binds the port. Rooms are added before run().
  static Result<std::unique_ptr<Server>> open(const ServerOptions& options);
  virtual ~Server() = default;

  virtual std::uint16_t port() const = 0;
  virtual Rooms& rooms() = 0;
  /// How this computer is, and by which of its addresses others have come. On the thread of run().
  virtual Surroundings surroundings() const = 0;
  /// Runs a task on the thread of run(); from any thread.
  virtual void post(std::function<void()> task) = 0;
  /// Serves until stop(); then closes the rooms in order.
  virtual void run() = 0;
  /// From any thread, and from signal handlers' threads.
  virtual void stop() = 0;
};

}  // namespace bl::serve
