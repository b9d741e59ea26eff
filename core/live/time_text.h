// Times as recorded tables write them, as seconds.
#pragma once

#include <optional>
#include <string_view>

namespace bl {

/// Seconds since 1970-01-01 00:00, of `2003-01-31T12:00:00Z` (or with a space, without seconds, with an offset such as +01:00, or
/// the day alone), of `31-Jan-2003`, or of a plain number of seconds. Without an offset, the table's own clock counts.
std::optional<double> seconds_of_time(std::string_view text);

/// Seconds since midnight, of `14:30`, `14:30:15`, or a plain number of hours.
std::optional<double> seconds_of_day(std::string_view text);

}  // namespace bl
