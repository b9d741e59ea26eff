// Ticks that fail: no edit is lost, people hear why, and the log around it can be read.
#include "core/host/live_session.h"

#include <atomic>
#include <chrono>
#include <new>
#include <optional>
#include <thread>

#include <gtest/gtest.h>

#include "core/define/link_builder.h"
#include "core/host/host.h"
#include "tests/core/host/replays.h"
#include "tests/support/world.h"

namespace bl::host {
namespace {

// A link kind that people can make fail, or wait, in the middle of a tick; it changes nothing.
struct Trap {
  struct In {
    double number = 0;
  };
  struct Ends {
    Point3 to;
  };
  struct Out {
    std::optional<Vector3> to;
  };
  static inline std::atomic<bool> fails_to_begin = false, fails = false, waits = false;
  static inline std::atomic<int> begun = 0;

  static void declare(LinkBuilder<Trap>& l) {
    l.id("trap").label("Trap").doc("Fails when it is told to.");
    l.param(&In::number, "number").doc("A number.");
    l.reads(&Ends::to, End::to, "node.position", Unit::metre);
    l.proposes(&Out::to, End::to, "node.position", Unit::metre);
  }
  static Result<Out> evaluate(const In&, const Ends&, const Tick&) {
    ++begun;
    while (waits) std::this_thread::yield();
    if (fails) throw std::bad_alloc();
    return Out{};
  }
  static void disarm() { fails_to_begin = fails = waits = false; }
};

const Registry& registry_with_trap() {
  static const Registry kRegistry = [] {
    Registry registry = full_registry();
    LinkDefinition trap = LinkBuilder<Trap>::build();
    trap.instantiate = [made = trap.instantiate](std::span<const Value> values) {
      if (Trap::fails_to_begin) throw std::bad_alloc();
      return made(values);
    };
    registry.add(std::move(trap));
    return registry;
  }();
  return kRegistry;
}

constexpr const char* kTrapScene = R"({"format": "behaviourlinks", "version": 1,
  "nodes": [{"id": "a", "types": {"control": {}}}, {"id": "b", "types": {"control": {}}}],
  "links": [{"id": "trap", "kind": "trap", "from": "a", "to": "b"}]})";

std::unique_ptr<Host> trap_host() {
  const SceneReading reading = read_scene(kTrapScene, registry_with_trap());
  EXPECT_TRUE(reading.is_usable());
  return std::move(*Host::start(registry_with_trap(), reading.scene, nullptr, {.author = "desk"}));
}

TEST(LiveSession, AnEditOutlivesATickThatCannotBegin) {
  const auto host = trap_host();
  LiveSession& session = host->session();
  session.step(1);
  session.settle();
  Trap::fails_to_begin = true;
  ASSERT_TRUE(session.submit(command<SetPort>({"a", {"control.value"}, {"7"}})).ok());
  ASSERT_TRUE(session.submit(command<LockPort>({"b", {"control.value"}})).ok());  // its links are made anew
  session.step(1);
  session.settle();
  EXPECT_NE(session.moment()->failure, "");
  EXPECT_EQ(session.moment()->state->tick, 1);
  Trap::disarm();
  session.step(1);
  session.settle();
  EXPECT_EQ(session.moment()->failure, "");
  EXPECT_EQ(std::get<double>(value_in(*session.moment()->state, "a", "control.value")), 7);
}

TEST(LiveSession, AFailureStaysUntilATickGoesWell) {
  const auto host = trap_host();
  LiveSession& session = host->session();
  Trap::fails = true;
  session.step(1);
  session.settle();
  Trap::disarm();
  ASSERT_NE(session.moment()->failure, "");
  session.set_rate(0.1);
  session.play(false);
  ASSERT_TRUE(session.submit(command<SetPort>({"a", {"control.value"}, {"3"}})).ok());
  session.settle();
  EXPECT_NE(session.moment()->failure, "");
  session.step(1);
  session.settle();
  EXPECT_EQ(session.moment()->failure, "");
}

// The tick that an edit was made for never comes: what follows stands in the log behind it all the same.
TEST(LiveSession, LogAroundAFailedTickCanBeRead) {
  const auto host = trap_host();
  LiveSession& session = host->session();
  Trap::fails = Trap::waits = true;
  const int begun = Trap::begun;
  session.step(1);
  while (Trap::begun == begun) std::this_thread::yield();
  ASSERT_TRUE(session.submit(command<RenameNode>({"a", "During"})).ok());
  Trap::waits = false;
  session.settle();
  Trap::disarm();
  ASSERT_NE(session.moment()->failure, "");
  ASSERT_TRUE(session.submit(command<RenameNode>({"b", "After"})).ok());
  const auto log = read_log(host->log_text(), registry_with_trap());
  ASSERT_TRUE(log.ok()) << log.error().text();
  EXPECT_EQ(log->entries.size(), 2u);
}

// A session at tick 90, in which something was said on the way to it, so that going back and coming again is not the same.
std::unique_ptr<Host> host_at_ninety() {
  auto host = trap_host();
  LiveSession& session = host->session();
  for (const char* value : {"1", "2", "3"}) {
    EXPECT_TRUE(session.submit(command<SetPort>({"a", {"control.value"}, {value}})).ok());
    session.step(30);
    session.settle();
  }
  EXPECT_EQ(session.moment()->ticked->tick, 90);
  return host;
}

// Calls `meanwhile` while the ticking thread computes what the rewind asks for, which then fails.
template <class Meanwhile>
void fail_to_rewind(LiveSession& session, std::int64_t ticks, const Meanwhile& meanwhile) {
  Trap::fails = Trap::waits = true;
  const int begun = Trap::begun;
  session.rewind(ticks);
  while (Trap::begun == begun) std::this_thread::yield();
  meanwhile();
  Trap::waits = false;
  session.settle();
  Trap::disarm();
}

TEST(LiveSession, ARewindThatFailsIsInNoLog) {
  const auto host = host_at_ninety();
  LiveSession& session = host->session();
  const std::uint64_t hash = session.moment()->ticked->hash;
  fail_to_rewind(session, 55, [] {});
  EXPECT_NE(session.moment()->failure.find("the rewind failed"), std::string::npos) << session.moment()->failure;
  EXPECT_EQ(session.moment()->ticked->hash, hash);
  test::expect_replays(*host, registry_with_trap());
  ASSERT_TRUE(session.submit(command<SetPort>({"a", {"control.value"}, {"4"}})).ok());
  EXPECT_EQ(session.log().back().tick, 90);
  session.step(5);
  session.settle();
  EXPECT_EQ(session.moment()->failure, "");
  EXPECT_EQ(session.moment()->ticked->tick, 95);
  test::expect_replays(*host, registry_with_trap());
  const auto log = read_log(host->log_text(), registry_with_trap());
  ASSERT_TRUE(log.ok()) << log.error().text();
  EXPECT_EQ(log->entries.size(), 4u);
  for (const LogEntry& entry : log->entries) EXPECT_FALSE(entry.rewinds_to.has_value());
  // The next one works, and those that took place stay.
  session.rewind(60);
  session.settle();
  EXPECT_EQ(session.moment()->ticked->tick, 35);
  session.step(3);
  session.settle();
  test::expect_replays(*host, registry_with_trap());
  fail_to_rewind(session, 30, [] {});
  session.step(3);
  session.settle();
  EXPECT_EQ(session.moment()->ticked->tick, 41);
  test::expect_replays(*host, registry_with_trap());
}

TEST(LiveSession, WhatWasSaidMeanwhileBelongsToTheTickThatStaysWhereARewindFails) {
  const auto host = host_at_ninety();
  LiveSession& session = host->session();
  const std::size_t before = session.log().size();
  fail_to_rewind(session, 55, [&] {
    ASSERT_TRUE(session.submit(command<SetPort>({"a", {"control.value"}, {"5"}})).ok());
    EXPECT_EQ(session.log().back().tick, 35);
    session.rewind(20);  // on from there
    ASSERT_TRUE(session.submit(command<SetPort>({"b", {"control.value"}, {"6"}})).ok());
    EXPECT_EQ(session.log().back().tick, 15);
  });
  ASSERT_EQ(session.log().size(), before + 4) << "whoever follows the log loses no place in it";
  for (std::size_t i = before; i < session.log().size(); ++i) EXPECT_EQ(session.log()[i].tick, 90);
  session.step(10);
  session.settle();
  EXPECT_EQ(session.moment()->ticked->tick, 100);
  EXPECT_EQ(std::get<double>(value_in(*session.moment()->state, "a", "control.value")), 5);
  EXPECT_EQ(std::get<double>(value_in(*session.moment()->state, "b", "control.value")), 6);
  test::expect_replays(*host, registry_with_trap());
  ASSERT_TRUE(session.undo().ok());
  session.step(5);
  session.settle();
  test::expect_replays(*host, registry_with_trap());
}

// A log that is written while a rewind is computed waits for it: until then nobody knows whether it takes place.
TEST(LiveSession, ALogWaitsForTheRewindInIt) {
  const auto host = host_at_ninety();
  LiveSession& session = host->session();
  Trap::waits = true;
  const int begun = Trap::begun;
  session.rewind(55);
  while (Trap::begun == begun) std::this_thread::yield();
  std::thread opener([] {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    Trap::disarm();
  });
  const std::string text = host->log_text();
  opener.join();
  const auto log = read_log(text, registry_with_trap());
  ASSERT_TRUE(log.ok()) << log.error().text();
  EXPECT_EQ(log->last_tick, 35);
  test::expect_replays(*host, registry_with_trap());
}

}  // namespace
}  // namespace bl::host
