// Laws of evaluation on change: what has not changed is not asked, and every tick comes out as if everything had been asked.
#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/base/random.h"
#include "tests/support/random_commands.h"
#include "tests/support/random_scenes.h"
#include "tests/support/scene_files.h"
#include "tests/support/world.h"

namespace bl {
namespace {

std::string failures_of(const State& state) {
  std::string text;
  for (std::uint32_t n = 0; n < state.nodes.size(); ++n)
    for (const TypeState& type : state.nodes[n].types)
      if (type.error) text += type.error->text() + "\n";
  for (const LinkState& link : state.links)
    for (const auto& said : {link.error, link.work})
      if (said) text += said->text() + "\n";
  return text;
}

// Everything that a state says to people, beside what its hash holds.
void expect_same(const State& changed, const State& everything) {
  ASSERT_EQ(changed.hash, everything.hash);
  EXPECT_EQ(changed.calm, everything.calm);
  EXPECT_EQ(changed.largest_move, everything.largest_move);
  EXPECT_EQ(changed.largest_change, everything.largest_change);
  EXPECT_EQ(changed.largest_residual, everything.largest_residual);
  EXPECT_EQ(changed.is_settled(), everything.is_settled());
  EXPECT_EQ(failures_of(changed), failures_of(everything));
  for (std::uint32_t n = 0; n < changed.nodes.size(); ++n)
    for (std::size_t t = 0; t < changed.nodes[n].types.size(); ++t)
      ASSERT_EQ(changed.nodes[n].types[t].tension, everything.nodes[n].types[t].tension) << changed.plan->nodes[n].id;
}

using States = std::vector<std::shared_ptr<const State>>;

// The state after each tick; `act` is what people do before it, the same for everybody who has come to the same scene.
template <class Act>
States states_of(const std::string& text, int ticks, int threads, bool evaluates_everything, const Act& act) {
  World world = World::from_text(text, threads);
  world.session().evaluate_everything(evaluates_everything);
  States states;
  for (int tick = 0; tick < ticks; ++tick) {
    act(world, tick);
    world.tick();
    states.push_back(world.session().state());
  }
  return states;
}

// One world after the other: the thread sanitizer cannot see into the library that follows rays, which both would call at a time.
template <class Act>
void expect_the_same_states(const std::string& text, int ticks, int threads, const Act& act) {
  const States changed = states_of(text, ticks, threads, false, act), everything = states_of(text, ticks, 1, true, act);
  for (std::size_t t = 0; t < changed.size() && !testing::Test::HasFatalFailure(); ++t) {
    SCOPED_TRACE("tick " + std::to_string(changed[t]->tick));
    expect_same(*changed[t], *everything[t]);
  }
}

class ChangeLaws : public testing::TestWithParam<std::string> {};

TEST_P(ChangeLaws, EveryTickIsAsIfEverythingHadBeenAsked) {
  expect_the_same_states(project_file(GetParam()), 40, 1, [](World&, int) {});
}

TEST_P(ChangeLaws, SoItIsThroughCommandsUndoAndRedo) {
  const std::uint64_t seed = GetParam().size();
  expect_the_same_states(project_file(GetParam()), 24, 2, [&](World& world, int tick) {
    Random random(seed, static_cast<std::uint64_t>(tick));
    if (random.below(2) == 0) (void)world.submit(random_command(world.session().scene(), random, tick));
    const std::uint64_t choice = random.below(10);
    if (choice == 0) (void)world.session().undo(Author{"test"});
    if (choice == 1) (void)world.session().redo(Author{"test"});
  });
}

INSTANTIATE_TEST_SUITE_P(Small, ChangeLaws, testing::ValuesIn(small_scenes()),
                         [](const auto& test) { return scene_test_name(test); });

TEST(ChangeLawsOfAll, SoItIsInRandomScenesInWhichMuchFails) {
  for (std::uint64_t seed = 100; seed < 160 && !testing::Test::HasFatalFailure(); ++seed) {
    SCOPED_TRACE("scene " + std::to_string(seed));
    expect_the_same_states(random_scene(seed), 12, 1 + static_cast<int>(seed % 3), [&](World& world, int tick) {
      Random random(seed, static_cast<std::uint64_t>(tick));
      if (random.below(3) == 0) (void)world.submit(random_command(world.session().scene(), random, tick));
    });
  }
}

TEST(ChangeLawsOfAll, WhatAStateSharesWithTheOneBeforeIsTheSameObject) {
  World world = World::from_file("scenes/studies/sixty_volumes.json");
  ASSERT_TRUE(world.settle(2000));
  world.tick(2000);
  const auto before = world.session().state();
  const TickCounts counted = world.session().counts();
  world.tick();
  const State& after = world.state();
  const TickCounts& now = world.session().counts();
  EXPECT_EQ(now.links, counted.links);
  EXPECT_EQ(now.nodes, counted.nodes);
  EXPECT_EQ(now.typifications, counted.typifications);
  EXPECT_EQ(now.sets, counted.sets);
  for (std::size_t leaf = 0; leaf < after.nodes.leaf_count(); ++leaf)
    EXPECT_TRUE(after.nodes.shares_leaf(before->nodes, leaf)) << "leaf " << leaf;
}

}  // namespace
}  // namespace bl
