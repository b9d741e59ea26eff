// Laws of evaluation on change: what has not changed is not asked, and every tick comes out as if everything had been asked.
#include <string>

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

// Two worlds of one scene, one of which evaluates everything.
struct Pair {
  explicit Pair(const std::string& text, int threads = 1)
      : changed(World::from_text(text, threads)), everything(World::from_text(text)) {
    everything.session().evaluate_everything(true);
  }

  void tick() {
    changed.tick();
    everything.tick();
    SCOPED_TRACE("tick " + std::to_string(changed.state().tick));
    expect_same(changed.state(), everything.state());
  }

  void submit(const Command& command) { EXPECT_EQ(changed.submit(command), everything.submit(command)); }

  World changed, everything;
};

class ChangeLaws : public testing::TestWithParam<std::string> {};

TEST_P(ChangeLaws, EveryTickIsAsIfEverythingHadBeenAsked) {
  Pair pair(project_file(GetParam()));
  for (int tick = 0; tick < 40 && !HasFatalFailure(); ++tick) pair.tick();
}

TEST_P(ChangeLaws, SoItIsThroughCommandsUndoAndRewind) {
  Pair pair(project_file(GetParam()), 2);
  Random random(5, GetParam().size());
  for (int round = 0; round < 24 && !HasFatalFailure(); ++round) {
    if (random.below(2) == 0) pair.submit(random_command(pair.changed.session().scene(), random, round));
    const std::uint64_t choice = random.below(10);
    for (World* world : {&pair.changed, &pair.everything}) {
      if (choice == 0) (void)world->session().undo("test");
      if (choice == 1) (void)world->session().redo("test");
    }
    pair.tick();
  }
}

INSTANTIATE_TEST_SUITE_P(Small, ChangeLaws, testing::ValuesIn(small_scenes()),
                         [](const auto& test) { return scene_test_name(test); });

TEST(ChangeLawsOfAll, SoItIsInRandomScenesInWhichMuchFails) {
  for (std::uint64_t seed = 100; seed < 160 && !testing::Test::HasFatalFailure(); ++seed) {
    SCOPED_TRACE("scene " + std::to_string(seed));
    Pair pair(random_scene(seed), 1 + static_cast<int>(seed % 3));
    Random random(seed);
    for (int tick = 0; tick < 12 && !testing::Test::HasFatalFailure(); ++tick) {
      if (random.below(3) == 0) pair.submit(random_command(pair.changed.session().scene(), random, tick));
      pair.tick();
    }
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
