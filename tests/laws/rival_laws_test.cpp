// Laws of sets that write to the same ports: they are asked together, and rest together.
#include <string>

#include "core/session/commands.h"
#include "tests/support/every_tick.h"

namespace bl {
namespace {

// Two solvers that both want the same volumes, each with a boundary of its own; the first one by name has them.
std::string contested_volumes() {
  std::string text = R"({"format": "behaviourlinks", "version": 1, "nodes": [)";
  for (const char* solver : {"a", "b"}) {
    const std::string box = "box_" + std::string(solver);
    text += R"({"id": ")" + box + R"(", "types": {"boundary": {"form": "plan", "height": 20,
            "plan": [[0, 0, 0], [30, 0, 0], [30, 30, 0], [0, 30, 0]]}}}, )";
    text += R"({"id": ")" + std::string(solver) + R"(", "types": {"smart_volumes_solver": {"boundary": ")" + box + R"("}}}, )";
  }
  for (int i = 0; i < 6; ++i)
    text += std::string(i == 0 ? "" : ", ") + R"({"id": "v)" + std::to_string(i) + R"(", "position": [)" +
            std::to_string(4 + 4 * i) + ", " + std::to_string(5 + 7 * (i % 3)) +
            R"(, 6], "types": {"smart_volume": {"demand": )" + std::to_string(700 + 100 * i) + "}}}";
  return text + R"(], "links": []})";
}

Command set(const std::string& node, const std::string& port, const Json& value) {
  return command<SetPort>({node, {port}, JsonValue::of(value)});
}

TEST(RivalLaws, WhoComesFirstIsFoundOutAsIfAllWereAskedInEveryTick) {
  for (const int threads : {1, 3})
    expect_the_same_states(contested_volumes(), 40, threads, [](World& world, int tick) {
      // Something that both read, something that only the second one reads, and a first one that fails for a while.
      if (tick == 8) (void)world.submit(set("v2", "smart_volume.demand", 900.0));
      if (tick == 14) (void)world.submit(set("b", "smart_volumes_solver.tolerance", 0.02));
      if (tick == 20) (void)world.submit(set("box_a", "boundary.height", 0.0));
      if (tick == 30) (void)world.submit(set("box_a", "boundary.height", 22.0));
    });
}

TEST(RivalLaws, WhoIsLeftAloneIsAskedAgain) {
  for (const int at : {6, 70})
    expect_the_same_states(contested_volumes(), at + 12, 1, [at](World& world, int tick) {
      if (tick == at) (void)world.submit(set("a", "smart_volumes_solver.members", {{"tag", "none"}}));
      if (tick == at + 6) (void)world.submit(set("a", "smart_volumes_solver.members", {{"typification", "smart_volume"}}));
    });
}

TEST(RivalLaws, AtRestNobodyIsAsked) {
  World world = World::from_text(contested_volumes());
  world.tick(60);
  const std::size_t sets = world.session().counts().sets;
  world.tick(10);
  EXPECT_EQ(world.session().counts().sets, sets);
  // Both are asked for what only one of them reads.
  (void)world.submit(set("b", "smart_volumes_solver.tolerance", 0.02));
  world.tick();
  EXPECT_EQ(world.session().counts().sets, sets + 2);
}

}  // namespace
}  // namespace bl
