// Where and by which clock the sun is looked at: coordinates, true north, time zone, daylight saving, air. The one place for
// them.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "core/base/result.h"
#include "core/base/vector.h"

namespace bl::sun {

/// When clocks are an hour ahead of the zone's standard time. Rules as they are in force today, for all years.
enum class DaylightSaving {
  none,
  europe,         ///< last Sunday of March to last Sunday of October, both at 01:00 UTC
  north_america,  ///< second Sunday of March, 02:00, to first Sunday of November, 02:00, by the clock
  australia,      ///< first Sunday of October, 02:00, to first Sunday of April, 03:00, by the clock
};

/// A place on earth and how time and directions are told there.
struct SunPlace {
  double latitude = 52.0, longitude = 4.36;  ///< north and east positive [degree]
  double elevation = 0;                      ///< above the sea [m]
  double true_north = 0;                     ///< clockwise from the scene's y axis to true north [degree]
  double utc_offset = 0;                     ///< standard time less UTC [s]
  DaylightSaving daylight_saving = DaylightSaving::none;
  double delta_t = 69;         ///< terrestrial time less UT [s]; 69 s in the 2020s
  bool has_refraction = true;  ///< do altitudes include the bending of light by the air?
  double pressure = 101325;    ///< mean of the year [Pa]
  double temperature = 12;     ///< mean of the year [°C]
  bool operator==(const SunPlace&) const = default;
};

/// A day of the Gregorian calendar as its number: the Julian day at noon.
using DayNumber = std::int64_t;
struct Date {
  int year = 2000, month = 1, day = 1;
  bool operator==(const Date&) const = default;
};
DayNumber day_number(const Date& date);
Date date_of(DayNumber day);
/// "2026-03-21"; years 1900 to 2100, for which daylight saving and the clocks are meant.
Result<DayNumber> parse_date(std::string_view text);
std::string date_text(DayNumber day);

/// A moment is a Julian day of universal time.
/// The moment at which the local clock shows `seconds` after midnight of the day. A time that is skipped in spring is read as
/// standard time, one that comes twice in autumn as the first.
double moment_of(const SunPlace& place, DayNumber day, double seconds);
/// What the local clock shows at a moment, in seconds after midnight of that day (more than 86400 on the next one).
double clock_at(const SunPlace& place, DayNumber day, double moment);

/// From a compass direction (0 north, 90 east) and an altitude [degree] to a unit vector of the scene (z up).
Vector3 scene_direction(const SunPlace& place, double azimuth, double altitude);

}  // namespace bl::sun
