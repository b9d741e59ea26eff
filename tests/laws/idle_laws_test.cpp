// Laws of rest: ticks that only count on can be passed at once, and come to the same bits as one after the other.
#include <string>

#include <gtest/gtest.h>

#include "core/file/scene_file.h"
#include "core/graph/simulation.h"
#include "tests/support/scene_files.h"
#include "tests/support/world.h"

namespace bl {
namespace {

constexpr int kMostToRest = 1500, kPassed = 37, kAfter = 5;

// One as people have it and one that takes each tick by itself.
struct Twins {
  explicit Twins(const std::string& path) : reading(read_scene(project_file(path), full_registry())) {
    for (Simulation* one : {&at_once, &one_by_one}) {
      one->set_scene(reading.scene);
      if (reading.state) { EXPECT_TRUE(one->restore_state(*reading.state).ok()); }
    }
  }
  void step() { at_once.step(), one_by_one.step(); }

  SceneReading reading;
  Simulation at_once{full_registry(), 1}, one_by_one{full_registry(), 1};
};

class IdleLaws : public testing::TestWithParam<std::string> {};

TEST_P(IdleLaws, PassingIdleTicksIsTheSameAsTakingThem) {
  Twins twins(GetParam());
  for (int tick = 0; tick < kMostToRest && !twins.at_once.is_idle(); ++tick) twins.step();
  if (!twins.at_once.is_idle()) {
    const Dependents& dependents = *twins.at_once.state()->plan->dependents;
    EXPECT_FALSE(dependents.sets->timed_nodes.empty() && dependents.links->timed.empty()) << "nothing in it reads the time";
    return;
  }
  twins.at_once.pass(kPassed);
  for (int tick = 0; tick < kPassed; ++tick) {
    twins.one_by_one.step();
    ASSERT_TRUE(twins.one_by_one.is_idle()) << "an idle tick is followed by an idle one";
  }
  EXPECT_EQ(twins.at_once.state()->tick, twins.one_by_one.state()->tick);
  EXPECT_EQ(twins.at_once.state()->hash, twins.one_by_one.state()->hash);
  EXPECT_EQ(twins.at_once.state()->is_settled(), twins.one_by_one.state()->is_settled());
  // Who edits the scene wakes both to the same.
  ASSERT_FALSE(twins.reading.scene.nodes.empty());
  const std::string moved = twins.reading.scene.nodes.begin()->first;
  twins.reading.scene.nodes[moved].types[std::string(kBaseNode)]["position"] = Vector3{3, 4, 5};
  for (Simulation* one : {&twins.at_once, &twins.one_by_one}) {
    one->set_scene(twins.reading.scene, {{moved, "node.position"}});
    EXPECT_FALSE(one->is_idle()) << "an edit is not slept through";
  }
  for (int tick = 0; tick < kAfter; ++tick) {
    twins.step();
    ASSERT_EQ(twins.at_once.state()->hash, twins.one_by_one.state()->hash);
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes, IdleLaws, testing::ValuesIn(small_scenes()),
                         scene_test_name<testing::TestParamInfo<std::string>>);

TEST(IdleLaw, ScenesThatSettleComeToIt) {
  for (const char* path : {"scenes/start/quarter.json", "scenes/links/attract.json"}) {
    Twins twins(path);
    int tick = 0;
    for (; tick < kMostToRest && !twins.at_once.is_idle(); ++tick) twins.at_once.step();
    EXPECT_LT(tick, kMostToRest) << path;
  }
}

// The cap has no means to bring the floor areas down: it says so, and is not asked again until something changes.
TEST(IdleLaw, ARuleThatCannotBeKeptCostsNothing) {
  Twins twins("scenes/links/set_cap.json");
  twins.one_by_one.evaluate_everything(true);
  Scene scene = twins.reading.scene;
  scene.links["l1_cap"].parameters["gain"] = 0.0;
  const auto read = [&](const Scene& now) {
    for (Simulation* one : {&twins.at_once, &twins.one_by_one}) one->set_scene(now);
  };
  const auto step = [&] {
    twins.step();
    ASSERT_EQ(twins.at_once.state()->hash, twins.one_by_one.state()->hash);
    ASSERT_TRUE(twins.at_once.state()->links[0].says_the_same(twins.one_by_one.state()->links[0]))
        << "tick " << twins.at_once.state()->tick;
  };
  read(scene);
  for (int tick = 0; tick < kMostToRest && !twins.at_once.is_idle(); ++tick) step();
  ASSERT_TRUE(twins.at_once.is_idle());
  ASSERT_TRUE(twins.at_once.state()->links[0].is_stuck);
  const std::size_t asked = twins.at_once.counts().links;
  for (int tick = 0; tick < 10; ++tick) step();
  EXPECT_EQ(twins.at_once.counts().links, asked);
  // While something else moves nobody knows yet whether it is in vain.
  scene.links["l2_near"] = LinkRecord{"attract", {{"house_1"}, "", ""}, {{"house_3"}, "", ""}, true, false, 1, {}, ""};
  read(scene);
  for (int tick = 0; tick < 3 && twins.at_once.state()->links[0].is_stuck; ++tick) step();
  EXPECT_FALSE(twins.at_once.state()->links[0].is_stuck);
  for (int tick = 0; tick < kMostToRest && !twins.at_once.is_idle(); ++tick) step();
  EXPECT_TRUE(twins.at_once.is_idle());
  EXPECT_TRUE(twins.at_once.state()->links[0].is_stuck);
  scene.links["l1_cap"].parameters["gain"] = 0.5;
  read(scene);
  for (int tick = 0; tick < kMostToRest && !twins.at_once.state()->is_settled(); ++tick) step();
  EXPECT_TRUE(twins.at_once.state()->is_settled());
}

TEST(IdleLaw, EvaluatingEverythingIsNeverIdle) {
  Twins twins("scenes/start/quarter.json");
  twins.at_once.evaluate_everything(true);
  for (int tick = 0; tick < 600; ++tick) {
    twins.at_once.step();
    ASSERT_FALSE(twins.at_once.is_idle());
  }
}

}  // namespace
}  // namespace bl
