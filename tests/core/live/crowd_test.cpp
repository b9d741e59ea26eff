// People in a hall: their nodes come, move and go by commands of the log, and a replay needs neither sensor nor table.
#include "core/live/crowd.h"

#include <set>

#include <gtest/gtest.h>

#include "core/base/hash.h"
#include "core/live/connections.h"
#include "tests/core/live/live_support.h"
#include "tests/support/place/source_folder.h"
#include "tests/support/sanitized.h"
#include "tests/support/world.h"

namespace bl::live {
namespace {

// A session with its connections, tick by tick, and everything as a log.
class Hall {
 public:
  Hall(const std::string& scene, const std::string& folder)
      : start_(scene), world_(World::from_text(scene)), connections_({folder, false, {}}), log_(log_header(scene)) {}
  void tick() {
    Session& session = world_.session();
    connections_.follow(session.scene());
    for (const Report& report : connections_.collect(world_.state().tick)) {
      const auto done = session.submit({.command = report.command, .author = report.author});
      EXPECT_TRUE(done.ok()) << done.error().text();
    }
    world_.tick();
    for (; logged_ < session.log().size(); ++logged_) log_ += log_line(session.log()[logged_], full_registry());
    log_ += log_line(LogCheck{.tick = world_.state().tick, .hash = hex_digits(world_.state().hash)});
  }
  std::set<std::string> people(const std::string& sensor = "eyes") const {
    std::set<std::string> all;
    for (const auto& [id, node] : world_.state().plan->scene.nodes)
      if (id.starts_with(sensor + "#")) all.insert(id.substr(sensor.size() + 1));
    return all;
  }
  World& world() { return world_; }
  const std::string& log() const { return log_; }
  const Connections& connections() const { return connections_; }

 private:
  std::string start_;
  World world_;
  Connections connections_;
  std::string log_;
  std::size_t logged_ = 0;
};

std::string hall(const std::string& ports, const std::string& others = "") {
  return R"({"format": "behaviourlinks", "version": 1, "nodes": [{"id": "eyes", "types": {"people_sensor": {"address": "replay:w.csv#who", "tick_length": 1)" +
         ports + "}}}" + others + R"(], "links": []})";
}
constexpr const char* kWalk = "time,who,x,y\n10,a,1,2\n11,b,5,5\n11,a,2,2\n13,c,9,9\n14,a,,\n16,b,,\n16,a,3,3\n";
using Names = std::set<std::string>;

TEST(Crowds, ComeMoveAndGoAsTheTableSays) {
  const test::Folder folder;
  folder.write("w.csv", kWalk);
  Hall one(hall(R"(, "height": 2, "demand": 7)"), folder.path());
  const std::vector<Names> expected = {{"a"},      {"a", "b"}, {"a", "b"}, {"a", "b", "c"},
                                       {"b", "c"}, {"b", "c"}, {"a", "c"}, {"a", "c"}};
  for (std::size_t k = 0; k < expected.size(); ++k) {
    one.tick();
    EXPECT_EQ(one.people(), expected[k]) << k;
    EXPECT_EQ(one.world().number("eyes", "people_sensor.share"), static_cast<double>(expected[k].size()) / 50);
    if (k == 0) { EXPECT_EQ(one.world().point("eyes#a", "node.position"), (Vector3{1, 2, 2})); }
    if (k == 1) { EXPECT_EQ(one.world().point("eyes#a", "node.position"), (Vector3{2, 2, 2})); }
  }
  EXPECT_EQ(one.world().number("eyes#c", "smart_volume.demand"), 7);
  const std::size_t entries = one.world().session().log().size();
  EXPECT_EQ(entries, 5u) << "one command for each tick in which somebody moves, and none in the others";
  for (const LogEntry& entry : one.world().session().log()) EXPECT_EQ(entry.author.kind, AuthorKind::device);
  ASSERT_EQ(one.connections().status().size(), 1u);
  EXPECT_EQ(one.connections().status()[0].played, one.connections().status()[0].rows);
}

TEST(Crowds, HaveNoMoreNodesThanTheirSensorAllowsAndTouchNobodyElse) {
  const test::Folder folder;
  folder.write("w.csv", kWalk);
  Hall one(hall(R"(, "most": 2)",
                R"(, {"id": "eyes2", "position": [1, 1, 1]}, {"id": "eyes_a", "types": {"smart_volume": {}}}, {"id": "eyes#z"})"),
           folder.path());
  const std::vector<Names> expected = {{"a"}, {"a", "b"}, {"a", "b"}, {"a", "b"}, {"b", "c"}, {"b", "c"}, {"a", "c"}};
  for (std::size_t k = 0; k < expected.size(); ++k) {
    one.tick();
    EXPECT_EQ(one.people(), expected[k]) << k << ": who is of the sensor and not in the table goes, too";
  }
  EXPECT_TRUE(one.world().session().scene().nodes.contains("eyes2"));
  EXPECT_TRUE(one.world().session().scene().nodes.contains("eyes_a"));
}

TEST(Crowds, TablesThatCannotBeReadAreToldWithTheirLine) {
  const auto address = address::parse_live_address("replay:w.csv#who");
  ASSERT_TRUE(address.ok());
  for (const auto& [text, error] : {std::pair{"", "line 1: the table is empty"},
                                    {"time,who,x\n", "line 1: the table has no column `y`, did you mean `x`?"},
                                    {"time,who,x,y\n", "the table has no rows"},
                                    {"time,who,x,y\n1,A b,1,1\n", "line 2: `A b` is no name of up to 20 letters and digits"},
                                    {"time,who,x,y\n1,a,1,1\nsoon,a,1,1\n", "line 3: `soon` is no time in seconds"},
                                    {"time,who,x,y\n1,a,1,\n", "line 2: expects a place `x` and `y` in metres, or neither"}}) {
    const auto walk = read_walk(text, *address);
    ASSERT_FALSE(walk.ok()) << text;
    EXPECT_EQ(walk.error().text(), error);
  }
  const test::Folder folder;
  Hall none(hall(""), folder.path());
  none.tick();
  none.tick();
  EXPECT_TRUE(none.world().text("eyes", "people_sensor.message").starts_with("the table cannot be played: "));
  EXPECT_EQ(none.world().session().log().size(), 1u) << "told once";
}

// The study as it is shipped: territories follow twenty people, and the log alone leads to the same hash.
TEST(Crowds, TwentyPeopleWalkThroughTheStudyAndAReplayNeedsNoSensor) {
  Hall study(project_file("scenes/studies/people_in_a_hall.json"), test::source_folder() + "/scenes/studies");
  std::size_t most = 0, looked_at = 0, with_territory = 0;
  const int ticks = test::kIsSanitized ? 40 : 260;
  for (int k = 0; k < ticks; ++k) {
    study.tick();
    const Names people = study.people();
    most = std::max(most, people.size());
    for (const std::string& person : people) {
      EXPECT_EQ(study.world().node_error("eyes#" + person, "smart_volume"), "");
      // Who stands on somebody else's toes, as in a door, has no territory for a moment.
      ++looked_at;
      if (study.world().number("eyes#" + person, "smart_volume.volume") > 0) ++with_territory;
    }
  }
  EXPECT_GT(20 * with_territory, 19 * looked_at) << with_territory << " of " << looked_at;
  if (!test::kIsSanitized) {
    EXPECT_EQ(most, 18u);
    EXPECT_TRUE(study.people().empty()) << "all have gone home";
  }
  const auto log = read_log(study.log(), full_registry());
  ASSERT_TRUE(log.ok()) << log.error().text();
  const auto report = replay(*log, full_registry(), 2);
  ASSERT_TRUE(report.ok()) << report.error().text();
  EXPECT_EQ(report->checks, static_cast<std::size_t>(ticks));
  EXPECT_FALSE(report->first_mismatch.has_value()) << report->first_mismatch->tick;
}

}  // namespace
}  // namespace bl::live
