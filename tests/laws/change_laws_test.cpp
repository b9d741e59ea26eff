// Laws of evaluation on change: what has not changed is not asked, and every tick comes out as if everything had been asked.
#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/base/random.h"
#include "core/base/text.h"
#include "core/session/commands.h"
#include "tests/support/every_tick.h"
#include "tests/support/random_commands.h"
#include "tests/support/random_scenes.h"
#include "tests/support/scene_files.h"
#include "tests/support/world.h"

namespace bl {
namespace {

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

// A box of many volumes at random places, held inside it and under a sum, of which every tenth keeps its distance from the
// others of its kind. The solver fits those who miss their demand alone only where there are many.
std::string crowded_box(std::uint64_t seed, double fill) {
  constexpr int kCount = 120;
  Random random(seed);
  std::string nodes, links;
  for (int v = 0; v < kCount; ++v) {
    const Point3 at{random.uniform(2, 48), random.uniform(2, 48), random.uniform(2, 48)};
    nodes += R"(, {"id": "v)" + std::to_string(1000 + v) + R"(", "position": [)" + shortest(at.x) + ", " + shortest(at.y) + ", " +
             shortest(at.z) + "]" + (v % 10 == 0 ? R"(, "tags": ["public"])" : "") +
             R"(, "types": {"smart_volume": {"demand": )" + shortest(fill * 125000 / kCount) + "}}}";
  }
  return R"({"format": "behaviourlinks", "version": 1, "settings": {}, "nodes": [)"
         R"({"id": "plot", "types": {"boundary": {"form": "plan", "plan": [[0, 0, 0], [50, 0, 0], [50, 50, 0], [0, 50, 0]], "height": 50}}}, )"
         R"({"id": "solver", "types": {"smart_volumes_solver": {}}}, )"
         R"({"id": "sum", "types": {"statistics": {"port": "smart_volume.volume", "nodes": {"typification": "smart_volume"}}}})" +
         nodes +
         R"(], "links": [)"
         R"({"id": "apart", "kind": "keep_distance", "from": {"tag": "public"}, "to": {"tag": "public"}, )"
         R"("parameters": {"minimum": 12, "maximum": 1000}}, )"
         R"({"id": "cap", "kind": "set_cap", "from": "sum", "to": {"typification": "smart_volume"}, "parameters": {"cap": 1e9}}, )"
         R"({"id": "inside", "kind": "inside_boundary", "from": "plot", "to": {"typification": "smart_volume"}, )"
         R"("parameters": {"margin": 1}}]})";
}

std::string volume_name(Random& random) { return "v" + std::to_string(1000 + random.below(120)); }

Command moved(const State& state, const std::string& node, const Vector3& by) {
  const Vector3 place =
      std::get<Vector3>(state.value(*state.plan->find(state.plan->node_index(node), {"node", "position", ""}))) + by;
  return command<SetPort>({node, {"node.position"}, JsonValue::of(Json::array({place.x, place.y, place.z}))});
}

TEST(ChangeLawsOfAll, SoItIsInACrowdUnderManyHands) {
  for (const double fill : {0.6, 0.95}) {
    SCOPED_TRACE("fill " + shortest(fill));
    expect_the_same_states(crowded_box(7, fill), 30, 2, [&](World& world, int tick) {
      Random random(3, static_cast<std::uint64_t>(tick));
      const std::string node = volume_name(random);
      if (tick % 2 == 0) (void)world.submit(moved(world.state(), node, {random.uniform(-1, 1), random.uniform(-1, 1), 0}));
      if (tick % 5 == 0)
        (void)world.submit(
            command<SetPort>({volume_name(random), {"smart_volume.demand"}, JsonValue::of(Json(random.uniform(100, 900)))}));
      if (tick % 7 == 0) (void)world.session().undo(Author{"test"});
    });
  }
}

// One volume is dragged through many that rest: those far away stay the same objects, and pairs without it are not asked.
TEST(ChangeLawsOfAll, ADragCostsWhatIsAroundIt) {
  World world = World::from_text(crowded_box(11, 0.5));
  while (!world.state().due.is_nothing() && world.state().tick < 3000) world.tick();
  ASSERT_TRUE(world.state().due.is_nothing());
  Random random(5);
  for (int frame = 0; frame < 10; ++frame) {
    const auto before = world.session().state();
    const std::size_t pairs = world.session().counts().pairs;
    (void)world.submit(moved(*before, "v1055", {0.1, 0, 0}));
    world.tick();
    std::size_t changed = 0;
    for (std::size_t n = 0; n < before->nodes.size(); ++n) changed += world.state().nodes.item(n) != before->nodes.item(n);
    EXPECT_LE(changed, 60u) << "frame " << frame;
    // The dragged one inside its boundary, and the cap, which is one evaluation.
    EXPECT_LE(world.session().counts().pairs - pairs, 40u) << "frame " << frame;
  }
  world.tick(40);
  EXPECT_LE(world.state().largest_residual, 0.005);
}

}  // namespace
}  // namespace bl
