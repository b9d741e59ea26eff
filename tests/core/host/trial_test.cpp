// Trials: what comes of a change is what would have come of it in the session, and the session does not notice.
#include "core/host/trial.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/session/commands.h"
#include "tests/support/world.h"

namespace bl::host {
namespace {

// What an editor collects while commands change a copy of the scene.
struct Changed {
  Scene scene;
  std::set<std::pair<std::string, std::string>> placed;
};
Changed changed(const Scene& from, const std::vector<Command>& commands) {
  Changed result{from, {}};
  SceneEdit edit(result.scene, full_registry());
  for (const Command& one : commands) EXPECT_TRUE(apply(edit, one).ok());
  result.placed = edit.placed();
  return result;
}

const std::vector<Command> kSteps = {command<SetPort>({"library", {"smart_volume.demand"}, JsonValue::of(9000)}),
                                     command<SetPort>({"library", {"node.position"}, JsonValue::of({5, 5, 10})})};

// Also from the middle of a negotiation, where the state with and the state without the change are both on their way.
TEST(Trials, AreWhatTheSessionWouldHaveComeTo) {
  for (const int before : {0, 7, 40}) {
    World world = World::from_file("scenes/start/quarter.json"), other = World::from_file("scenes/start/quarter.json");
    world.tick(before);
    other.tick(before);
    const Changed with = changed(world.session().scene(), kSteps);
    Trial trial(full_registry(), world.session().state(), with.scene, with.placed);
    for (const Command& step : kSteps) ASSERT_EQ(other.submit(step), "");
    for (int k = 0; k < 12 && !trial.is_over(); ++k) {
      (void)trial.go_on(5);
      world.tick(static_cast<int>(trial.ticks()) + before - static_cast<int>(world.state().tick));
      other.tick(static_cast<int>(trial.ticks()) + before - static_cast<int>(other.state().tick));
      ASSERT_EQ(trial.without().hash, world.state().hash) << before << ", " << trial.ticks();
      ASSERT_EQ(trial.with().hash, other.state().hash) << before << ", " << trial.ticks();
    }
    EXPECT_NE(trial.with().hash, trial.without().hash);
  }
}

TEST(Trials, AreTheSameInWhateverStepsTheyGoOn) {
  World world = World::from_file("scenes/start/quarter.json");
  world.tick(3);
  const Changed with = changed(world.session().scene(), kSteps);
  Trial one(full_registry(), world.session().state(), with.scene, with.placed),
      many(full_registry(), world.session().state(), with.scene, with.placed);
  EXPECT_TRUE(one.go_on(Trial::kMostTicks));
  while (!many.go_on(1)) {}
  EXPECT_TRUE(one.is_settled());
  EXPECT_EQ(one.ticks(), many.ticks());
  EXPECT_EQ(one.with().hash, many.with().hash);
  EXPECT_EQ(one.without().hash, many.without().hash);
  EXPECT_EQ(world.state().tick, 3);
}

// A clock moves the sun for ever: a trial of it ends all the same.
TEST(Trials, EndWhereNothingMovesAndWhereSomethingAlwaysDoes) {
  World still = World::from_file("scenes/nodes/indicator.json");
  Trial trial(full_registry(), still.session().state(), still.session().scene(), {});
  EXPECT_TRUE(trial.go_on(Trial::kMostTicks));
  EXPECT_TRUE(trial.is_settled());
  EXPECT_LT(trial.ticks(), 200);
  World clock = World::from_file("scenes/nodes/clock.json");
  Trial endless(full_registry(), clock.session().state(), clock.session().scene(), {});
  EXPECT_TRUE(endless.go_on(Trial::kMostTicks + 1));
  EXPECT_LE(endless.ticks(), Trial::kMostTicks);
}

}  // namespace
}  // namespace bl::host
