// Reads times without the system's calendar, so that every machine reads them alike.
#include "core/live/time_text.h"

#include <array>
#include <cmath>

#include "core/base/text.h"
#include "core/csv/csv_reader.h"

namespace bl::live {

namespace {

// Takes so many digits off the front of `text`.
std::optional<int> digits(std::string_view& text, std::size_t count) {
  if (text.size() < count) return std::nullopt;
  int number = 0;
  for (std::size_t i = 0; i < count; ++i) {
    if (text[i] < '0' || text[i] > '9') return std::nullopt;
    number = 10 * number + (text[i] - '0');
  }
  text.remove_prefix(count);
  return number;
}

bool take(std::string_view& text, char letter) {
  if (!text.starts_with(letter)) return false;
  text.remove_prefix(1);
  return true;
}

// Days from 1970-01-01 in the Gregorian calendar: whole years of 365 days and the leap days between, counted from March.
std::optional<double> days(int year, int month, int day) {
  constexpr std::array<int, 12> kLengths = {31, 29, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31};
  if (month < 1 || month > 12 || day < 1 || day > kLengths[static_cast<std::size_t>(month - 1)]) return std::nullopt;
  const bool is_leap = (year % 4 == 0 && year % 100 != 0) || year % 400 == 0;
  if (month == 2 && day == 29 && !is_leap) return std::nullopt;
  const int y = month > 2 ? year : year - 1, m = month > 2 ? month - 3 : month + 9;
  const int since_march = (153 * m + 2) / 5 + day - 1;
  return 365.0 * y + std::floor(y / 4.0) - std::floor(y / 100.0) + std::floor(y / 400.0) + since_march - 719468;
}

// No day is longer than 24 hours; the last second of one may be a leap second.
bool is_clock(int hour, int minute, double second) {
  if (hour == 24) return minute == 0 && second == 0;
  const double longest = hour == 23 && minute == 59 ? 61 : 60;
  return hour < 24 && minute < 60 && second < longest;
}

// hh:mm[:ss[.f]] off the front.
std::optional<double> clock(std::string_view& text) {
  const auto hour = digits(text, 2);
  if (!hour || !take(text, ':')) return std::nullopt;
  const auto minute = digits(text, 2);
  if (!minute) return std::nullopt;
  double second = 0;
  if (take(text, ':')) {
    std::size_t length = 0;
    while (length < text.size() && ((text[length] >= '0' && text[length] <= '9') || text[length] == '.')) ++length;
    const auto number = parse_number(text.substr(0, length));
    if (!number) return std::nullopt;
    second = *number;
    text.remove_prefix(length);
  }
  if (!is_clock(*hour, *minute, second)) return std::nullopt;
  return 3600.0 * *hour + 60.0 * *minute + second;
}

// Z, +01:00, -0530 or nothing: what has to be taken away to reach UTC.
std::optional<double> zone(std::string_view text) {
  if (text.empty() || text == "Z" || text == "z") return 0;
  const double sign = text.front() == '-' ? -1 : 1;
  if (!take(text, '+') && !take(text, '-')) return std::nullopt;
  const auto hours = digits(text, 2);
  take(text, ':');
  const auto minutes = text.empty() ? std::optional(0) : digits(text, 2);
  // No clock on Earth is further from UTC than 14 hours.
  if (!hours || !minutes || !text.empty() || *minutes > 59 || 60 * *hours + *minutes > 14 * 60) return std::nullopt;
  return sign * (3600.0 * *hours + 60.0 * *minutes);
}

std::optional<double> rest_of(double day, std::string_view text) {
  if (text.empty()) return 86400 * day;
  if (!take(text, 'T') && !take(text, ' ')) return std::nullopt;
  const auto time = clock(text);
  const auto offset = time ? zone(csv::trimmed(text)) : std::nullopt;
  if (!offset) return std::nullopt;
  return 86400 * day + *time - *offset;
}

// 31-Jan-2003, with one digit or two.
std::optional<double> named_month(std::string_view text) {
  constexpr std::array<std::string_view, 12> kNames = {"jan", "feb", "mar", "apr", "may", "jun",
                                                       "jul", "aug", "sep", "oct", "nov", "dec"};
  const auto day = digits(text, text.find('-') == 1 ? 1 : 2);
  if (!day || !take(text, '-') || text.size() < 8) return std::nullopt;
  const std::string name = lower_case(text.substr(0, 3));
  text.remove_prefix(3);
  if (!take(text, '-')) return std::nullopt;
  const auto year = digits(text, 4);
  for (std::size_t month = 0; year && month < kNames.size(); ++month)
    if (name == kNames[month]) {
      const auto number = days(*year, static_cast<int>(month) + 1, *day);
      return number ? rest_of(*number, text) : std::nullopt;
    }
  return std::nullopt;
}

}  // namespace

std::optional<double> seconds_of_time(std::string_view text) {
  text = csv::trimmed(text);
  if (const auto number = parse_number(text)) return number;
  if (const auto found = named_month(text)) return found;
  const auto year = digits(text, 4);
  if (!year || !take(text, '-')) return std::nullopt;
  const auto month = digits(text, 2);
  if (!month || !take(text, '-')) return std::nullopt;
  const auto day = digits(text, 2);
  const auto number = day ? days(*year, *month, *day) : std::nullopt;
  return number ? rest_of(*number, text) : std::nullopt;
}

std::optional<double> seconds_of_digits(std::string_view text) {
  text = csv::trimmed(text);
  if (text.size() < 8 || text.size() > 14 || text.size() % 2 != 0) return std::nullopt;
  const auto year = digits(text, 4), month = digits(text, 2), day = digits(text, 2);
  if (!year || !month || !day || *year < 1900 || *year > 2199) return std::nullopt;
  const auto number = days(*year, *month, *day);
  const auto part = [&] { return text.empty() ? std::optional(0) : digits(text, 2); };
  const auto hour = part(), minute = part(), second = part();
  if (!number || !hour || !minute || !second || !is_clock(*hour, *minute, *second)) return std::nullopt;
  return 86400 * *number + 3600.0 * *hour + 60.0 * *minute + *second;
}

std::optional<double> seconds_of_day(std::string_view text) {
  text = csv::trimmed(text);
  if (const auto hours = parse_number(text)) return 3600 * *hours;
  const auto time = clock(text);
  return time && text.empty() ? time : std::nullopt;
}

}  // namespace bl::live
