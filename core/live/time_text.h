// Times as recorded tables write them, as seconds.
#pragma once

#include <optional>
#include <string_view>

namespace bl::live {

/// Seconds since 1970-01-01 00:00, of `2003-01-31T12:00:00Z` (or with a space, without seconds, with an offset such as +01:00, or
/// the day alone), of `31-Jan-2003`, or of a plain number of seconds. Without an offset, the table's own clock counts.
std::optional<double> seconds_of_time(std::string_view text);

/// Seconds since 1970 of a day from 1900 to 2199 without anything between its parts: `20030131`, `2003013112`, `200301311230` or
/// `20030131123059`. Only a whole column of them tells such days from plain numbers.
std::optional<double> seconds_of_digits(std::string_view text);

/// Seconds since midnight, of `14:30`, `14:30:15`, or a plain number of hours.
std::optional<double> seconds_of_day(std::string_view text);

}  // namespace bl::live
