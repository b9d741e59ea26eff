// Times of ticks on a clock that moves by a thousandth whenever it is read.
#include "core/graph/tick_times.h"

#include <atomic>
#include <chrono>
#include <thread>

#include <gtest/gtest.h>

#include "core/session/commands.h"
#include "tests/support/world.h"

namespace bl {
namespace {

constexpr double kReading = 1e-3;

double counting_clock() {
  static std::atomic<std::int64_t> readings = 0;
  return kReading * static_cast<double>(++readings);
}

constexpr const char* kTimedScene = "scenes/links/attract.json";

const WorkTime& link_of(const TimeTable& table, const std::string& id) {
  std::size_t l = 0;
  while (table.plan->links[l].id != id) ++l;
  return table.links[l];
}

TEST(TickTimes, ARecentSumCountsEachTickLessThanTheOneAfterIt) {
  WorkTime time;
  for (std::int64_t tick = 1; tick <= 2000; ++tick) time.add(tick, 0.5, 2, 6);
  EXPECT_EQ(time.evaluations, 4000u);
  EXPECT_EQ(time.pairs, 12000u);
  EXPECT_DOUBLE_EQ(time.seconds, 1000);
  // 1 + 0.95 + 0.95² + ... is 20.
  EXPECT_NEAR(time.recent_seconds, 10, 1e-9);
  EXPECT_NEAR(time.recent_evaluations, 40, 1e-9);
  EXPECT_NEAR(time.recent_pairs, 120, 1e-9);
  time.fade(2001);
  EXPECT_NEAR(time.recent_seconds, 9.5, 1e-9);
  time.fade(12001);
  EXPECT_EQ(time.recent_seconds, 0);
  EXPECT_DOUBLE_EQ(time.seconds, 1000);
}

TEST(TickTimes, PartsMakeUpTheTick) {
  World world = World::from_file(kTimedScene);
  TickTimes times(counting_clock);
  world.session().measure(&times);
  world.tick();
  const TimeTable table = times.table();
  double parts = 0;
  for (const WorkTime& part : table.parts) {
    EXPECT_EQ(part.evaluations, 1u);
    parts += part.seconds;
  }
  // The tick reads the clock once more, after its last part.
  EXPECT_NEAR(table.ticks.seconds, parts + kReading, 1e-9);
  EXPECT_GT(table.parts[static_cast<std::size_t>(TickPart::links)].seconds, kReading);
}

TEST(TickTimes, WhatPeopleHaveChangedIsCompiledInThePartOfCommands) {
  World world = World::from_file(kTimedScene);
  TickTimes times(counting_clock);
  world.session().measure(&times);
  const auto commands = [&] { return times.table().parts[static_cast<std::size_t>(TickPart::commands)].seconds; };
  world.tick();
  EXPECT_EQ(commands(), 0);
  const std::string node = world.session().scene().nodes.begin()->first;
  ASSERT_EQ(world.submit(command<SetPort>({node, {"node.position"}, {"[40, 0, 0]"}})), "");
  world.tick();
  EXPECT_NEAR(commands(), kReading, 1e-9);
}

TEST(TickTimes, AreHandedOnFromPlanToPlan) {
  World world = World::from_file(kTimedScene);
  TickTimes times(counting_clock);
  world.session().measure(&times);
  world.tick(5);
  const TimeTable before = times.table();
  const std::string link = before.plan->links[0].id;
  // A role that was evaluated: times of nobody would be the same under any plan.
  std::uint32_t at = 0;
  while (before.roles[before.type_index(at, before.plan->nodes[at].types.size() - 1)].evaluations == 0) ++at;
  const std::string node = before.plan->nodes[at].id;
  const std::size_t type = before.plan->nodes[at].types.size() - 1;
  const auto role_of = [&](const TimeTable& table) { return table.roles[table.type_index(table.plan->node_index(node), type)]; };
  ASSERT_GT(link_of(before, link).evaluations, 0u);
  // Its id comes first, so that all others get another index.
  ASSERT_EQ(world.submit(command<AddNode>({"aaa", {R"({"position": [9, 9, 9], "types": {"smart_volume": {}}})"}})), "");
  world.tick();
  const TimeTable after = times.table();
  ASSERT_NE(after.plan->dependents, before.plan->dependents);
  ASSERT_NE(after.plan->node_index(node), before.plan->node_index(node));
  EXPECT_EQ(after.roles.size(), before.roles.size() + after.plan->nodes[0].types.size());
  EXPECT_GE(link_of(after, link).evaluations, link_of(before, link).evaluations);
  EXPECT_GE(role_of(after).evaluations, role_of(before).evaluations);
  EXPECT_EQ(after.ticks.evaluations, 6u);
}

// The sun hours of this scene are worked out by an analysis beside the ticks.
TEST(TickTimes, AnalysesAreMeasuredOnTheirOwnThread) {
  World world = World::from_file("scenes/nodes/sun_study.json");
  TickTimes times(counting_clock);
  world.session().measure(&times);
  ASSERT_FALSE(world.state().plan->analyses.empty());
  const auto is_begun = [&] { return world.state().analyses[0].running != nullptr; };
  for (int tick = 0; tick < 10 && !is_begun(); ++tick) world.tick();
  ASSERT_TRUE(is_begun());
  for (int k = 0; k < 20000 && times.beside(0)->runs == 0; ++k) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  world.tick();
  const TimeTable table = times.table();
  EXPECT_EQ(table.beside[0].evaluations, 1u);
  EXPECT_GE(table.beside[0].seconds, kReading);
}

}  // namespace
}  // namespace bl
