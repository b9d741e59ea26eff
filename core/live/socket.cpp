// Connects and listens by the system's calls, without ever waiting longer than can be interrupted.
#include "core/live/socket.h"

#include <fcntl.h>
#include <netdb.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <memory>

namespace bl::live {

namespace {

constexpr int kSocketSlice = 50;  // [ms] between two looks at whether the end is asked for
constexpr int kSlices = 100;      // five seconds in all

using Addresses = std::unique_ptr<addrinfo, decltype(&freeaddrinfo)>;

Result<Addresses> look_up(const Endpoint& endpoint, int kind, bool is_listening) {
  addrinfo wanted{};
  wanted.ai_socktype = kind;
  wanted.ai_flags = AI_NUMERICSERV | (is_listening ? AI_PASSIVE : 0);
  addrinfo* found = nullptr;
  const int problem = getaddrinfo(endpoint.host().c_str(), std::to_string(endpoint.port()).c_str(), &wanted, &found);
  if (problem == 0) return Addresses(found, freeaddrinfo);
  if (problem == EAI_NONAME) return Error{ErrorCode::not_found, "", "no host is called `" + endpoint.host() + "`"};
  return Error{ErrorCode::io, "", "the host `" + endpoint.host() + "` cannot be looked up: " + gai_strerror(problem)};
}

Error failure(const Endpoint& endpoint, int code) {
  switch (code) {
    case ECONNREFUSED: return {ErrorCode::io, "", endpoint.place() + " refuses the connection: nothing listens there"};
    case ETIMEDOUT: return {ErrorCode::io, "", endpoint.place() + " does not answer"};
    case ENETUNREACH:
    case EHOSTUNREACH: return {ErrorCode::io, "", "there is no way to " + endpoint.place()};
    case EADDRINUSE:
      return {ErrorCode::conflict, "", "the port " + std::to_string(endpoint.port()) + " is taken by another program"};
    case EADDRNOTAVAIL:
      return {ErrorCode::not_found, "",
              "`" + endpoint.host() + "` is no address of this computer; leave it out to listen to it alone"};
    case EACCES:
      return {ErrorCode::io, "", "the port " + std::to_string(endpoint.port()) + " may not be used: take one above 1023"};
    default: return {ErrorCode::io, "", endpoint.place() + ": system error " + std::to_string(code)};
  }
}

// 0, or the error number of a connection that is being made.
int outcome_of(int handle, const Endpoint& endpoint) {
  for (int slice = 0; slice < kSlices && !endpoint.is_ending(); ++slice) {
    pollfd watched{handle, POLLOUT, 0};
    if (poll(&watched, 1, kSocketSlice) <= 0) continue;
    int problem = 0;
    socklen_t size = sizeof problem;
    getsockopt(handle, SOL_SOCKET, SO_ERROR, &problem, &size);
    return problem;
  }
  return ETIMEDOUT;
}

}  // namespace

Socket::~Socket() {
  if (handle_ >= 0) close(handle_);
}

Result<void> knock(const Endpoint& endpoint) {
  const auto addresses = look_up(endpoint, SOCK_STREAM, false);
  if (!addresses) return addresses.error();
  int problem = ECONNREFUSED;
  for (const addrinfo* a = addresses->get(); a != nullptr; a = a->ai_next) {
    const Socket socket(::socket(a->ai_family, a->ai_socktype | SOCK_NONBLOCK | SOCK_CLOEXEC, a->ai_protocol));
    if (socket.handle() < 0) continue;
    problem = connect(socket.handle(), a->ai_addr, a->ai_addrlen) == 0 ? 0 : errno;
    if (problem == EINPROGRESS) problem = outcome_of(socket.handle(), endpoint);
    if (problem == 0) return {};
  }
  return failure(endpoint, problem);
}

Result<Socket> listen_udp(const Endpoint& endpoint) {
  const auto addresses = look_up(endpoint, SOCK_DGRAM, true);
  if (!addresses) return addresses.error();
  int problem = EADDRNOTAVAIL;
  for (const addrinfo* a = addresses->get(); a != nullptr; a = a->ai_next) {
    Socket socket(::socket(a->ai_family, a->ai_socktype | SOCK_CLOEXEC, a->ai_protocol));
    if (socket.handle() < 0) continue;
    if (bind(socket.handle(), a->ai_addr, a->ai_addrlen) == 0) return socket;
    problem = errno;
  }
  return failure(endpoint, problem);
}

}  // namespace bl::live
