// Sun and sky: published figures through the ports, clocks, the period, and what cannot be.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/nodes/scene_text.h"
#include "tests/support/world.h"

namespace bl {
namespace {

double hours(double h, double m) { return h * 3600 + m * 60; }

World sun(const std::string& ports) {
  World world = World::from_text(one_node("sun_and_sky", ports));
  world.tick();
  return world;
}

TEST(SunAndSky, SceneHasThePublishedFigures) {
  World world = World::from_file("scenes/nodes/sun_and_sky.json");
  world.tick();
  // The worked example of the algorithm.
  EXPECT_NEAR(world.number("golden", "sun_and_sky.geometric_altitude"), 39.872046, 0.0003);
  EXPECT_NEAR(world.number("golden", "sun_and_sky.altitude"), 39.888378, 0.0003);
  EXPECT_NEAR(world.number("golden", "sun_and_sky.azimuth"), 194.340241, 0.0003);
  EXPECT_EQ(world.number("tromso", "sun_and_sky.day_length"), 0);
  EXPECT_EQ(world.text("tromso", "sun_and_sky.note"), "the sun does not rise on this day; no sun of the period counts: at no time of its days between `from_time` and `to_time` does "
            "it stand as high as `min_altitude`");
  EXPECT_TRUE(world.table("tromso", "sun_and_sky.moments").rows.empty());
  EXPECT_TRUE(world.settle());
}

TEST(SunAndSky, TheDirectionIsThatOfTheAngles) {
  World world = sun(R"("time": 50000, "true_north": 20)");
  const double altitude = world.number("it", "sun_and_sky.altitude") * std::acos(-1) / 180,
               azimuth = (world.number("it", "sun_and_sky.azimuth") + 20) * std::acos(-1) / 180;
  const Vector3 direction = world.point("it", "sun_and_sky.direction");
  EXPECT_NEAR(direction.x, std::cos(altitude) * std::sin(azimuth), 1e-9);
  EXPECT_NEAR(direction.y, std::cos(altitude) * std::cos(azimuth), 1e-9);
  EXPECT_NEAR(direction.z, std::sin(altitude), 1e-9);
}

TEST(SunAndSky, RefractionIsASwitch) {
  World with = sun(R"("time": 25200)"), without = sun(R"("time": 25200, "refraction": false)");
  EXPECT_GT(with.number("it", "sun_and_sky.altitude"), with.number("it", "sun_and_sky.geometric_altitude") + 0.05);
  EXPECT_EQ(without.number("it", "sun_and_sky.altitude"), without.number("it", "sun_and_sky.geometric_altitude"));
  EXPECT_EQ(with.number("it", "sun_and_sky.sunrise"), without.number("it", "sun_and_sky.sunrise"));
}

TEST(SunAndSky, ClocksFollowTheZoneAndItsRule) {
  // Sydney, published to the minute.
  World sydney = sun(R"("latitude": -33.87, "longitude": 151.22, "utc_offset": 36000, "date": "2017-06-21")");
  EXPECT_NEAR(sydney.number("it", "sun_and_sky.sunrise"), hours(7, 0), 60);
  EXPECT_NEAR(sydney.number("it", "sun_and_sky.transit"), hours(11, 57), 60);
  EXPECT_NEAR(sydney.number("it", "sun_and_sky.sunset"), hours(16, 54), 60);
  World winter = sun(R"("date": "2026-06-21")"), summer = sun(R"("date": "2026-06-21", "daylight_saving": "europe")");
  EXPECT_NEAR(summer.number("it", "sun_and_sky.transit") - winter.number("it", "sun_and_sky.transit"), 3600, 0.01);
  EXPECT_NEAR(summer.number("it", "sun_and_sky.day_length"), winter.number("it", "sun_and_sky.day_length"), 0.01);
  EXPECT_NEAR(winter.number("it", "sun_and_sky.sunset") - winter.number("it", "sun_and_sky.sunrise"),
              winter.number("it", "sun_and_sky.day_length"), 0.01);
}

TEST(SunAndSky, DaysAreAddedToTheDate) {
  World world = sun(R"("date": "2026-02-27", "days": 2.9)");
  EXPECT_EQ(world.text("it", "sun_and_sky.day"), "2026-03-01");
}

TEST(SunAndSky, ThePeriodMakesTheMoments) {
  World day = sun(R"("min_altitude": 0, "step": 3600, "refraction": false)");
  const Table& moments = day.table("it", "sun_and_sky.moments");
  EXPECT_GE(moments.rows.size(), 12u);
  EXPECT_LE(moments.rows.size(), 14u);
  double sum = 0;
  for (std::size_t row = 0; row < moments.rows.size(); ++row) sum += moments.number(row, "seconds");
  EXPECT_NEAR(sum, day.number("it", "sun_and_sky.possible"), 1e-6);
  // Below the horizon of sunrise, and above the level: some minutes at both ends of the day.
  EXPECT_LT(sum, day.number("it", "sun_and_sky.day_length"));
  EXPECT_GT(sum, day.number("it", "sun_and_sky.day_length") - 1200);
  World noon =
      sun(R"("from_time": 39600, "to_time": 50400, "first_date": "2026-03-01", "last_date": "2026-03-31", "day_step": 10)");
  EXPECT_NEAR(noon.number("it", "sun_and_sky.possible"), hours(3, 0), 1e-3);
  EXPECT_EQ(noon.table("it", "sun_and_sky.moments").rows.size(), 4u * 9);
}

TEST(SunAndSky, SaysWhatIsWrong) {
  const std::string place = "nodes/it/sun_and_sky/";
  EXPECT_EQ(sun(R"("date": "spring")").node_error("it", "sun_and_sky"),
            place + "date: `spring` is no date: write year, month and day as 2026-03-21");
  EXPECT_EQ(sun(R"("date": "2026-02-30")").node_error("it", "sun_and_sky"),
            place + "date: `2026-02-30` is no date: write year, month and day as 2026-03-21");
  EXPECT_EQ(sun(R"("date": "2099-01-01", "days": 2000)").node_error("it", "sun_and_sky"),
            place + "days: the year 2104 is outside 1900 to 2100");
  EXPECT_EQ(sun(R"("first_date": "2026-03-21", "last_date": "2026-03-20")").node_error("it", "sun_and_sky"),
            place + "last_date: the last day is before the first: exchange them");
  EXPECT_EQ(
      sun(R"("first_date": "2020-01-01", "last_date": "2026-01-01", "day_step": 1, "step": 10)").node_error("it", "sun_and_sky"),
      place + "step: more than 100000 moments would be looked at: take a longer step, or leave out more days");
}

}  // namespace
}  // namespace bl
