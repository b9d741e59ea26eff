// What a person has called a draft, a scenario or a phase can be erased like everything else that they have said.
#include <gtest/gtest.h>

#include "tests/core/room/room_world.h"

namespace bl::room {
namespace {

std::string all_of(RoomWorld& world) {
  std::string text;
  for (const EntryRecord& record : world.disk.entries) text += log_line(record.entry, full_registry());
  return text;
}

TEST(Titles, StandInNoEntryAndAreErased) {
  RoomWorld world;
  const auto lead = world.seat(Role::facilitator), anna = world.seat(Role::designer, {"north"});
  (void)world.event(lead, "set_phase", R"({"name": "Phase of Lena"})");
  EXPECT_EQ(sentence(world.say(anna, OperationKind::draft_begin, R"({"draft": "d", "title": "Draft of Anna"})")), "");
  (void)world.say(anna, OperationKind::draft_begin, R"({"draft": "own", "title": "Anna keeps it"})");
  (void)world.command(anna, set_demand("north", 300), "d");
  EXPECT_EQ(sentence(world.event(anna, "propose", R"({"draft": "d", "title": "Proposal of Anna"})")), "");
  EXPECT_EQ(sentence(world.event(anna, "save_scenario", R"({"id": "s", "name": "Scenario of Anna"})")), "");
  EXPECT_EQ(sentence(world.event(lead, "decide_proposal", R"({"draft": "d", "is_accepted": true})")), "");
  Room& room = world.room();
  EXPECT_EQ(room.words(room.state().phase.name), "Phase of Lena");
  EXPECT_EQ(room.words(room.state().proposals.at("d").title), "Proposal of Anna");
  EXPECT_EQ(room.words(room.state().scenarios.at("s").name), "Scenario of Anna");
  for (const char* name : {"Lena", "Anna"}) EXPECT_EQ(all_of(world).find(name), std::string::npos) << name;
  EXPECT_EQ(sentence(world.event(lead, "forget", R"({"seat": 2})")), "");
  EXPECT_EQ(room.words(room.state().proposals.at("d").title), "[erased]");
  EXPECT_EQ(room.words(room.state().scenarios.at("s").name), "[erased]");
  EXPECT_EQ(room.words(room.state().phase.name), "Phase of Lena");
  EXPECT_EQ(room.drafts().at("d").title(), "[erased]");
  EXPECT_EQ(room.drafts().at("own").title(), "[erased]");
  const std::uint64_t hash = hash_of(room.state());
  world.crash();
  EXPECT_EQ(hash_of(world.room().state()), hash);
  EXPECT_EQ(world.demand("north"), 300);
}

TEST(Titles, SaidAgainAreTheSame) {
  RoomWorld world;
  const auto lead = world.seat(Role::facilitator);
  (void)world.event(lead, "set_phase", R"({"name": "Look"})");
  const Phase first = world.room().state().phase;
  (void)world.event(lead, "set_phase", R"({"name": "Vote"})");
  EXPECT_FALSE(world.room().state().phase == first);
  (void)world.event(lead, "set_phase", R"({"name": "Look"})");
  EXPECT_TRUE(world.room().state().phase == first);
  EXPECT_EQ(why(world.event(lead, "set_phase", R"({"name": ")" + std::string(201, 'x') + "\"}")), "size");
  (void)world.event(lead, "set_phase", "{}");
  EXPECT_EQ(world.room().state().phase.name, "") << "no name is no text";
}

TEST(Titles, OfOlderLogsStandInThem) {
  RoomWorld world;
  const auto lead = world.seat(Role::facilitator);
  LogEntry entry{.seq = world.ledger().last_seq() + 1, .tick = 0, .gesture = 0};
  entry.author = RoomState::author_of_seat(lead);
  entry.event = R"({"event": "set_phase", "arguments": {"name": "As it was"}})";
  ASSERT_TRUE(world.room().replay({entry, 0}).ok());
  EXPECT_EQ(world.room().words(world.room().state().phase.name), "As it was");
}

}  // namespace
}  // namespace bl::room
