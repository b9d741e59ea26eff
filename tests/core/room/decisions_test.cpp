// Decisions: which ones there are, that only the last ones are kept, and that a room which goes on knows the same.
#include <gtest/gtest.h>

#include "tests/core/room/room_world.h"

namespace bl::room {
namespace {

std::string kinds(const Room& room) {
  std::string all;
  for (const Decision& decision : room.decisions()) all += (all.empty() ? "" : " ") + decision.kind;
  return all;
}

TEST(Decisions, AreWhatWasDecidedBeforeAllAndNothingElse) {
  RoomWorld world;
  const auto lead = world.seat(Role::facilitator), anna = world.seat(Role::designer, {"north"});
  const std::int64_t begun = world.ledger().last_seq();
  (void)world.event(lead, "set_phase", R"({"name": "Explore"})");
  (void)world.say(anna, OperationKind::draft_begin, R"({"draft": "d", "title": "A draft"})");
  (void)world.command(anna, set_demand("north", 300), "d");
  (void)world.event(anna, "propose", R"({"draft": "d", "title": "Less in the north"})");
  (void)world.event(anna, "comment", R"({"id": "c", "text": "Too high."})");
  (void)world.event(lead, "open_vote", R"({"vote": "poll"})");
  (void)world.event(lead, "mark", R"({"kind": "question", "text": "Why?"})");
  EXPECT_EQ(kinds(world.room()), "phase") << "what is asked is not decided";
  EXPECT_EQ(sentence(world.event(lead, "decide_proposal", R"({"draft": "d", "is_accepted": true, "answer": "It fits."})")), "");
  EXPECT_EQ(sentence(world.event(lead, "close_vote", R"({"vote": "poll"})")), "");
  EXPECT_EQ(sentence(world.event(lead, "mark", R"({"text": "We keep the mill."})")), "");
  EXPECT_EQ(sentence(world.say(lead, OperationKind::rewind, R"({"to": )" + std::to_string(begun) + "}")), "");
  EXPECT_EQ(kinds(world.room()), "rewind mark vote proposal phase");
  const std::deque<Decision> known = world.room().decisions();
  EXPECT_EQ(known[3].what, "d");
  EXPECT_EQ(known[3].seat, lead);
  world.crash();
  EXPECT_TRUE(world.room().decisions() == known) << "another program that goes on knows the same";
  (void)world.event(lead, "set_phase", R"({"name": "Vote"})");
  EXPECT_EQ(kinds(world.room()), "phase rewind mark vote proposal") << "five are kept";
}

TEST(Decisions, ARejectedProposalIsNone) {
  RoomWorld world;
  const auto lead = world.seat(Role::facilitator), anna = world.seat(Role::designer, {"north"});
  (void)world.say(anna, OperationKind::draft_begin, R"({"draft": "d", "title": "A draft"})");
  (void)world.command(anna, set_demand("north", 300), "d");
  (void)world.event(anna, "propose", R"({"draft": "d", "title": "Less"})");
  EXPECT_EQ(sentence(world.event(lead, "decide_proposal", R"({"draft": "d", "is_accepted": false})")), "");
  EXPECT_EQ(kinds(world.room()), "");
}

}  // namespace
}  // namespace bl::room
