// The sun over a place: its position at a date and time, its rise and set, and the moments of sun studies.
#include <algorithm>
#include <cmath>

#include "core/define/registry.h"
#include "core/define/typification_builder.h"
#include "core/sun/sun_day.h"

namespace bl {

namespace {

struct SunAndSky {
  struct In {
    double latitude = 52, longitude = 4.36, elevation = 0, true_north = 0, utc_offset = 3600;
    sun::DaylightSaving daylight_saving = sun::DaylightSaving::none;
    std::string date = "2026-03-21";
    double days = 0, time = 43200;
    bool refraction = true;
    double pressure = 101325, temperature = 12, delta_t = 69;
    std::string first_date, last_date;
    int day_step = 7;
    double step = 1200, from_time = 0, to_time = 86400, min_altitude = 10;
  };

  struct Out {
    std::string day;
    double altitude = 0, geometric_altitude = 0, azimuth = 0;
    Vector3 direction;
    double sunrise = 0, transit = 0, sunset = 0, day_length = 0, transit_altitude = 0;
    std::string note;
    double possible = 0;
    Table moments;
  };

  static void declare(TypificationBuilder<SunAndSky>& t) {
    t.id("sun_and_sky").label("Sun and sky");
    t.doc(
        "The position of the sun over a place on earth, accurate to a few ten-thousandths of a degree. The node holds the "
        "coordinates, true north and the clock of the place. Its period sets the moments of sun studies.");
    declare_place(t);
    declare_moment(t);
    declare_period(t);
    declare_results(t);
  }

  static void declare_place(TypificationBuilder<SunAndSky>& t) {
    t.in(&In::latitude, "latitude")
        .unit(Unit::degree)
        .range(-90, 90)
        .of_scene(OfScene::unless_set, 0.1)
        .doc("North is positive.");
    t.in(&In::longitude, "longitude")
        .unit(Unit::degree)
        .range(-180, 180)
        .of_scene(OfScene::unless_set, 0.1)
        .doc("East is positive.");
    t.in(&In::elevation, "elevation").unit(Unit::metre).range(-500, 9000).soft(0, 2000).doc("Height above the sea.");
    t.in(&In::true_north, "true_north")
        .unit(Unit::degree)
        .range(-360, 360)
        .of_scene(OfScene::always)
        .doc("Direction of true north, clockwise from the scene's y axis.");
    t.in(&In::utc_offset, "utc_offset").unit(Unit::second).range(-50400, 50400).doc("Standard time minus universal time.");
    t.in(&In::daylight_saving, "daylight_saving",
         {{sun::DaylightSaving::none, "none", "Standard time all the year."},
          {sun::DaylightSaving::europe, "europe", "From the last Sunday of March to the last Sunday of October, at 01:00 UTC."},
          {sun::DaylightSaving::north_america, "north_america",
           "From the second Sunday of March to the first of November, at 02:00."},
          {sun::DaylightSaving::australia, "australia",
           "From the first Sunday of October to the first of April, at 02:00 and 03:00."}})
        .doc("The period in which clocks are an hour ahead of standard time. Today's rule is used for all years.");
  }

  static void declare_moment(TypificationBuilder<SunAndSky>& t) {
    t.in(&In::date, "date").doc("The day, such as 2026-03-21; years 1900 to 2100.");
    t.in(&In::days, "days")
        .range(-36600, 36600)
        .soft(0, 365)
        .combine(CombineRule::blend)
        .doc("Days that are added to the date, for sliders and links; parts of a day are ignored.");
    t.in(&In::time, "time").unit(Unit::second).range(0, 86400).combine(CombineRule::blend).doc("Local time since midnight.");
    t.in(&In::refraction, "refraction").doc("When on, altitudes include refraction by the air.");
    t.in(&In::pressure, "pressure").range(0, 110000).doc("Mean air pressure in pascals; used for refraction only.");
    t.in(&In::temperature, "temperature").range(-90, 60).doc("Mean temperature in degrees Celsius; used for refraction only.");
    t.in(&In::delta_t, "delta_t")
        .unit(Unit::second)
        .range(-100, 300)
        .doc("Terrestrial time minus universal time: 69 s in the 2020s, 64 s in 2000.");
  }

  static void declare_period(TypificationBuilder<SunAndSky>& t) {
    t.in(&In::first_date, "first_date").doc("First day of the period of studies; empty for the day set above.");
    t.in(&In::last_date, "last_date").doc("Last day of the period; empty: the first one.");
    t.in(&In::day_step, "day_step").range(1, 366).doc("Step in days through the period: 1 takes every day.");
    t.in(&In::step, "step").unit(Unit::second).range(10, 21600).soft(300, 3600).doc("Time between two moments of a day.");
    t.in(&In::from_time, "from_time").unit(Unit::second).range(0, 86400).doc("Time of the day before which sun does not count.");
    t.in(&In::to_time, "to_time").unit(Unit::second).range(0, 86400).doc("Time of the day after which sun does not count.");
    t.in(&In::min_altitude, "min_altitude")
        .unit(Unit::degree)
        .range(0, 90)
        .soft(0, 30)
        .combine(CombineRule::blend)
        .doc("Altitude below which sun does not count.");
  }

  static void declare_results(TypificationBuilder<SunAndSky>& t) {
    t.out(&Out::day, "day").doc("The day with the added days.");
    t.out(&Out::altitude, "altitude").unit(Unit::degree).doc("Angle of the centre of the sun above the horizon.");
    t.out(&Out::geometric_altitude, "geometric_altitude").unit(Unit::degree).doc("Altitude without refraction.");
    t.out(&Out::azimuth, "azimuth").unit(Unit::degree).doc("Azimuth of the sun, clockwise from true north.");
    t.out(&Out::direction, "direction").doc("Unit vector to the sun, in the scene's coordinates.");
    t.out(&Out::sunrise, "sunrise").unit(Unit::second).doc("Local time at which the sun rises; 0 where it does not.");
    t.out(&Out::transit, "transit").unit(Unit::second).doc("Local time at which the sun is highest.");
    t.out(&Out::sunset, "sunset").unit(Unit::second).doc("Local time at which the sun sets; 0 where it does not.");
    t.out(&Out::day_length, "day_length").unit(Unit::second).doc("Time that the sun is above the horizon on that day.");
    t.out(&Out::transit_altitude, "transit_altitude").unit(Unit::degree).doc("Altitude of the sun at the transit.");
    t.out(&Out::note, "note").doc("Says if the sun does not rise or set, or no sun of the period counts; else empty.");
    t.out(&Out::possible, "possible").unit(Unit::second).doc("Mean sun per day of the period on open ground.");
    t.out(&Out::moments, "moments")
        .column({.id = "x", .doc = "First component of the unit vector to the sun."})
        .column({.id = "y", .doc = "Second component of the unit vector to the sun."})
        .column({.id = "z", .doc = "Third component of the unit vector to the sun."})
        .column({.id = "seconds", .unit = Unit::second, .doc = "Time that the moment stands for; their sum is a mean day."})
        .doc("The moments of the period that studies evaluate, day by day.");
  }

  static sun::SunPlace place_of(const In& in) {
    return {in.latitude,        in.longitude, in.elevation,  in.true_north, in.utc_offset,
            in.daylight_saving, in.delta_t,   in.refraction, in.pressure,   in.temperature};
  }

  static Result<sun::DayNumber> day_of(const std::string& text, const char* port) {
    const auto day = sun::parse_date(text);
    return day ? day : Result<sun::DayNumber>(day.error().within(port));
  }

  static Result<Out> evaluate(const In& in, const Tick&) {
    const auto date = day_of(in.date, "date");
    if (!date) return date.error();
    const sun::DayNumber day = *date + static_cast<sun::DayNumber>(std::floor(in.days));
    if (const auto later = day_of(sun::date_text(day), "days"); !later) return later.error();
    const auto first = in.first_date.empty() ? Result<sun::DayNumber>(day) : day_of(in.first_date, "first_date");
    if (!first) return first.error();
    const auto last = in.last_date.empty() ? first : day_of(in.last_date, "last_date");
    if (!last) return last.error();
    const sun::SunPlace place = place_of(in);
    const auto moments = sun_moments(place, {*first, *last, in.day_step, in.step, in.min_altitude, in.from_time, in.to_time});
    if (!moments) return moments.error();
    Out out;
    out.day = sun::date_text(day);
    const sun::SunPosition sun = sun_position(place, moment_of(place, day, in.time));
    out.altitude = sun.altitude;
    out.geometric_altitude = sun.geometric_altitude;
    out.azimuth = sun.azimuth;
    out.direction = scene_direction(place, sun.azimuth, sun.altitude);
    const sun::SunDay today = sun_day(place, day);
    out.sunrise = today.sunrise.value_or(0);
    out.transit = today.transit.value_or(0);
    out.sunset = today.sunset.value_or(0);
    out.day_length = today.day_length;
    out.transit_altitude = today.transit_altitude;
    if (!today.sunrise || !today.sunset)
      out.note = today.day_length > 43200 ? "the sun does not set on this day" : "the sun does not rise on this day";
    if (moments->empty())
      out.note += std::string(out.note.empty() ? "" : "; ") +
                  "no sun of the period counts: it never stands as high as `min_altitude` between `from_time` and `to_time`";
    out.possible = possible_sun(*moments);
    out.moments.columns = {"x", "y", "z", "seconds"};
    for (const sun::SunMoment& moment : *moments)
      out.moments.rows.push_back({moment.toward.x, moment.toward.y, moment.toward.z, moment.seconds});
    return out;
  }
};

}  // namespace

}  // namespace bl

BL_TYPIFICATION(sun_and_sky, SunAndSky)
