// A tick that ends in an exception after a solver has answered: in the next one its answers are given again.
#include <stdexcept>

#include <gtest/gtest.h>

#include "core/define/typification_builder.h"
#include "core/file/scene_file.h"
#include "core/graph/simulation.h"
#include "tests/support/world.h"

namespace bl {
namespace {

bool g_throws = false;

// Reads the places of all volumes, and throws while it is told to.
struct Thrower {
  struct In {
    Selection nodes{{}, "smart_volume", {}};
  };
  struct Member {
    Point3 position;
  };
  struct Sets {
    std::vector<Member> nodes;
  };
  struct Out {
    std::int64_t count = 0;
  };
  static void declare(TypificationBuilder<Thrower>& t) {
    t.id("thrower").label("Thrower").doc("Fails as no evaluation should.");
    t.in(&In::nodes, "nodes").doc("Whom it counts.");
    t.out(&Out::count, "count").doc("How many there are.");
    t.set("nodes", &Sets::nodes).reads(&Member::position, "node.position", Unit::metre);
  }
  static Result<Out> evaluate(const In&, const Sets& sets, const Tick&) {
    if (g_throws) throw std::runtime_error("told to");
    return Out{static_cast<std::int64_t>(sets.nodes.size())};
  }
};

// Two volumes that touch; the thrower comes after their solver.
constexpr const char* kTwo = R"({"format": "behaviourlinks", "version": 1, "nodes": [
  {"id": "a", "position": [10, 10, 10], "types": {"smart_volume": {"demand": 2000}}},
  {"id": "b", "position": [18, 10, 10], "types": {"smart_volume": {"demand": 2000}}},
  {"id": "plot", "types": {"boundary": {"form": "plan", "plan": [[0, 0, 0], [30, 0, 0], [30, 20, 0], [0, 20, 0]], "height": 20}}},
  {"id": "solver", "types": {"smart_volumes_solver": {}}},
  {"id": "thrower", "types": {"thrower": {}}}]})";

TEST(KeptSets, AnswersThatAnExceptionHasLostAreGivenAgain) {
  Registry registry = full_registry();
  registry.add(TypificationBuilder<Thrower>::build());
  const SceneReading reading = read_scene(kTwo, registry);
  ASSERT_TRUE(reading.is_usable());
  Simulation kept(registry, 1), everything(registry, 1);
  everything.evaluate_everything(true);
  for (Simulation* simulation : {&kept, &everything}) {
    simulation->set_scene(reading.scene);
    for (int tick = 0; tick < 30; ++tick) simulation->step();
  }
  // So little that no weight follows: nothing but its cell tells of the neighbour's change.
  Scene moved = reading.scene;
  moved.nodes.edit("a").types["node"]["position"] = Vector3{10.01, 10, 10};
  for (Simulation* simulation : {&kept, &everything}) simulation->set_scene(moved, {{"a", "node.position"}});
  const auto before = kept.state();
  g_throws = true;
  EXPECT_THROW(kept.step(), std::runtime_error);
  g_throws = false;
  EXPECT_EQ(kept.state(), before);
  for (int tick = 0; tick < 5; ++tick) {
    kept.step();
    everything.step();
    EXPECT_EQ(kept.state()->hash, everything.state()->hash) << "tick " << kept.state()->tick;
  }
  EXPECT_NE(kept.state()->hash, before->hash);
}

}  // namespace
}  // namespace bl
