// The sun's way over one day of a place: rise, transit, set, how long it is up, and moments to look at it.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "core/sun/solar_position.h"

namespace bl::sun {

/// A stretch of time between two moments of universal time.
struct SunSpan {
  double begin = 0, end = 0;
};

/// Positions of the sun in a stretch of at most 27 hours, from five exact ones: what the earth sees changes so evenly that the
/// polynomial through them is right to 1e-7 degrees, at a hundredth of the effort.
class SunTrack {
 public:
  SunTrack(const SunPlace& place, SunSpan span);
  EarthView view(double moment) const;
  SunPosition position(double moment) const { return sun_position(place_, view(moment)); }
  const SunPlace& place() const { return place_; }
  SunSpan span() const { return span_; }

  /// Where the disc's centre is at least so high. `kHorizon` is told as sunrise is, from the middle of the earth without
  /// refraction; any other limit [degree] is one of the altitude at the place, refracted where the place says so.
  std::vector<SunSpan> above(double limit) const;
  /// The moment in the middle of the day at which the sun crosses the meridian; in a day of 24 hours there may be none.
  std::optional<double> transit() const;

 private:
  double height(double moment, double limit) const;
  double crossing(double low, double high, double limit) const;

  SunPlace place_;
  SunSpan span_;
  std::array<EarthView, 5> knots_;
};

/// One day by the local clock; times are seconds after its midnight.
struct SunDay {
  std::optional<double> sunrise, transit, sunset;  ///< the first rise, the last set; nothing where there is none
  double transit_altitude = 0;                     ///< as the place says, refracted or not [degree]
  double day_length = 0;                           ///< between rises and sets, within the day [s]
};
SunTrack track_of(const SunPlace& place, DayNumber day);
SunDay sun_day(const SunPlace& place, DayNumber day);

/// Which moments a study looks at.
struct SunPeriod {
  DayNumber first = 0, last = 0;
  int day_step = 1;                       ///< every so many days
  double step = 600;                      ///< [s]
  double lowest_altitude = 0;             ///< lower sun does not count [degree]
  double from_time = 0, to_time = 86400;  ///< by the local clock [s]
};

/// A moment that stands for a stretch of time around it.
struct SunMoment {
  double moment = 0;
  Vector3 toward;      ///< unit vector of the scene towards the sun
  double seconds = 0;  ///< the stretch, divided by the number of days: sums are means per day
  double altitude = 0;
};
/// The day is cut into steps from midnight on; each step counts for as long as the sun is high enough in it, and is looked at in
/// the middle of that time. The sum of the seconds is therefore exact, whatever the step.
Result<std::vector<SunMoment>> sun_moments(const SunPlace& place, const SunPeriod& period);
/// Seconds per day for which the sun is high enough.
double possible_sun(std::span<const SunMoment> moments);

}  // namespace bl::sun
