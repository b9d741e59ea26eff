// Sockets of the system as owners, and their failures as sentences.
#pragma once

#include <string>

#include "core/base/result.h"
#include "core/live/endpoint.h"

namespace bl::live {

class Socket {
 public:
  explicit Socket(int handle = -1) : handle_(handle) {}
  ~Socket();
  Socket(Socket&& other) noexcept : handle_(other.handle_) { other.handle_ = -1; }
  Socket& operator=(Socket&&) = delete;
  int handle() const { return handle_; }

 private:
  int handle_;
};

/// Does anybody accept connections there? Says why not, within five seconds or when the end is asked for.
Result<void> knock(const Endpoint& endpoint);
/// A socket that hears what is sent to the endpoint's host and port by UDP.
Result<Socket> listen_udp(const Endpoint& endpoint);

}  // namespace bl::live
