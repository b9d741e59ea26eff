// Evaluations over sets: who is a member, what they are told when nobody serves them, and wrong choices of ports.
#include <gtest/gtest.h>

#include "core/define/typification_builder.h"
#include "core/file/scene_file.h"
#include "core/graph/simulation.h"
#include "core/graph/sums_of_now.h"
#include "tests/support/world.h"

namespace bl {
namespace {

// Tells all volumes twice how large they are, and not the same.
struct Waverer {
  struct In {
    Selection first{{}, "smart_volume", {}}, second{{}, "smart_volume", {}};
  };
  struct Member {
    std::string id;
  };
  struct Reply {
    double volume = 0;
  };
  struct Sets {
    std::vector<Member> first, second;
  };
  struct Out {
    std::vector<Reply> first, second;
  };
  static void declare(TypificationBuilder<Waverer>& t) {
    t.id("waverer").label("Waverer").doc("Contradicts itself.");
    t.in(&In::first, "first").doc("Whom it tells first.");
    t.in(&In::second, "second").doc("Whom it tells then.");
    t.set("first", &Sets::first, &Out::first).reads(&Member::id, "node.id").writes(&Reply::volume, "smart_volume.volume");
    t.set("second", &Sets::second, &Out::second).reads(&Member::id, "node.id").writes(&Reply::volume, "smart_volume.volume");
  }
  static Result<Out> evaluate(const In&, const Sets& sets, const Tick&) {
    return Out{std::vector<Reply>(sets.first.size(), {1}), std::vector<Reply>(sets.second.size(), {2})};
  }
};

constexpr const char* kScene = R"({"format": "behaviourlinks", "version": 1, "nodes": [
  {"id": "a", "position": [10, 10, 5], "types": {"smart_volume": {"demand": 900}}},
  {"id": "b", "position": [30, 30, 5], "types": {"smart_volume": {"demand": 900}}},
  {"id": "site", "types": {"boundary": {}}},
  {"id": "solver", "types": {"smart_volumes_solver": {}}},
  {"id": "sums", "types": {"statistics": {}}}]})";

TEST(Sets, AMemberThatLeavesItsSolverIsToldSo) {
  World world = World::from_text(kScene);
  world.tick(5);
  EXPECT_GT(world.number("b", "smart_volume.volume"), 800);
  ASSERT_EQ(world.submit(command<SetPort>({"solver", {"smart_volumes_solver.members"}, {"\"a\""}})), "");
  world.tick();
  EXPECT_EQ(world.number("b", "smart_volume.volume"), 0);
  EXPECT_EQ(world.text("b", "smart_volume.reason"), "no solver takes care of it, or its solver fails");
  EXPECT_GT(world.number("a", "smart_volume.volume"), 800);
}

TEST(Sets, WhoContradictsItselfIsToldSoAndItsFirstWordStands) {
  Registry registry = full_registry();
  registry.add(TypificationBuilder<Waverer>::build());
  Simulation simulation(registry, 1);
  const SceneReading reading = read_scene(R"({"format": "behaviourlinks", "version": 1, "nodes": [
    {"id": "a", "types": {"smart_volume": {}}}, {"id": "b", "types": {"smart_volume": {}}},
    {"id": "waverer", "types": {"waverer": {}}}]})",
                                          registry);
  ASSERT_TRUE(reading.is_usable());
  simulation.set_scene(reading.scene);
  simulation.step();
  const State& state = *simulation.state();
  const Plan& plan = *state.plan;
  for (const char* volume : {"a", "b"})
    EXPECT_EQ(as_number(state.value(*plan.find(plan.node_index(volume), {"smart_volume", "volume", ""}))), 1) << volume;
  const auto failure = first_failure(state);
  ASSERT_TRUE(failure);
  EXPECT_NE(failure->message.find("already belongs to `waverer`"), std::string::npos) << failure->message;
}

TEST(Sets, ATextCannotBeSummedUp) {
  World world = World::from_text(kScene);
  ASSERT_EQ(world.submit(command<SetPort>({"sums", {"statistics.port"}, {"\"smart_volume.state\""}})), "");
  world.tick();
  EXPECT_EQ(world.node_error("sums", "statistics"),
            "nodes/sums/statistics/nodes: the evaluation reads a number, but `smart_volume.state` holds a text");
}

TEST(Sets, NewtonMeetsTheDemandsInFewTicks) {
  World world = World::from_text(kScene);
  ASSERT_EQ(world.submit(command<SetPort>({"solver", {"smart_volumes_solver.method"}, {"\"newton\""}})), "");
  ASSERT_EQ(world.submit(command<SetPort>({"solver", {"smart_volumes_solver.steps"}, {"1"}})), "");
  ASSERT_EQ(world.submit(command<SetPort>({"solver", {"smart_volumes_solver.tolerance"}, {"1e-6"}})), "");
  world.tick(10);
  EXPECT_NEAR(world.number("a", "smart_volume.volume"), 900, 1e-3);
}

// Sums over sets read what was there before the solver: a tick late in the state, but not for readers.
TEST(Sets, SumsAreReadBesideTheFiguresThatTheyAddUp) {
  World world = World::from_text(kScene);
  const auto sum_in = [](const State& state) {
    const auto ref = state.plan->find(state.plan->node_index("sums"), *parse_port_path("statistics.sum"));
    return std::get<double>(state.value(*ref));
  };
  double largest_lag = 0;
  for (int tick = 0; tick < 8; ++tick) {
    world.tick();
    const double volumes = world.number("a", "smart_volume.volume") + world.number("b", "smart_volume.volume");
    const State& state = world.state();
    const State seen = with_sums_of_now(state);
    EXPECT_NEAR(sum_in(seen), volumes, 1e-9) << tick;
    EXPECT_EQ(seen.hash, state.hash) << "it is the same state, read";
    largest_lag = std::max(largest_lag, std::abs(sum_in(state) - volumes));
  }
  EXPECT_GT(largest_lag, 1) << "what a tick has lags, or there would be nothing to be read anew";
}

TEST(Sets, SumsThatFailAreReadAsTheyAre) {
  World world = World::from_text(kScene);
  ASSERT_EQ(world.submit(command<SetPort>({"sums", {"statistics.port"}, {"\"smart_volume.state\""}})), "");
  world.tick();
  const State seen = with_sums_of_now(world.state());
  EXPECT_TRUE(seen.nodes[seen.plan->node_index("sums")].types[0].error ||
              seen.nodes[seen.plan->node_index("sums")].types[1].error);
}

}  // namespace
}  // namespace bl
