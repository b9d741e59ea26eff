// Who is in a room, as its server says: seats, areas with their pens, and where everybody is.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/base/vector.h"
#include "core/define/json_text.h"
#include "core/define/payload.h"

namespace bl::guest {

struct Person {
  std::string role, name, colour;  ///< `colour` such as `#1b9e77`
  bool is_here = false;
  bool operator==(const Person&) const = default;
};

/// Where somebody is, and what they hold.
struct Whereabouts {
  std::optional<Vector3> cursor = {};  ///< [m]
  std::vector<std::string> holds = {};
  JsonValue camera = JsonValue::null();
  bool is_hidden = false;
};

struct PenArea {
  std::int64_t holder = 0;  ///< the seat that has its pen; 0: nobody
  std::vector<std::int64_t> asking = {};
};

/// The text of that key; empty where there is none.
std::string text_in(const Json& json, const char* key);
/// The whole number under that key; `otherwise` where there is none.
std::int64_t number_in(const Json& json, const char* key, std::int64_t otherwise);

struct People {
  std::map<std::int64_t, Person> seats = {};
  std::map<std::string, PenArea> areas = {};
  std::map<std::int64_t, Whereabouts> whereabouts = {};
  std::string title = {};
  bool is_paused = false, is_closed = false;
  double rate = 10;

  /// A change of the view `room`: keys with their new content.
  void take_view(const Json& set);
  /// By seat; null for somebody who is gone.
  void take_presence(const Json& by_seat);
  /// The name of an author of the log: of the seat, or the author itself.
  std::string name_of(const std::string& author) const;
};

}  // namespace bl::guest
