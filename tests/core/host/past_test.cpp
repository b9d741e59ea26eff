// Laws of what a rewind reaches: every tick, with the bits that it had, whatever people did meanwhile.
#include "core/host/past.h"

#include <malloc.h>

#include <algorithm>
#include <map>

#include <gtest/gtest.h>

#include "core/base/random.h"
#include "core/graph/held_bytes.h"
#include "core/host/host.h"
#include "tests/core/host/replays.h"
#include "tests/support/hand_clock.h"
#include "tests/support/random_commands.h"
#include "tests/support/sanitized.h"
#include "tests/support/world.h"

namespace bl::host {
namespace {

constexpr std::int64_t kTicks = 150;

// Runs a scene as the ticking thread does, with commands now and then; by tick, the hash of the state with which it began.
std::map<std::int64_t, std::uint64_t> run(const Scene& scene, Past& past, Simulation& simulation) {
  Ledger ledger(full_registry(), scene);
  simulation.set_scene(scene);
  std::map<std::int64_t, std::uint64_t> hashes;
  for (std::int64_t tick = 0; tick < kTicks; ++tick) {
    Random random(7, static_cast<std::uint64_t>(tick));
    if (random.below(4) == 0)
      (void)ledger.submit(random_command(ledger.scene(), random, static_cast<int>(tick)), Author{"test"}, tick);
    const auto changes = ledger.take_changes();
    if (changes.is_logic_changed) {
      simulation.set_scene(ledger.scene(), changes.placed);
      past.set_scene(tick, ledger.scene(), changes.placed);
    }
    past.add(simulation.state());
    hashes[tick] = simulation.state()->hash;
    simulation.step();
  }
  return hashes;
}

class PastLaws : public testing::TestWithParam<const char*> {};

TEST_P(PastLaws, EveryTickIsReachedWithItsBits) {
  Past past;
  Simulation simulation(full_registry(), 1), again(full_registry(), 1);
  const auto hashes = run(read_scene(project_file(GetParam()), full_registry()).scene, past, simulation);
  EXPECT_EQ(past.oldest(), 0);
  Random random(11);
  for (int sample = 0; sample < 40; ++sample) {
    const auto tick = sample < 3 ? sample * Past::kPackedEvery : static_cast<std::int64_t>(random.below(kTicks));
    const auto done = past.recompute(tick, again);
    ASSERT_TRUE(done.ok()) << done.error().text();
    EXPECT_EQ(again.state()->tick, tick);
    EXPECT_EQ(again.state()->hash, hashes.at(tick)) << tick;
    EXPECT_EQ(past.whole(tick) != nullptr, tick >= kTicks - static_cast<std::int64_t>(Past::kWholeStates)) << tick;
  }
  EXPECT_FALSE(past.recompute(kTicks, again).ok());
}

INSTANTIATE_TEST_SUITE_P(Scenes, PastLaws,
                         testing::Values("scenes/start/quarter.json", "scenes/studies/sixty_volumes.json",
                                         "scenes/studies/braess.json", "scenes/studies/scripted_terraces.json",
                                         "scenes/nodes/sun_study.json", "scenes/nodes/sensor.json"),
                         [](const auto& test) { return "S" + std::to_string(test.index); });

// The scene with its volumes so far aside [m]: their shapes of the tick before stand where they were, and shadows are theirs.
Scene moved_aside(const Scene& scene, std::int64_t by) {
  Scene changed = scene;
  for (const auto& [id, node] : SharedMap(scene.nodes)) {
    if (!node.types.contains("smart_volume")) continue;
    Value& place = changed.nodes.edit(id).types[std::string(kBaseNode)]["position"];
    Vector3 at = std::holds_alternative<Vector3>(place) ? std::get<Vector3>(place) : Vector3{};
    at.x += static_cast<double>(by);
    place = at;
  }
  return changed;
}

// Edits in the very ticks whose states would be kept, and right after a return: what stands there was made from older settings.
TEST(Past, AnEditOfAStateThatIsKeptLeavesNoTrace) {
  for (const char* name :
       {"scenes/nodes/sun_study.json", "scenes/nodes/shadow_caster.json", "scenes/nodes/shadow_receiver.json"}) {
    SCOPED_TRACE(name);
    const Scene scene = read_scene(project_file(name), full_registry()).scene;
    Past::Placed placed;
    for (const auto& [id, node] : scene.nodes)
      if (node.types.contains("smart_volume")) placed.emplace(id, "node.position");
    Past past;
    Simulation simulation(full_registry(), 1), again(full_registry(), 1);
    simulation.set_scene(scene);
    std::map<std::int64_t, std::uint64_t> hashes;
    const auto go_on = [&](std::int64_t end, std::map<std::int64_t, std::int64_t> moves) {
      for (std::int64_t tick = simulation.state()->tick; tick < end; ++tick) {
        if (moves.contains(tick)) {
          const Scene edited = moved_aside(scene, moves[tick]);
          simulation.set_scene(edited, placed);
          past.set_scene(tick, edited, placed);
        }
        past.add(simulation.state());
        hashes[tick] = simulation.state()->hash;
        simulation.step();
      }
    };
    const auto expect_all = [&](std::int64_t end) {
      for (std::int64_t tick = 0; tick < end; ++tick) {
        ASSERT_TRUE(past.recompute(tick, again).ok());
        ASSERT_EQ(again.state()->hash, hashes[tick]) << tick;
      }
    };
    go_on(90, {{20, 3}, {40, 0}, {60, 2}, {61, 0}});
    expect_all(90);
    // For so long that no state is only as a tick has left it; one of them has to be kept, and that is where something happens.
    std::map<std::int64_t, std::int64_t> always;
    for (std::int64_t tick = 91; tick < 150; ++tick) always[tick] = tick < 120 ? 0 : 7;
    go_on(170, always);
    expect_all(170);
    ASSERT_TRUE(past.recompute(105, simulation).ok());
    past.forget_from(105);
    go_on(160, {{105, 5}});
    expect_all(160);
  }
}

TEST(Past, WhatIsGivenUpIsForgottenAndWhatFollowsStandsForItself) {
  Past past;
  Simulation simulation(full_registry(), 1);
  const Scene scene = read_scene(project_file("scenes/start/quarter.json"), full_registry()).scene;
  run(scene, past, simulation);
  past.forget_from(75);
  EXPECT_EQ(past.reachable(1000), 74);
  // Another course from there on, which does not follow from the ticks before it.
  Simulation other(full_registry(), 1);
  other.set_scene(scene);
  while (other.state()->tick < 75) other.step();
  std::map<std::int64_t, std::uint64_t> hashes;
  for (; other.state()->tick < 140; other.step()) {
    past.add(other.state());
    hashes[other.state()->tick] = other.state()->hash;
  }
  for (const std::int64_t tick : {75, 76, 96, 99, 139}) {
    ASSERT_TRUE(past.recompute(tick, simulation).ok());
    EXPECT_EQ(simulation.state()->hash, hashes.at(tick)) << tick;
  }
  // A rest leaves a gap, from behind which one comes back to the tick before it.
  other.pass(1000);
  past.add(other.state());
  EXPECT_EQ(past.reachable(700), 139);
  EXPECT_EQ(past.reachable(5000), 1140);
}

// Each edit is of a setting, after which the plan is compiled and shares nothing with the one before, and each record of the
// scene is another one, as where a file is read anew.
void expect_bounded(std::size_t limit, std::int64_t ticks) {
  Past past(limit);
  Simulation simulation(full_registry(), 1), again(full_registry(), 1);
  Scene scene = read_scene(project_file("scenes/studies/sixty_volumes.json"), full_registry()).scene;
  simulation.set_scene(scene);
  std::map<std::int64_t, std::uint64_t> hashes;
  std::size_t most = 0, of_all = 0;  // what is said of the history, and what all plans and scenes would take
  for (int tick = 0; tick < 10; ++tick) simulation.step();  // what the simulation itself keeps
  const std::size_t begin = mallinfo2().uordblks;
  ticks += simulation.state()->tick;
  for (std::int64_t tick = simulation.state()->tick; tick < ticks; ++tick) {
    scene.settings["change_limit"] = 0.001 + 1e-9 * static_cast<double>(tick);
    for (const auto& [id, node] : SharedMap(scene.nodes)) (void)scene.nodes.edit(id);
    simulation.set_scene(scene);
    past.set_scene(tick, scene, {});
    of_all += held_bytes(*simulation.state()->plan, nullptr) + held_bytes(scene, nullptr);
    past.add(simulation.state());
    hashes[tick] = simulation.state()->hash;
    most = std::max(most, past.bytes());
    EXPECT_EQ(past.has_given_up(), past.oldest() > 10);
    simulation.step();
  }
  EXPECT_GT(of_all, 4 * limit) << "the test is too small";
  EXPECT_LT(most, limit + limit / 4);
  EXPECT_GT(most, limit / 2);
  // The last states are kept beside that: they are few.
  constexpr std::size_t kStates = std::size_t{5} << 20;
  if (!test::kIsSanitized) { EXPECT_LT(mallinfo2().uordblks - begin, limit + kStates); }
  EXPECT_TRUE(past.has_given_up());
  EXPECT_LT(past.oldest(), ticks - 5);
  EXPECT_FALSE(past.recompute(past.oldest() - 1, again).ok());
  EXPECT_EQ(past.reachable(0), past.oldest());
  for (std::int64_t tick = past.oldest(); tick < ticks; tick += 7) {
    ASSERT_TRUE(past.recompute(tick, again).ok());
    ASSERT_EQ(again.state()->hash, hashes.at(tick)) << tick;
  }
  // What is forgotten from the other end is counted no more, either.
  past.forget_from(past.oldest() + 1);
  EXPECT_LT(past.bytes(), limit / 2);
}

TEST(Past, PlansAndScenesCountAndTheOldestAreGivenUp) { expect_bounded(std::size_t{24} << 20, 500); }
// So much that the ticks between two states that would be kept anyway are too many.
TEST(Past, MuchThatIsEditedAtOnceIsGivenUpInParts) { expect_bounded(std::size_t{2} << 20, 100); }

// A session that has reached the limit of its history goes back as far as it can, and its log says so.
TEST(Past, ARewindToATickThatIsForgottenLeadsToTheOldestAndReplays) {
  test::HandClock clock;
  auto started =
      Host::start(full_registry(), read_scene(project_file("scenes/studies/sixty_volumes.json"), full_registry()).scene, nullptr,
                  {.author = "anna", .clock = &clock, .most_history_bytes = std::size_t{4} << 20});
  Host& host = **started;
  LiveSession& session = host.session();
  for (int edit = 0; edit < 120; ++edit) {
    ASSERT_TRUE(host.submit({command<SetSetting>({"change_limit", {"0.001" + std::to_string(edit)}})}).ok());
    session.step(2);
    session.settle();
  }
  ASSERT_TRUE(session.moment()->has_forgotten) << session.moment()->history_bytes;
  const std::int64_t oldest = session.moment()->oldest;
  EXPECT_GT(oldest, 0);
  EXPECT_LT(session.moment()->history_bytes, std::size_t{5} << 20);
  session.rewind(1000);
  session.settle();
  EXPECT_EQ(session.moment()->failure, "");
  EXPECT_EQ(session.moment()->ticked->tick, oldest);
  EXPECT_EQ(session.log().back().rewinds_to, oldest);
  test::expect_replays(host);
  session.step(5);
  session.settle();
  test::expect_replays(host);
  session.rewind(1000);
  session.settle();
  EXPECT_EQ(session.moment()->ticked->tick, oldest);
  test::expect_replays(host);
}

TEST(Past, ARewindFartherThanWholeStatesIsComputedBesideTheHolder) {
  test::HandClock clock;
  auto started = Host::start(full_registry(), read_scene(project_file("scenes/start/quarter.json"), full_registry()).scene,
                             nullptr, {.author = "anna", .origin = "test", .clock = &clock});
  Host& host = **started;
  LiveSession& session = host.session();
  const auto tick = [&](int count) {
    session.step(count);
    session.settle();
  };
  const auto move = [&](const std::string& x) {
    const std::string id = session.scene().nodes.begin()->first;
    ASSERT_TRUE(host.submit({command<SetPort>({id, {"node.position"}, {"[" + x + ", 1, 2]"}})}).ok());
  };
  tick(90);
  move("30");
  tick(60);
  move("40");
  session.rewind(80);
  move("50");  // belongs to the tick to which the rewind leads
  EXPECT_EQ(session.log().back().tick, 70);
  session.settle();
  EXPECT_EQ(session.moment()->ticked->tick, 70);
  tick(5);
  test::expect_replays(host);
  // Two in a row, of which the second goes on from where the first leads to.
  tick(60);
  session.rewind(70);
  session.rewind(30);
  EXPECT_EQ(session.log().back().rewinds_to, 35);
  EXPECT_EQ(session.coming_state()->tick, 35);
  tick(3);
  test::expect_replays(host);
  session.rewind(1000);
  session.settle();
  EXPECT_EQ(session.moment()->ticked->tick, 0);
  test::expect_replays(host);
}

}  // namespace
}  // namespace bl::host
