// The sun's place and its rises and sets, against figures and tables that others have published.
#include "core/sun/solar_position.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "tests/core/sun/sun_tables.h"

namespace bl::sun {
namespace {

// Golden, Colorado: the worked example of the report that the algorithm comes from.
SunPlace golden() {
  SunPlace place;
  place.latitude = 39.742476;
  place.longitude = -105.1786;
  place.elevation = 1830.14;
  place.utc_offset = -7 * 3600;
  place.delta_t = 67;
  place.pressure = 82000;
  place.temperature = 11;
  return place;
}

SunPlace at(double latitude, double longitude, double zone_hours) {
  SunPlace place;
  place.latitude = latitude;
  place.longitude = longitude;
  place.utc_offset = zone_hours * 3600;
  return place;
}

TEST(SolarPosition, WorkedExampleOfTheReport) {
  const SunPlace place = golden();
  const double moment = moment_of(place, day_number({2003, 10, 17}), 12 * 3600 + 30 * 60 + 30);
  const EarthView view = earth_view(moment, place.delta_t);
  const SunPosition sun = sun_position(place, moment);
  EXPECT_NEAR(moment, 2452930.312847, 1e-6);
  EXPECT_NEAR(view.declination, -9.31434, 1e-5);
  EXPECT_NEAR(view.right_ascension, 202.22741, 1e-5);
  EXPECT_NEAR(view.distance, 0.9965422974, 1e-9);
  EXPECT_NEAR(hour_angle(place, view), 11.105900, 1e-5);
  EXPECT_NEAR(view.equation_of_time / 60, 14.641503, 1e-4);
  EXPECT_NEAR(sun.geometric_altitude, 39.872046, 1e-5);
  EXPECT_NEAR(sun.altitude, 39.888378, 1e-5);
  EXPECT_NEAR(90 - sun.altitude, 50.11162, 1e-5);
  EXPECT_NEAR(sun.azimuth, 194.340241, 1e-5);
  SunPlace bare = place;
  bare.has_refraction = false;
  EXPECT_EQ(sun_position(bare, moment).altitude, sun.geometric_altitude);
  std::printf("worked example: off by %.1e (no refraction), %.1e (refracted), %.1e (azimuth) degrees\n",
              sun.geometric_altitude - 39.872046, sun.altitude - 39.888378, sun.azimuth - 194.340241);
}

// Figures of the short NOAA formulas for the years they were made for, compared on the sky: high up a degree of azimuth is less
// than one there. In azimuth alone they are themselves up to 0.024 degrees off: for New York they give 159.7214, where this
// algorithm, which the ephemeris below confirms to 0.001, gives 159.7348.
TEST(SolarPosition, CitiesOfTheShortFormulas) {
  const SunPlace york = at(40.72, -74.02, -5), sydney = at(-33.87, 151.22, 10);
  struct Figure {
    SunPlace place;
    Date date;
    double hour, altitude, azimuth;
  };
  for (const Figure& figure : {Figure{york, {2017, 9, 15}, 11, 50.35, 159.72}, Figure{sydney, {2017, 11, 15}, 11, 72.26, 32.37},
                               Figure{sydney, {2019, 6, 21}, 9, 18.99, 42.54}}) {
    const SunPosition sun = sun_position(figure.place, moment_of(figure.place, day_number(figure.date), figure.hour * 3600));
    EXPECT_NEAR(sun.altitude, figure.altitude, 0.01);
    const double across = (sun.azimuth - figure.azimuth) * std::cos(sun.altitude * 0.017453292519943295);
    EXPECT_NEAR(across, 0, 0.01);
    std::printf("%s: off by %.4f up and %.4f across (%.4f in azimuth) degrees\n", date_text(day_number(figure.date)).c_str(),
                sun.altitude - figure.altitude, across, sun.azimuth - figure.azimuth);
  }
  EXPECT_NEAR(sun_position(york, moment_of(york, day_number({2017, 9, 15}), 11 * 3600)).geometric_altitude, 50.34, 0.01);
}

TEST(SolarPosition, AgainstTheEphemerisOfJpl) {
  const auto rows = sun_table("sun_positions_jpl_horizons.csv");
  double azimuth_off = 0, altitude_off = 0, low_off = 0, night_off = 0;
  for (const auto& row : rows) {
    SunPlace place = at(number_in(row, "lat_deg"), number_in(row, "lon_deg_east"), 0);
    place.pressure = 101000;  // as the table was made: refraction of standard air
    place.temperature = 10;
    const std::string& time = row.at("utc");
    const DayNumber day = parse_date(time.substr(0, 10)).value();
    const SunPosition sun = sun_position(place, moment_of(place, day, clock_in(time.substr(11, 8))));
    const double altitude = number_in(row, "sun_altitude_deg_refracted"),
                 azimuth = number_in(row, "sun_azimuth_deg_from_north_clockwise");
    const double turn = std::abs(sun.azimuth - azimuth);
    azimuth_off = std::max(azimuth_off, std::min(turn, 360 - turn) * std::cos(altitude * 0.017453292519943295));
    double& worst = altitude > 2 ? altitude_off : altitude > -0.25 ? low_off : night_off;
    worst = std::max(worst, std::abs(sun.altitude - altitude));
  }
  std::printf(
      "%zu positions: off by at most %.5f (azimuth, on the sky), %.5f (altitude above 2), %.5f (to the horizon) degrees; "
      "%.3f below it, where the table goes on refracting\n",
      rows.size(), azimuth_off, altitude_off, low_off, night_off);
  EXPECT_LT(azimuth_off, 0.01);
  EXPECT_LT(altitude_off, 0.01);
  EXPECT_LT(low_off, 0.05);
}

}  // namespace
}  // namespace bl::sun
