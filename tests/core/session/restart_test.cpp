// Returns to a moment with its running state: the same ticks come again, and a replay of the log comes to the same hashes.
#include <algorithm>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/base/hash.h"
#include "core/base/random.h"
#include "tests/support/random_commands.h"
#include "tests/support/sanitized.h"
#include "tests/support/world.h"

namespace bl {
namespace {

// What has been said since, and the way back.
class Return {
 public:
  explicit Return(World& world) : world_(world) {}
  void say(const Command& command) {
    std::vector<Command> inverse;
    const auto done =
        world_.session().ledger().submit({.command = command, .author = "anna"}, world_.state().tick, [&](const Change& change) {
          inverse = change.inverse;
          return Result<void>();
        });
    if (done) back_.insert(back_.begin(), inverse.begin(), inverse.end());
  }
  std::string go(std::int64_t from, const std::string& hash) {
    if (!back_.empty()) { EXPECT_EQ(world_.submit(command<Batch>({std::exchange(back_, {})}), "lead"), ""); }
    LogEntry entry{.tick = world_.state().tick, .gesture = world_.session().new_gesture()};
    entry.author = "lead";
    entry.restarts_from = from;
    entry.state_hash = hash;
    const auto done = world_.session().replay(entry);
    return done ? "" : done.error().text();
  }

 private:
  World& world_;
  std::vector<Command> back_;
};

std::string log_of(World& world, const std::string& start, const std::vector<std::pair<std::size_t, LogCheck>>& checks) {
  std::string text = log_header(start);
  std::size_t next = 0;
  const auto& log = world.session().log();
  for (std::size_t k = 0; k <= log.size(); ++k) {
    for (; next < checks.size() && checks[next].first == k; ++next) text += log_line(checks[next].second);
    if (k < log.size()) text += log_line(log[k], full_registry());
  }
  return text;
}

TEST(Restarts, TheSameTicksComeAgainAndAReplayAgrees) {
  const std::string start = project_file("scenes/start/quarter.json");
  for (std::uint64_t seed = 1; seed <= (test::kIsSanitized ? 1 : 6); ++seed) {
    Random random(seed);
    World world = World::from_text(start);
    Session& session = world.session();
    std::vector<std::pair<std::size_t, LogCheck>> checks;
    const auto tick = [&] {
      world.tick();
      checks.push_back({session.log().size(), {.tick = world.state().tick, .hash = hex_digits(world.state().hash)}});
      return world.state().hash;
    };
    int number = 0;
    const auto disturb = [&](Return& way, int commands) {
      for (int k = 0; k < commands; ++k) {
        way.say(random_command(session.scene(), random, ++number));
        if (random.below(2) == 0) (void)tick();
      }
    };
    Return unused(world);
    disturb(unused, 6);
    // Said in the same tick as the scenario, so that the moment is not that of any tick.
    unused.say(command<SetPort>({"library", {"node.position"}, {"[40, 30, 10]"}}));
    ASSERT_TRUE(
        session.ledger().note_event(R"({"event": "save_scenario", "arguments": {"id": "a"}})", "lead", world.state().tick).ok());
    const std::int64_t from = session.log().back().seq;
    session.keep_moment(from);
    const std::string hash = hex_digits(session.coming_state()->hash);
    const Scene scene = session.scene();
    const std::int64_t begin = world.state().tick;
    std::vector<std::uint64_t> first;
    for (int k = 0; k < 12; ++k) first.push_back(tick());
    for (int again = 0; again < 2; ++again) {
      Return way(world);
      way.say(command<RemoveNode>({"library"}));
      disturb(way, 8);
      ASSERT_EQ(way.go(from, hash), "") << seed;
      ASSERT_TRUE(session.scene() == scene);
      ASSERT_EQ(world.state().tick, begin);
      for (const std::uint64_t expected : first) ASSERT_EQ(tick(), expected) << seed << ", tick " << world.state().tick;
    }
    const auto log = read_log(log_of(world, start, checks), full_registry());
    ASSERT_TRUE(log.ok()) << log.error().text();
    for (const int threads : {1, 2}) {
      const auto report = replay(*log, full_registry(), threads);
      ASSERT_TRUE(report.ok()) << report.error().text();
      EXPECT_FALSE(report->first_mismatch.has_value()) << seed << ", tick " << report->first_mismatch->tick;
      EXPECT_EQ(report->checks, checks.size());
      EXPECT_EQ(report->hash, hex_digits(world.state().hash));
    }
  }
}

TEST(Restarts, GoNowhereElse) {
  World world = World::from_file("scenes/start/quarter.json");
  world.tick(3);
  ASSERT_TRUE(world.session().ledger().note_event(R"({"event": "x", "arguments": {}})", "lead", 3).ok());
  Return way(world);
  EXPECT_EQ(way.go(1, "0123456789abcdef"), "restart: the state of entry 1 is not kept");
  world.session().keep_moment(1);
  EXPECT_EQ(way.go(1, "0123456789abcdef").substr(0, 40), "restart: the state of entry 1 has the ha");
  const std::string header = log_header(project_file("scenes/start/quarter.json"));
  const auto line = [](const char* fields) {
    return std::string(R"({"seq": 1, "tick": 3, "author": "a", "gesture": 1, )") + fields + "}\n";
  };
  for (const auto& [fields, error] :
       {std::pair{R"("restart": 1, "state": "0123456789abcdef")",
                  "line 2/restart: goes back to entry 1, which is not before its own"},
        {R"("restart": 0)", "line 2/state: expects 16 hexadecimal digits"},
        {R"("restart": 0, "state": "0123456789abcdef")", "line 2/restart: goes back to entry 0, which is not in the log"},
        {R"("restart": 0, "state": "0123456789abcdef", "rewind": 1)",
         "line 2/rewind: a restart has no command and undoes none: remove the other fields"}}) {
    const auto log = read_log(header + line(fields), full_registry());
    ASSERT_FALSE(log.ok());
    EXPECT_EQ(log.error().text(), error);
  }
}

}  // namespace
}  // namespace bl
