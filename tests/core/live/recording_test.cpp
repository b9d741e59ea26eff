// Recorded tables: times of many forms, rows of one sensor, ticks; and the published tables where they are at hand.
#include <filesystem>
#include <iostream>

#include <sys/stat.h>

#include <gtest/gtest.h>

#include "core/file/file_io.h"
#include "core/live/recording.h"
#include "core/live/time_text.h"
#include "tests/core/live/live_support.h"
#include "tests/support/place/source_folder.h"

namespace bl::live {
namespace {

using test::Folder;
using test::LiveWorld;
using test::sensor;

TEST(TimeText, FormsOfOneMoment) {
  // 2003-01-31 12:00:00 UTC, by hand: 33 years with 8 leap days, and 30 days.
  const double noon = 86400.0 * (33 * 365 + 8 + 30) + 43200;
  for (const char* text : {"2003-01-31T12:00:00Z", "2003-01-31 12:00", "2003-01-31T13:00:00+01:00", "2003-01-31T06:30-0530",
                           "31-Jan-2003 12:00:00", "2003-01-31 12:00:00.000"})
    EXPECT_EQ(seconds_of_time(text).value_or(-1), noon) << text;
  EXPECT_EQ(seconds_of_time("2003-01-31").value_or(-1), noon - 43200);
  EXPECT_EQ(seconds_of_time("3-Oct-2014"), seconds_of_time("2014-10-03"));
  EXPECT_EQ(seconds_of_time("1724567400"), 1724567400);
  EXPECT_EQ(seconds_of_time("2024-08-25 06:30:00"), 1724567400);
  EXPECT_EQ(seconds_of_time("2000-02-29").value_or(-1) + 86400, seconds_of_time("2000-03-01"));
  for (const char* text : {"", "2003-02-29", "2003-13-01", "31/01/2003", "noon", "2003-01-31T25:00", "2003-01-31T12:00Q"})
    EXPECT_FALSE(seconds_of_time(text)) << text;
  EXPECT_EQ(seconds_of_day("14:30:15"), 52215);
  EXPECT_EQ(seconds_of_day("5"), 18000);
}

constexpr const char* kTable =
    "day,hour,site,count\n"
    "2014-10-01,2,7,30\n"
    "2014-10-01,0,7,10\n"
    "2014-10-01,0,8,999\n"
    "2014-10-01,1,7,\n"
    "2014-10-01,3,7,many\n"
    "2014-10-01,5,7,50\n";

Result<Recording> read(const std::string& address, const std::string& table = kTable) {
  return read_recording(table, address::parse_live_address(address).value());
}

TEST(Recording, TakesTheRowsOfOneSensorInOrderOfTheirTimes) {
  const auto recording = read("replay:t.csv?site=7&time=day+hour#count");
  ASSERT_TRUE(recording.ok()) << recording.error().text();
  ASSERT_EQ(recording->readings.size(), 4u);
  EXPECT_EQ(recording->filtered, 1u);
  EXPECT_EQ(recording->empty, 1u);
  EXPECT_EQ(recording->readings[0].value, 10);
  EXPECT_EQ(recording->readings[1].value, 30);
  EXPECT_EQ(recording->readings[1].time, "2014-10-01 2");
  EXPECT_EQ(recording->readings[2].problem, "line 6 of the table: `many` is no number");
  const std::int64_t ticks[] = {1, 3, 4, 6};
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(tick_of(*recording, recording->readings[i], 3600), ticks[i]);
}

TEST(Recording, SaysWhatIsWrong) {
  EXPECT_EQ(read("replay:t.csv#cuont").error().text(), "line 1: the table has no column `cuont`, did you mean `count`?");
  EXPECT_EQ(read("replay:t.csv?site=9#count").error().text(), "no row of the table holds a reading of the site `9`");
  EXPECT_EQ(read("replay:t.csv?time=day+site#count", "day,site,count\nx,1,2\n").error().text(),
            "line 2: `x` is no time such as `2003-01-31 12:00`");
  EXPECT_EQ(read("replay:t.csv#a", "a,b\n1,2\n").error().code, ErrorCode::not_found);
  EXPECT_FALSE(read("replay:t.csv#a", "").ok());
  EXPECT_FALSE(read("replay:t.csv#a", std::string("\xff\xfe\0\x01", 4)).ok());
}

TEST(Recording, PlaysByTicksAndReplaysWithTheSameHash) {
  const Folder folder;
  folder.write("t.csv", kTable);
  LiveWorld live(sensor("s", "replay:t.csv?site=7&time=day+hour#count", R"(, "tick_length": 3600, "timeout": 5000)"), "",
                 {folder.path(), false, {}});
  struct Expected {
    double value, age;
    const char* quality;
  };
  // Hours 0 to 7: 10, nothing, 30, a word, nothing, 50, nothing, nothing.
  const Expected expected[] = {{10, 0, "good"},       {10, 3600, "good"}, {30, 0, "good"},    {30, 3600, "invalid"},
                               {30, 7200, "invalid"}, {50, 0, "good"},    {50, 3600, "good"}, {50, 7200, "stale"}};
  for (const Expected& hour : expected) {
    live.step();
    EXPECT_EQ(live.number("s"), hour.value) << live.world().state().tick;
    EXPECT_EQ(live.number("s", "sensor.age"), hour.age) << live.world().state().tick;
    EXPECT_EQ(live.quality("s"), hour.quality) << live.world().state().tick;
  }
  EXPECT_EQ(live.message("s"), "the last reading is older than 5000 s");
  EXPECT_EQ(live.status("s").traffic.received, 4);
  EXPECT_EQ(live.status("s").traffic.skipped, 0);
  EXPECT_EQ(live.replayed(1), live.hash());
  EXPECT_EQ(live.replayed(2), live.hash());
}

TEST(Recording, RowsThatShareATickAreCountedAndTheLastOneCounts) {
  const Folder folder;
  folder.write("t.csv", "time,v\n0,1\n1,2\n2,3\n10,4\n");
  LiveWorld live(sensor("s", "replay:t.csv#v", R"(, "tick_length": 10)"), "", {folder.path(), false, {}});
  live.step();
  EXPECT_EQ(live.number("s"), 3);
  EXPECT_EQ(live.status("s").traffic.skipped, 2);
  live.step();
  EXPECT_EQ(live.number("s"), 4);
}

TEST(TimeText, RefusesWhatNoClockShows) {
  for (const char* text : {"2003-01-31T24:59:60", "2003-01-31T24:01", "2003-01-31T12:00:60", "2003-01-31T12:00+99:99",
                           "2003-01-31T12:00+14:30", "2003-01-31T12:00-01:60"})
    EXPECT_FALSE(seconds_of_time(text)) << text;
  EXPECT_EQ(seconds_of_time("2003-01-31T24:00"), seconds_of_time("2003-02-01"));
  EXPECT_TRUE(seconds_of_time("2016-12-31T23:59:60Z"));
  EXPECT_EQ(seconds_of_digits("20030131"), seconds_of_time("2003-01-31"));
  EXPECT_EQ(seconds_of_digits("2003013112"), seconds_of_time("2003-01-31 12:00"));
  EXPECT_EQ(seconds_of_digits("200301311230"), seconds_of_time("2003-01-31 12:30"));
  EXPECT_EQ(seconds_of_digits("20030131123015"), seconds_of_time("2003-01-31 12:30:15"));
  for (const char* text :
       {"20030229", "18991231", "22000101", "200301311", "2003013125", "2003-131", "200301311260", "1724567400"})
    EXPECT_FALSE(seconds_of_digits(text)) << text;
}

TEST(Recording, ReadsDaysOfDigitsAsWeatherTablesWriteThem) {
  const auto recording =
      read("replay:d.csv?time=date+hour#count", "date,hour,count\n20110131,1,10\n20110131,2,20\n20110201,1,30\n");
  ASSERT_TRUE(recording.ok()) << recording.error().text();
  const std::int64_t ticks[] = {1, 2, 25};
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(tick_of(*recording, recording->readings[i], 3600), ticks[i]);
  // A column in which not every row is a day holds seconds, to which no hour can be added.
  const auto seconds = read("replay:d.csv?time=t#v", "t,v\n20110131,1\n20110132,2\n");
  ASSERT_TRUE(seconds.ok());
  EXPECT_EQ(tick_of(*seconds, seconds->readings[1], 1), 2);
  EXPECT_EQ(read("replay:d.csv?time=t+h#v", "t,h,v\n20110131,1,1\n20110132,1,2\n").error().text(),
            "line 2: `20110131` is no day to which a time of the day could be added: write days as `2003-01-31` or, in all rows, "
            "as `20030131`");
}

TEST(Recording, ReadsPlainFilesOfItsFolderOnly) {
  const Folder folder;
  std::filesystem::create_directory(folder.path("inner"));
  folder.write("secret.csv", "time,v\n0,1\n");
  folder.write("inner/t.csv", "time,v\n0,2\n");
  std::filesystem::create_symlink(folder.path("secret.csv"), folder.path("inner/link.csv"));
  ASSERT_EQ(mkfifo(folder.path("inner/pipe").c_str(), 0600), 0);
  const auto message = [&](const std::string& file, bool reads_anywhere) {
    LiveWorld live(sensor("s", "replay:" + file + "#v"), "", {folder.path("inner"), false, {}, reads_anywhere});
    live.step();
    return live.message("s");
  };
  for (const std::string& file : {folder.path("secret.csv"), std::string("../secret.csv"), std::string("link.csv")}) {
    EXPECT_NE(message(file, false).find("does not lie in the folder of the scene"), std::string::npos) << file;
    EXPECT_EQ(message(file, true), "") << file;
  }
  EXPECT_EQ(message("t.csv", false), "");
  EXPECT_EQ(message("../inner/t.csv", false), "");
  // Neither a pipe nor a device is waited for.
  EXPECT_NE(message("pipe", false).find("is a device or a pipe"), std::string::npos);
  EXPECT_NE(message("/dev/zero", true).find("is a device or a pipe"), std::string::npos);
  EXPECT_NE(message("/dev/stdin", true).find("cannot be played"), std::string::npos);
}

TEST(Recording, GoesBackWithTheClock) {
  const Folder folder;
  folder.write("scene.csv", "time,v\n0,1\n10,2\n20,3\n30,4\n");
  Connections connections({folder.path(), false, {}});
  World world = World::from_text(R"({"format": "behaviourlinks", "version": 1, "nodes": [)" +
                                 sensor("s", "replay:scene.csv#v", R"(, "tick_length": 10)") + R"(], "links": []})");
  connections.follow(world.session().scene());
  const auto value = [&](std::int64_t tick) {
    const auto reports = connections.collect(tick);
    return reports.empty() ? 0.0 : as_number(reports.front().command.arguments.at("value"));
  };
  EXPECT_EQ(value(0), 1);
  EXPECT_EQ(value(1), 2);
  EXPECT_EQ(value(3), 4);
  EXPECT_EQ(connections.status().front().played, 4u);
  EXPECT_EQ(value(4), 0);
  EXPECT_EQ(value(1), 2);
  EXPECT_EQ(value(2), 3);
  EXPECT_EQ(value(0), 1);
}

TEST(Recording, AMissingFileIsASentence) {
  LiveWorld live(sensor("s", "replay:nowhere.csv#v"));
  live.step();
  EXPECT_TRUE(live.says("s", "the recording cannot be played")) << live.message("s");
  EXPECT_EQ(live.quality("s"), "never");
}

// The published tables beside the project.
std::string published(const std::string& name) {
  const std::string path = test::source_folder() + "/../shared/data/sensors/" + name;
  if (std::filesystem::exists(path)) return path;
  std::cout << "not tried: " << name << " does not lie beside the project\n";
  return "";
}

TEST(Recording, PublishedPedestrianCountsAreAllThere) {
  const std::string path = published("melbourne_pedestrians_2014-10.csv");
  if (path.empty()) return;
  const auto text = read_file(path);
  ASSERT_TRUE(text.ok());
  std::size_t count = 0;
  double sum = 0;
  for (const char* site : {"1", "2", "3", "4", "5", "6", "9", "18"}) {
    const auto recording = read("replay:x.csv?SensorID=" + std::string(site) + "&time=Date+Hour#PedestrianCount", *text);
    ASSERT_TRUE(recording.ok()) << recording.error().text();
    EXPECT_EQ(recording->filtered + recording->empty + recording->readings.size(), 5944u);
    count += recording->readings.size();
    for (const RecordedReading& reading : recording->readings) sum += reading.value;
    EXPECT_LE(tick_of(*recording, recording->readings.back(), 3600), 744) << "more ticks than October has hours";
  }
  EXPECT_EQ(count, 5944u);
  EXPECT_EQ(sum, 5789837);
}

TEST(Recording, PublishedTablesPlayAndReplay) {
  const std::string air = published("london_marylebone_air_2003-01.csv"), noise = published("geneva_noise_2024-08-25.csv");
  if (air.empty() || noise.empty()) return;
  LiveWorld live(
      sensor("no2", "replay:" + air + "#no2", R"(, "tick_length": 3600, "timeout": 3600)") + "," +
          sensor("leq", "replay:" + noise + "?deveui=4a6#Leq", R"(, "tick_length": 900, "smoothing": 1800, "timeout": 900)"),
      "", {"", false, {}, true});
  for (int hour = 0; hour < 744; ++hour) live.step();
  const Traffic traffic = live.status("no2").traffic;
  EXPECT_EQ(traffic.skipped, 0);
  EXPECT_GT(traffic.received, 700);
  EXPECT_LT(traffic.received, 744);
  EXPECT_EQ(live.quality("leq"), "stale");
  EXPECT_EQ(live.replayed(1), live.hash());
  EXPECT_EQ(live.replayed(2), live.hash());
  std::cout << traffic.received << " readings of 744 hours, " << live.world().session().log().size() << " entries, hash "
            << live.hash() << "\n";
}

}  // namespace
}  // namespace bl::live
