// Boost.Beast as the server sees it, and what all of its connections share. Only server.cpp and sockets.cpp include it.
#pragma once

#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/ssl.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <chrono>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>

#include "core/serve/gate.h"
#include "core/serve/pages.h"
#include "core/serve/stream.h"

namespace bl::serve {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;

inline constexpr std::chrono::seconds kHandshake{5};

/// Seconds since a fixed moment.
inline double now() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }
inline std::string_view text_of(beast::string_view text) { return {text.data(), text.size()}; }

/// A connection that is looked after some times a second.
class Watched {
 public:
  virtual ~Watched() = default;
  virtual void watch(double now) = 0;
};

/// What the connections of one server share. All of it belongs to the server's thread.
struct Shared {
  explicit Shared(asio::io_context& the_context) : context(the_context) {}
  asio::io_context& context;
  Rooms rooms;
  std::optional<Pages> pages;
  std::optional<asio::ssl::context> tls;
  std::string proxy;
  Gate gate;
  std::optional<MachineWatch> machine;
  Reach reach;
  /// Outlives the connections, which leave it.
  std::shared_ptr<std::set<Watched*>> watched = std::make_shared<std::set<Watched*>>();
  bool is_stopping = false;
};

/// What every answer has (OWASP ASVS 5.0, V3.4): nothing from elsewhere, nobody's frame, and nothing inline but what has one of
/// these digests.
void add_security(http::fields& fields, const std::string& host, const std::string& inline_sources = "");

/// A connection that wants to be a WebSocket.
struct Visit {
  std::unique_ptr<Gate::Pass> pass;
  std::string address;
  bool has_origin = false;
};
/// Makes it one, and lives as long as it does.
void begin_visit(Stream stream, Shared& shared, Visit visit, const http::request<http::string_body>& request);

}  // namespace bl::serve
