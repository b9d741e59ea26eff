// Where the sun stands: the algorithm SPA of NREL (Reda and Andreas 2004), good to 0.0003 degrees.
#pragma once

#include "core/sun/sun_place.h"

namespace bl::sun {

/// The sun as seen from the middle of the earth, at a moment of universal time.
struct EarthView {
  double right_ascension = 0, declination = 0;  ///< apparent [degree]
  double sidereal_time = 0;                     ///< at Greenwich, apparent [degree]
  double distance = 1;                          ///< [astronomical units]
  double equation_of_time = 0;                  ///< sundial less clock [s]
};
EarthView earth_view(double moment, double delta_t);

/// The sun as seen from a place.
struct SunPosition {
  double azimuth = 0;             ///< clockwise from true north [degree, 0 to 360]
  double altitude = 0;            ///< of the disc's centre; refracted where the place says so [degree]
  double geometric_altitude = 0;  ///< without refraction [degree]
};
SunPosition sun_position(const SunPlace& place, double moment);
/// The same from what is seen from the middle of the earth.
SunPosition sun_position(const SunPlace& place, const EarthView& view);

/// How far air lifts the sun's disc at a geometric altitude [degree]; nothing where no part of it is above the horizon.
double refraction(double geometric_altitude, double pressure, double temperature);
/// Of the disc's centre as seen from the middle of the earth, without refraction: what sunrise and sunset are told by [degree].
double earth_altitude(const SunPlace& place, const EarthView& view);
/// East of the meridian negative, in (-180, 180] [degree]; 0 is the transit.
double hour_angle(const SunPlace& place, const EarthView& view);

/// Sunrise and sunset: the upper edge of the disc (16') at the horizon, lifted by standard refraction (34') [degree].
inline constexpr double kHorizon = -0.8333;

}  // namespace bl::sun
