// A client of a running server, with all that it was told.
#pragma once

#include <optional>
#include <vector>

#include <nlohmann/json.hpp>

#include "core/define/json_text.h"
#include "core/serve/client.h"
#include "tests/core/serve/running_server.h"

namespace bl::serve {

using namespace std::chrono_literals;

struct Talk {
  explicit Talk(const RoomAddress& address, const std::string& authorities = "", ConnectsAs as = ConnectsAs::window)
      : client(address, bell.ring(), authorities, as) {}

  template <class IsOver>
  bool wait(const IsOver& is_over, std::chrono::seconds most = 60s) {
    const auto end = std::chrono::steady_clock::now() + most;
    while (true) {
      for (Happening& happening : client.take()) {
        if (std::holds_alternative<Opened>(happening)) is_open = true;
        if (const auto* frame = std::get_if<Arrived>(&happening)) frames.push_back(*parse_json(frame->frame));
        if (const auto* closing = std::get_if<Closed>(&happening)) closed = *closing;
      }
      if (is_over()) return true;
      if (closed || std::chrono::steady_clock::now() > end) return false;
      bell.wait(100ms);
    }
  }
  const Json* last(const char* t) const {
    for (auto frame = frames.rbegin(); frame != frames.rend(); ++frame)
      if ((*frame)["t"] == t) return &*frame;
    return nullptr;
  }
  bool wait_for(const char* t) {
    return wait([&] { return last(t) != nullptr; });
  }
  bool wait_for_end() {
    return wait([&] { return closed.has_value(); });
  }

  Bell bell;
  bool is_open = false;
  std::vector<Json> frames;
  std::optional<Closed> closed;
  Client client;  // last: it ends before what it rings
};

inline std::string hello(const std::string& invite, const std::string& run = "a window", const std::string& kind = "desktop") {
  const Json json = {{"t", "hello"}, {"room", "BKRT"}, {"kind", kind}, {"run", run}, {"invite", invite}, {"views", {"room"}}};
  return json.dump();
}

inline RoomAddress address_of(const RunningServer& server) {
  return {.host = "127.0.0.1", .port = server.port(), .code = "BKRT", .invite = "", .is_secure = false};
}

}  // namespace bl::serve
