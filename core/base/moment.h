// Moments of the calendar as text.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace bl {

/// "2026-03-01 09:30 UTC" of milliseconds since 1970, or "2026-03-01 10:30 +01:00" by clocks that are so many minutes ahead of
/// UTC; empty where no calendar has that year.
std::string moment_text(std::int64_t milliseconds, int minutes_ahead = 0);
/// "UTC", "+01:00".
std::string zone_text(int minutes_ahead);
/// The minutes of such a text; nothing where it is none, or more than 14 hours. Names of places are none: what they mean changes
/// with each machine's tables.
std::optional<int> read_zone(std::string_view text);

}  // namespace bl
