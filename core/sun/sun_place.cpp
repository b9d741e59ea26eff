// Dates, local clocks and directions of a place, as functions of their arguments alone.
#include "core/sun/sun_place.h"

#include <algorithm>
#include <cmath>

#include "core/base/mathematics.h"

namespace bl::sun {

namespace {

constexpr double kSecondsOfDay = 86400;

// Monday 0 ... Sunday 6.
int weekday(DayNumber day) { return static_cast<int>(day % 7); }

DayNumber sunday(int year, int month, int which) {
  const DayNumber first = day_number({year, month, 1});
  return first + (6 - weekday(first)) + 7 * (which - 1);
}

DayNumber last_sunday(int year, int month) {
  const DayNumber last = day_number({month == 12 ? year + 1 : year, month == 12 ? 1 : month + 1, 1}) - 1;
  return last - (weekday(last) + 1) % 7;
}

// Begin and end of daylight saving in a year, as moments of universal time; the other way round in the south.
struct Switches {
  double begin, end;
};

Switches switches_of(const SunPlace& place, int year) {
  const auto universal = [](DayNumber day, double seconds) { return static_cast<double>(day) - 0.5 + seconds / kSecondsOfDay; };
  const double zone = place.utc_offset, hour = 3600;
  switch (place.daylight_saving) {
    case DaylightSaving::europe: return {universal(last_sunday(year, 3), hour), universal(last_sunday(year, 10), hour)};
    case DaylightSaving::north_america:
      return {universal(sunday(year, 3, 2), 2 * hour - zone), universal(sunday(year, 11, 1), hour - zone)};
    case DaylightSaving::australia:
      return {universal(sunday(year, 10, 1), 2 * hour - zone), universal(sunday(year, 4, 1), 2 * hour - zone)};
    case DaylightSaving::none: break;
  }
  return {0, 0};
}

// How far local clocks are ahead of UTC at a moment [s].
double clock_offset(const SunPlace& place, double moment) {
  if (place.daylight_saving == DaylightSaving::none) return place.utc_offset;
  const int year = date_of(static_cast<DayNumber>(std::floor(moment + 0.5 + place.utc_offset / kSecondsOfDay))).year;
  const auto [begin, end] = switches_of(place, year);
  const bool is_summer = begin < end ? moment >= begin && moment < end : moment >= begin || moment < end;
  return place.utc_offset + (is_summer ? 3600 : 0);
}

}  // namespace

// The usual integer arithmetic over a year that begins in March, in eras of 400 years.
DayNumber day_number(const Date& date) {
  const std::int64_t year = date.month <= 2 ? date.year - 1 : date.year;
  const std::int64_t era = (year >= 0 ? year : year - 399) / 400, of_era = year - era * 400;
  const std::int64_t of_year = (153 * (date.month + (date.month > 2 ? -3 : 9)) + 2) / 5 + date.day - 1;
  const std::int64_t day_of_era = of_era * 365 + of_era / 4 - of_era / 100 + of_year;
  return era * 146097 + day_of_era + 1721120;
}

Date date_of(DayNumber day) {
  const std::int64_t count = day - 1721120;
  const std::int64_t era = (count >= 0 ? count : count - 146096) / 146097, day_of_era = count - era * 146097;
  const std::int64_t of_era = (day_of_era - day_of_era / 1460 + day_of_era / 36524 - day_of_era / 146096) / 365;
  const std::int64_t of_year = day_of_era - (365 * of_era + of_era / 4 - of_era / 100), part = (5 * of_year + 2) / 153;
  const int month = static_cast<int>(part < 10 ? part + 3 : part - 9);
  return {static_cast<int>(of_era + era * 400 + (month <= 2 ? 1 : 0)), month,
          static_cast<int>(of_year - (153 * part + 2) / 5 + 1)};
}

Result<DayNumber> parse_date(std::string_view text) {
  const Error fault{ErrorCode::parse, "", "`" + std::string(text) + "` is no date: write year, month and day as 2026-03-21"};
  if (text.size() != 10 || text[4] != '-' || text[7] != '-') return fault;
  for (const std::size_t i : {0, 1, 2, 3, 5, 6, 8, 9})
    if (text[i] < '0' || text[i] > '9') return fault;
  const auto digits = [&](std::size_t from, std::size_t count) {
    int value = 0;
    for (std::size_t i = from; i < from + count; ++i) value = 10 * value + (text[i] - '0');
    return value;
  };
  const Date date{digits(0, 4), digits(5, 2), digits(8, 2)};
  if (date.month < 1 || date.month > 12 || date.day < 1 || date.day > 31 || date_of(day_number(date)) != date) return fault;
  if (date.year < 1900 || date.year > 2100)
    return Error{ErrorCode::out_of_range, "", "the year " + std::to_string(date.year) + " is outside 1900 to 2100"};
  return day_number(date);
}

std::string date_text(DayNumber day) {
  const Date date = date_of(day);
  const auto padded = [](int value, std::size_t width) {
    std::string text = std::to_string(value);
    return std::string(width - std::min(width, text.size()), '0') + text;
  };
  return padded(date.year, 4) + "-" + padded(date.month, 2) + "-" + padded(date.day, 2);
}

double moment_of(const SunPlace& place, DayNumber day, double seconds) {
  const double standard = static_cast<double>(day) - 0.5 + (seconds - place.utc_offset) / kSecondsOfDay;
  if (place.daylight_saving == DaylightSaving::none) return standard;
  const double summer = standard - 3600 / kSecondsOfDay;
  return clock_offset(place, summer) > place.utc_offset ? summer : standard;
}

double clock_at(const SunPlace& place, DayNumber day, double moment) {
  return (moment - (static_cast<double>(day) - 0.5)) * kSecondsOfDay + clock_offset(place, moment);
}

Vector3 scene_direction(const SunPlace& place, double azimuth, double altitude) {
  constexpr double kDegree = 0.017453292519943295;
  const double turn = (azimuth + place.true_north) * kDegree, up = altitude * kDegree;
  // Rounded to 2^-40, far below any angle that matters: the sun in the south stands exactly there.
  const auto steady = [](double x) { return std::round(x * 0x1p40) * 0x1p-40; };
  return {steady(mathematics::cosine(up) * mathematics::sine(turn)), steady(mathematics::cosine(up) * mathematics::cosine(turn)),
          steady(mathematics::sine(up))};
}

}  // namespace bl::sun
