// What the server answers to requests: the built page, the state of health, and pages without scripts.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>

#include "core/serve/http.h"
#include "core/serve/room_host.h"

namespace bl::serve {

using Rooms = std::map<std::string, std::unique_ptr<RoomHost>>;

class Pages {
 public:
  /// `folder` holds the built page; where it is empty or has no index.html, the pages without scripts take its place.
  /// `surroundings` may be none.
  Pages(Rooms& rooms, std::string folder, std::function<Surroundings()> surroundings = {})
      : rooms_(&rooms), folder_(std::move(folder)), surroundings_(std::move(surroundings)) {}

  /// Calls back once, perhaps later: what a form says is stored first.
  void answer(const Request& request, const Reply& reply);

 private:
  Response door(const std::string& mistaken = "") const;  ///< where a code is typed, and which one is of no room
  Response health(bool is_local) const;
  Response qr(const std::string& name, const Request& request) const;
  void minutes(const Request& request, const Reply& reply) const;
  void plan_file(const Request& request, const Reply& reply) const;
  Response file(const std::string& path, bool is_immutable, bool takes_gzip) const;
  void plain(RoomHost& room, const Request& request, const std::string& what, const Reply& reply);

  Rooms* rooms_;
  std::string folder_;
  std::function<Surroundings()> surroundings_;
};

}  // namespace bl::serve
