// Laws of measuring: a tick whose time is taken has the same bits as one whose time is not, and whatever was evaluated is in the
// table.
#include <chrono>

#include <gtest/gtest.h>

#include "core/base/random.h"
#include "tests/support/random_commands.h"
#include "tests/support/scene_files.h"
#include "tests/support/world.h"

namespace bl {
namespace {

double wall_seconds() {
  using Clock = std::chrono::steady_clock;
  return std::chrono::duration<double>(Clock::now().time_since_epoch()).count();
}

struct Sums {
  std::size_t links = 0, pairs = 0, roles = 0, sets = 0;
  double seconds = 0;
};

Sums sums_of(const TimeTable& table) {
  Sums sums;
  for (const WorkTime& link : table.links) {
    sums.links += link.evaluations;
    sums.pairs += link.pairs;
    sums.seconds += link.seconds;
  }
  for (std::size_t n = 0; n < table.plan->nodes.size(); ++n)
    for (std::size_t t = 0; t < table.plan->nodes[n].types.size(); ++t) {
      const WorkTime& role = table.roles[table.type_index(n, t)];
      (table.plan->nodes[n].types[t].definition->sets.empty() ? sums.roles : sums.sets) += role.evaluations;
      sums.seconds += role.seconds;
    }
  return sums;
}

class TimeLaws : public testing::TestWithParam<std::string> {};

TEST_P(TimeLaws, MeasuringChangesNoHash) {
  for (const int threads : {1, 2, 3}) {
    SCOPED_TRACE(threads);
    const std::string text = project_file(GetParam());
    World plain = World::from_text(text), measured = World::from_text(text, threads);
    TickTimes times(wall_seconds);
    for (int tick = 0; tick < 24; ++tick) {
      // Nobody looks for a while, and other scenes come and go meanwhile.
      measured.session().measure(tick / 4 % 3 == 2 ? nullptr : &times);
      Random random(GetParam().size(), static_cast<std::uint64_t>(tick));
      if (random.below(3) == 0) {
        const Command command = random_command(plain.session().scene(), random, tick);
        ASSERT_EQ(plain.submit(command), measured.submit(command));
      }
      plain.tick();
      measured.tick();
      ASSERT_EQ(plain.state().hash, measured.state().hash) << "tick " << tick;
    }
    EXPECT_EQ(times.ticks(), 16);
  }
}

TEST_P(TimeLaws, WhatIsEvaluatedIsInTheTableAndNotLongerThanTheTick) {
  World world = World::from_file(GetParam());
  TickTimes times(wall_seconds);
  world.session().measure(&times);
  world.tick(20);
  const TimeTable table = times.table();
  const TickCounts& counts = world.session().counts();
  const Sums sums = sums_of(table);
  EXPECT_EQ(sums.links, counts.links);
  EXPECT_EQ(sums.pairs, counts.pairs);
  EXPECT_EQ(sums.roles, counts.typifications);
  EXPECT_EQ(sums.sets, counts.sets);
  EXPECT_EQ(table.ticks.evaluations, 20u);
  double parts = 0;
  for (const WorkTime& part : table.parts) parts += part.seconds;
  const double rounding = 1e-9;
  EXPECT_LE(sums.seconds, parts + rounding);
  EXPECT_LE(parts, table.ticks.seconds + rounding);
}

INSTANTIATE_TEST_SUITE_P(Small, TimeLaws, testing::ValuesIn(small_scenes()),
                         [](const auto& test) { return scene_test_name(test); });

}  // namespace
}  // namespace bl
