// Runs with sensors: recorded tables in any run, connections with --live only, and logs that replay without either.
#include <gtest/gtest.h>

#include "core/session/session.h"
#include "tests/support/hand_clock.h"
#include "tests/support/place/source_folder.h"
#include "tests/support/world.h"
#include "tests/ui/cli/program.h"
#include "ui/cli/live_run.h"

namespace bl::test {
namespace {

std::string scene(const std::string& address) {
  return R"({"format": "behaviourlinks", "version": 1, "nodes": [
    {"id": "a", "types": {"smart_volume": {"demand": 900}}},
    {"id": "s", "types": {"sensor": {"unit": "m3", "timeout": 30, "tick_length": 10, "address": ")" +
         address + R"("}}}],
    "links": [{"id": "l", "kind": "sensor_to_parameter", "from": "s", "to": "a"}]})";
}

Outcome run(const Workplace& place, const std::string& arguments) { return place.shell("\"$BEHAVIOURLINKS\" " + arguments); }

TEST(Live, RecordedTablesArePlayedAndTheirLogReplaysWithoutThem) {
  const Workplace place;
  std::filesystem::create_directory(place.path("data"));
  place.write("data/t.csv", "time,demand\n0,1000\n10,1100\n35,1200\n");
  place.write("data/scene.json", scene("replay:t.csv#demand"));
  const Outcome played = run(place, "run data/scene.json --ticks 6 --log run.log --json out.json");
  EXPECT_EQ(played.code, 0) << played.err;
  EXPECT_NE(played.out.find("sensor s: 3 messages, 0 of them skipped"), std::string::npos) << played.out;
  EXPECT_NE(played.out.find("at the end 1200 m3, good"), std::string::npos) << played.out;
  std::filesystem::remove(place.path("data/t.csv"));
  for (const char* threads : {"1", "2"}) {
    const Outcome replay = run(place, std::string("replay run.log --threads ") + threads);
    EXPECT_EQ(replay.code, 0) << replay.out << replay.err;
    EXPECT_NE(replay.out.find("agrees with all"), std::string::npos) << replay.out;
  }
  EXPECT_NE(place.text("run.log").find("\"author\": \"replay:t.csv#demand\""), std::string::npos) << place.text("run.log");
}

TEST(Live, RowsThatAreNotPlayedAreToldOf) {
  const Workplace place;
  place.write("t.csv", "time,site,demand\n0,a,1000\n500,a,1100\n600,a,\n650,b,7\n700,a,1200\n");
  place.write("scene.json", scene("replay:t.csv?site=a#demand"));
  const Outcome played = run(place, "run scene.json --ticks 3");
  EXPECT_NE(played.out.find("1 of 3 rows played, 2 come after the end of the run, besides 1 without a reading and 1 of others"),
            std::string::npos)
      << played.out;
}

// A recording must not hold a run for good, nor read what lies outside the scene's folder unasked.
TEST(Live, RecordingsArePlainFilesBesideTheScene) {
  const Workplace place;
  std::filesystem::create_directory(place.path("inner"));
  place.write("t.csv", "time,demand\n0,1000\n");
  place.write("inner/scene.json", scene("replay:../t.csv#demand"));
  const Outcome refused = run(place, "run inner/scene.json --ticks 2");
  EXPECT_NE(refused.err.find("does not lie in the folder of the scene"), std::string::npos) << refused.err;
  EXPECT_NE(run(place, "run inner/scene.json --ticks 2 --recordings-anywhere").out.find("sensor s: 1 message"),
            std::string::npos);
  place.write("device.json", scene("replay:/dev/zero#demand"));
  const Outcome device = run(place, "run device.json --ticks 2 --recordings-anywhere");
  EXPECT_NE(device.err.find("is a device or a pipe"), std::string::npos) << device.err;
}

// A node that is sensor and actuator says what is wrong with each once.
TEST(Live, SensorAndActuatorOfOneNodeSpeakForThemselves) {
  const Workplace place;
  place.write("scene.json", R"({"format": "behaviourlinks", "version": 1, "nodes": [{"id": "s", "types": {
    "sensor": {"address": "mqtt://127.0.0.1:1/t"}, "actuator": {"address": "osc://127.0.0.1:9/a"}}}], "links": []})");
  const Outcome live = run(place, "run scene.json --live --ticks 300 --rate 100");
  std::size_t lines = 0;
  for (std::size_t at = live.err.find("refuses"); at != std::string::npos; at = live.err.find("refuses", at + 1)) ++lines;
  EXPECT_EQ(lines, 1u) << live.err;
}

TEST(Live, ConnectionsNeedToBeAskedFor) {
  const Workplace place;
  place.write("scene.json", scene("mqtt://127.0.0.1:1/t"));
  const Outcome quiet = run(place, "run scene.json --ticks 5");
  EXPECT_EQ(quiet.code, 0) << quiet.err;
  EXPECT_EQ(quiet.out.find("sensor s"), std::string::npos) << quiet.out;
  const Outcome live = run(place, "run scene.json --live --ticks 300 --rate 100 --log run.log");
  EXPECT_EQ(live.code, 0) << live.err;
  EXPECT_NE(live.err.find("refuses the connection: nothing listens there"), std::string::npos) << live.err;
  EXPECT_NE(live.out.find("sensor s: 0 messages"), std::string::npos) << live.out;
  EXPECT_NE(place.text("run.log").find("note_connection"), std::string::npos);
  EXPECT_EQ(run(place, "replay run.log --threads 2").code, 0);
  EXPECT_EQ(run(place, "run scene.json --rate 5").code, 2) << "a rate is for live runs";
}

// A check has no devices: what waits for one is told, and is no error.
TEST(Live, ASceneThatWaitsForItsSensorIsSound) {
  const Workplace place;
  place.write("scene.json", scene("mqtt://127.0.0.1:1/t"));
  const Outcome check = run(place, "check scene.json");
  EXPECT_EQ(check.code, 0) << check.err;
  EXPECT_NE(check.err.find("warning: the sensor `s` has no good reading: no reading has come yet"), std::string::npos)
      << check.err;
  // A reading that cannot be true is a fault of the scene all the same.
  std::string wrong = scene("mqtt://127.0.0.1:1/t");
  wrong.replace(wrong.find("\"timeout\""), 0, R"("reading": 5, "reading_tick": 0, "has_range": true, "highest": 1, )");
  place.write("scene.json", wrong);
  EXPECT_EQ(run(place, "check scene.json").code, 2);
}

TEST(Live, UnusableAddressesOfSensorsAreNamed) {
  const Workplace place;
  const std::vector<std::string> addresses{"file:///etc/passwd", "http://user:pw@127.0.0.1:9114/", "mqtt://127.0.0.1:99999/t",
                                           "nonsense"};
  std::string nodes;
  for (std::size_t i = 0; i < addresses.size(); ++i)
    nodes += (i > 0 ? "," : "") + (R"({"id": "s)" + std::to_string(i)) + R"(", "types": {"sensor": {"address": ")" +
             addresses[i] + R"("}}})";
  place.write("scene.json", R"({"format": "behaviourlinks", "version": 1, "nodes": [)" + nodes +
                                R"(, {"id": "fine", "types": {"sensor": {}}}], "links": []})");
  const Outcome check = run(place, "check scene.json"), live = run(place, "run scene.json --live --ticks 3 --rate 100");
  EXPECT_EQ(check.code, 2) << check.err;
  for (const Outcome* outcome : {&check, &live}) {
    for (std::size_t i = 0; i < addresses.size(); ++i) {
      const std::string place_of = "nodes/s" + std::to_string(i) + "/sensor/address: the address cannot be used: ";
      const std::size_t at = outcome->err.find(place_of);
      EXPECT_NE(at, std::string::npos) << place_of << outcome->err;
      EXPECT_EQ(outcome->err.find(place_of, at + 1), std::string::npos) << "once: " << outcome->err;
    }
    EXPECT_EQ(outcome->err.find("nodes/fine"), std::string::npos) << outcome->err;
    EXPECT_EQ(outcome->err.find("user:pw"), std::string::npos) << "passwords are not repeated";
  }
}

// Without readings, a scene at rest is not evaluated, nor even looked at, while its clock counts on.
TEST(Live, ASceneAtRestIsSleptThrough) {
  constexpr std::int64_t kLong = 1'000'000;
  const Scene quarter = read_scene(project_file("scenes/start/quarter.json"), full_registry()).scene;
  const auto session = Session::start(full_registry(), quarter, nullptr, 1);
  ASSERT_TRUE(session.ok());
  HandClock clock;
  cli::LiveRun live("scene.json", true, 0, false, clock), still("scene.json", false, 0, false, clock);
  EXPECT_EQ(live.rest(**session, kLong), 0) << "there is no tick yet";
  for (int tick = 0; tick < 1500 && !(*session)->is_idle(); ++tick) (*session)->tick();
  const std::shared_ptr<const State> rest = (*session)->state();
  EXPECT_EQ(still.rest(**session, kLong), 0) << "other runs have no time";
  const double begin = clock.now();
  const std::size_t pairs = (*session)->counts().pairs;
  EXPECT_EQ(live.rest(**session, kLong), kLong);
  EXPECT_NEAR(clock.now() - begin, 0.05 * kLong, 0.1);
  EXPECT_EQ((*session)->state()->tick, rest->tick + kLong);
  EXPECT_EQ((*session)->counts().pairs, pairs);
  ASSERT_TRUE((*session)->submit(command<SetSetting>({"tolerance", {"0.02"}}), {"p", AuthorKind::person}).ok());
  EXPECT_EQ(live.rest(**session, kLong), 0) << "what is said is not slept through";
}

TEST(Live, ARestLeavesTheLogThatItsTicksWouldLeave) {
  const Workplace place;
  const std::string scene_file = (std::filesystem::path(test::source_folder()) / "scenes/start/quarter.json").string(),
                    run_it = "run '" + scene_file + "' --ticks 700";
  const Outcome ticked = run(place, run_it + " --log ticked.log --report ticked");
  const Outcome live = run(place, run_it + " --log live.log --report live --live --rate 1000");
  EXPECT_EQ(live.code, 0) << live.err;
  EXPECT_NE(live.out.find("at rest since tick "), std::string::npos) << live.out;
  EXPECT_EQ(live.last_line(), ticked.last_line());
  EXPECT_EQ(place.text("live.log"), place.text("ticked.log"));
  EXPECT_EQ(place.text("live/report.html"), place.text("ticked/report.html"));
  EXPECT_EQ(run(place, "replay live.log").code, 0);
  // In one sleep, where nobody wants to know of the ticks between.
  const Outcome alone = run(place, run_it + " --live --rate 1000");
  EXPECT_EQ(alone.last_line(), ticked.last_line());
}

}  // namespace
}  // namespace bl::test
