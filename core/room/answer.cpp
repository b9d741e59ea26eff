// The names of reasons, as messages and files have them.
#include "core/room/answer.h"

#include <array>

namespace bl::room {

namespace {

constexpr std::array<std::string_view, 16> kNames = {"bad",    "gone",    "right",    "area",   "phase",  "range",
                                                     "budget", "stale",   "conflict", "locked", "closed", "rate",
                                                     "size",   "storage", "draining", "gap"};

}  // namespace

std::string_view name_of(Reason reason) { return kNames[static_cast<std::size_t>(reason)]; }

std::optional<Reason> reason_named(std::string_view name) {
  for (std::size_t k = 0; k < kNames.size(); ++k)
    if (kNames[k] == name) return static_cast<Reason>(k);
  return std::nullopt;
}

}  // namespace bl::room
