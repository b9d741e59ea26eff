// Evaluations over sets: who is a member, what they are told when nobody serves them, and wrong choices of ports.
#include <gtest/gtest.h>

#include "tests/support/world.h"

namespace bl {
namespace {

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

}  // namespace
}  // namespace bl
