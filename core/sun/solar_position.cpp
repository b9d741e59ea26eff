// From periodic terms to the sun's place in the sky: apparent coordinates, parallax, refraction.
#include "core/sun/solar_position.h"

#include <algorithm>
#include <cmath>

#include "core/base/mathematics.h"
#include "core/sun/solar_terms.h"

namespace bl::sun {

namespace {

constexpr double kRadian = 0.017453292519943295;
constexpr double kEpoch = 2451545;  // 2000-01-01 12:00

double sine(double degrees) { return mathematics::sine(degrees * kRadian); }
double cosine(double degrees) { return mathematics::cosine(degrees * kRadian); }
double arc_sine(double x) { return mathematics::arc_sine(std::clamp(x, -1.0, 1.0)) / kRadian; }

// Into [0, 360).
double turned(double degrees) {
  const double rest = degrees - 360 * std::floor(degrees / 360);
  return rest < 360 ? rest : 0;
}
// Into (-180, 180].
double half_turned(double degrees) { return 180 - turned(180 - degrees); }

}  // namespace

EarthView earth_view(double moment, double delta_t) {
  const double centuries = (moment + delta_t / 86400 - kEpoch) / 36525, millennia = centuries / 10;
  const EarthOrbit orbit = earth_orbit(millennia);
  const Nutation sway = nutation(centuries);
  const double obliquity = mean_obliquity(millennia) + sway.obliquity;
  const double aberration = -20.4898 / (3600 * orbit.distance);
  const double longitude = turned(orbit.longitude + 180) + sway.longitude + aberration, latitude = -orbit.latitude;
  EarthView view;
  view.distance = orbit.distance;
  view.right_ascension = turned(
      mathematics::arc_tangent(sine(longitude) * cosine(obliquity) - mathematics::tangent(latitude * kRadian) * sine(obliquity),
                               cosine(longitude)) /
      kRadian);
  view.declination = arc_sine(sine(latitude) * cosine(obliquity) + cosine(latitude) * sine(obliquity) * sine(longitude));
  const double days = moment - kEpoch, universal = days / 36525;
  const double mean = 280.46061837 + 360.98564736629 * days + universal * universal * (0.000387933 - universal / 38710000);
  view.sidereal_time = turned(mean + sway.longitude * cosine(obliquity));
  // A degree is 240 s; 0.0057183 degrees is the aberration that the mean longitude contains.
  view.equation_of_time =
      240 * half_turned(mean_longitude(millennia) - 0.0057183 - view.right_ascension + sway.longitude * cosine(obliquity));
  return view;
}

double hour_angle(const SunPlace& place, const EarthView& view) {
  return half_turned(view.sidereal_time + place.longitude - view.right_ascension);
}

double earth_altitude(const SunPlace& place, const EarthView& view) {
  return arc_sine(sine(place.latitude) * sine(view.declination) +
                  cosine(place.latitude) * cosine(view.declination) * cosine(hour_angle(place, view)));
}

double refraction(double geometric_altitude, double pressure, double temperature) {
  constexpr double kDisc = 0.26667, kAtHorizon = 0.5667;
  if (geometric_altitude < -(kDisc + kAtHorizon)) return 0;
  const double bend = 1.02 / (60 * mathematics::tangent((geometric_altitude + 10.3 / (geometric_altitude + 5.11)) * kRadian));
  return pressure / 101000 * (283 / (273 + temperature)) * bend;
}

SunPosition sun_position(const SunPlace& place, const EarthView& view) {
  constexpr double kFlattened = 0.99664719, kEarthRadius = 6378140;
  const double parallax = 8.794 / (3600 * view.distance);
  const double reduced = mathematics::arc_tangent(kFlattened * mathematics::tangent(place.latitude * kRadian));
  const double raised = place.elevation / kEarthRadius;
  const double out = mathematics::cosine(reduced) + raised * cosine(place.latitude),
               north = kFlattened * mathematics::sine(reduced) + raised * sine(place.latitude);
  const double angle = hour_angle(place, view);
  const double across = cosine(view.declination) - out * sine(parallax) * cosine(angle);
  const double shift = mathematics::arc_tangent(-out * sine(parallax) * sine(angle), across);
  const double declination =
      mathematics::arc_tangent((sine(view.declination) - north * sine(parallax)) * mathematics::cosine(shift), across);
  const double seen = angle * kRadian - shift;
  SunPosition position;
  position.geometric_altitude = arc_sine(sine(place.latitude) * mathematics::sine(declination) +
                                         cosine(place.latitude) * mathematics::cosine(declination) * mathematics::cosine(seen));
  position.altitude = position.geometric_altitude;
  if (place.has_refraction) position.altitude += refraction(position.geometric_altitude, place.pressure, place.temperature);
  const double from_south =
      mathematics::arc_tangent(mathematics::sine(seen), mathematics::cosine(seen) * sine(place.latitude) -
                                                            mathematics::tangent(declination) * cosine(place.latitude));
  position.azimuth = turned(from_south / kRadian + 180);
  return position;
}

SunPosition sun_position(const SunPlace& place, double moment) { return sun_position(place, earth_view(moment, place.delta_t)); }

}  // namespace bl::sun
