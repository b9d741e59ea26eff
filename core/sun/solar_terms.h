// The earth's motion around the sun as sums of periodic terms: heliocentric coordinates, nutation, obliquity.
#pragma once

namespace bl::sun {

/// Where the earth is, seen from the sun: longitude and latitude in the ecliptic [degree], not reduced to one turn, and distance
/// [astronomical units].
struct EarthOrbit {
  double longitude = 0, latitude = 0, distance = 1;
};
/// `millennia`: Julian millennia of terrestrial time since 2000-01-01 12:00.
EarthOrbit earth_orbit(double millennia);

/// The sway of the earth's axis [degree], `centuries`: Julian centuries of terrestrial time since 2000-01-01 12:00.
struct Nutation {
  double longitude = 0, obliquity = 0;
};
Nutation nutation(double centuries);

/// Inclination of the earth's axis without nutation [degree].
double mean_obliquity(double millennia);
/// The sun's mean longitude [degree], not reduced to one turn: what clocks follow.
double mean_longitude(double millennia);

}  // namespace bl::sun
