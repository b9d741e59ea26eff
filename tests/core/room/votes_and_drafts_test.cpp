// Votes and drafts in a room: secret and open ballots, proposals accepted in whole and in part.
#include <algorithm>
#include <set>

#include "tests/core/room/room_world.h"

namespace bl::room {
namespace {

Command vote_of(std::int64_t seat, const char* ballot, const char* poll = "poll") {
  return command<CastVote>({poll, RoomState::author_of_seat(seat), {ballot}});
}

const Table& ballots(const RoomWorld& world, const char* poll) {
  return *std::get<Shared<Table>>(world.scene().nodes.at(poll).types.at("vote").at("ballots"));
}

TEST(RoomVotes, OneSeatHasOneBallotWhileTheVoteIsOpen) {
  RoomWorld world;
  const auto lead = world.seat(Role::facilitator), anna = world.seat(Role::participant), ben = world.seat(Role::participant);
  EXPECT_EQ(sentence(world.command(anna, vote_of(anna, "\"yes\""))), "closed node: this vote is not open");
  EXPECT_EQ(sentence(world.event(lead, "open_vote", R"({"vote": "poll"})")), "");
  EXPECT_EQ(why(world.event(lead, "open_vote", R"({"vote": "poll"})")), "conflict");
  EXPECT_EQ(sentence(world.command(anna, vote_of(anna, "\"yes\""))), "");
  EXPECT_EQ(sentence(world.command(anna, vote_of(anna, "\"no\""))), "");
  EXPECT_EQ(why(world.command(ben, vote_of(anna, "\"yes\""))), "right") << "a ballot is one's own";
  EXPECT_EQ(why(world.command(lead, vote_of(anna, "\"yes\""))), "right") << "also for who leads";
  EXPECT_EQ(ballots(world, "poll").rows.size(), 1u);
  const Command stuff = command<AddRow>({"poll", {"vote.ballots"}, {R"({"voter": "x", "answer": "yes"})"}});
  EXPECT_EQ(why(world.command(lead, stuff)), "right") << "nobody fills the table by hand";
  EXPECT_EQ(sentence(world.event(lead, "close_vote", R"({"vote": "poll"})")), "");
  EXPECT_EQ(why(world.command(ben, vote_of(ben, "\"yes\""))), "closed");
}

// No function of file and log tells who has voted what once the vote is closed: authors, order, times and operations do not.
TEST(RoomVotes, ASecretBallotCannotBeTraced) {
  RoomWorld world;
  const auto lead = world.seat(Role::facilitator);
  std::vector<std::int64_t> seats;
  for (int k = 0; k < 10; ++k) seats.push_back(world.seat(Role::participant));
  ASSERT_EQ(sentence(world.event(lead, "open_vote", R"({"vote": "secret_poll"})")), "");
  for (std::size_t k = 0; k < seats.size(); ++k) {
    ++world.at;
    ASSERT_EQ(sentence(world.command(seats[k], vote_of(seats[k], k < 4 ? "\"yes\"" : "\"no\"", "secret_poll"))), "");
  }
  ASSERT_EQ(sentence(world.command(seats[9], vote_of(seats[9], "\"yes\"", "secret_poll"))), "") << "a mind can change";
  world.crash();
  ASSERT_EQ(sentence(world.command(seats[0], vote_of(seats[0], "\"no\"", "secret_poll"))), "") << "also after a crash";
  ASSERT_EQ(sentence(world.event(lead, "close_vote", R"({"vote": "secret_poll"})")), "");
  EXPECT_TRUE(world.disk.ballot_keys.empty()) << "the key is destroyed";
  EXPECT_TRUE(world.disk.secret_ballots.empty());
  const Table& table = ballots(world, "secret_poll");
  EXPECT_EQ(table.rows.size(), 10u) << "one person, one ballot";
  std::set<std::string> voters;
  for (std::size_t row = 0; row < table.rows.size(); ++row) voters.insert(table.text(row, "voter"));
  for (const std::int64_t seat : seats)
    for (const std::string& voter : voters) EXPECT_EQ(voter.find("seat"), std::string::npos) << seat;
  for (const EntryRecord& record : world.disk.entries) {
    if (record.entry.command.id != "cast_vote") continue;
    EXPECT_EQ(record.entry.author.id, "ballots");
    EXPECT_EQ(record.at, 0);
    EXPECT_TRUE(record.entry.source.origin.empty());
  }
  std::vector<std::string> order;
  for (std::size_t row = 0; row < table.rows.size(); ++row) order.push_back(table.text(row, "voter"));
  EXPECT_TRUE(std::is_sorted(order.begin(), order.end())) << "the order of the rows is that of meaningless names";
}

// The question is changed while ballots wait to be written: nothing is dropped in silence.
TEST(RoomVotes, SecretBallotsThatFitNoMoreAreTold) {
  RoomWorld world;
  const auto lead = world.seat(Role::facilitator), anna = world.seat(Role::participant);
  (void)world.event(lead, "open_vote", R"({"vote": "secret_poll"})");
  ASSERT_EQ(sentence(world.command(anna, vote_of(anna, "\"yes\"", "secret_poll"))), "");
  ASSERT_EQ(sentence(world.command(lead, command<SetPort>({"secret_poll", {"vote.kind"}, {"\"slider\""}}))), "");
  ASSERT_EQ(sentence(world.event(lead, "close_vote", R"({"vote": "secret_poll"})")), "");
  ASSERT_EQ(world.room().state().marks.size(), 1u);
  EXPECT_EQ(world.room().text(world.room().state().marks[0].text)->body,
            "Secret ballots of `secret_poll` that are not counted, because the question was changed after they were given: 1");
}

TEST(RoomVotes, BallotsOutliveCrashesAndCannotBeRewound) {
  RoomWorld world;
  const auto lead = world.seat(Role::facilitator), anna = world.seat(Role::participant);
  (void)world.event(lead, "open_vote", R"({"vote": "poll"})");
  const auto before = std::to_string(world.ledger().last_seq());
  (void)world.command(lead, set_demand("north", 5));
  (void)world.command(anna, vote_of(anna, "\"yes\""));
  world.crash();
  EXPECT_EQ(sentence(world.say(lead, OperationKind::rewind, R"({"to": )" + before + "}")), "");
  EXPECT_EQ(world.demand("north"), 900);
  EXPECT_EQ(ballots(world, "poll").rows.size(), 1u);
}

TEST(RoomDrafts, ADraftIsPrivateUntilItIsAccepted) {
  RoomWorld world;
  const auto lead = world.seat(Role::facilitator), anna = world.seat(Role::stakeholder), ben = world.seat(Role::stakeholder);
  EXPECT_EQ(sentence(world.say(anna, OperationKind::draft_begin, R"({"draft": "d", "title": "Lower"})")), "");
  EXPECT_EQ(why(world.say(ben, OperationKind::draft_begin, R"({"draft": "d"})")), "conflict");
  EXPECT_EQ(sentence(world.command(anna, set_demand("north", 300), "d")), "");
  EXPECT_EQ(sentence(world.command(anna, command<RenameNode>({"south", "Garden"}), "d")),
            "right nodes/south/name: is not yours to change, not even in a draft");
  EXPECT_EQ(sentence(world.command(anna, command<AddNode>({"kiosk", {R"({"types": {"smart_volume": {}}})"}}), "d")), "");
  EXPECT_EQ(sentence(world.command(anna, command<RemoveLink>({"inner"}), "d")), "");
  EXPECT_EQ(why(world.command(ben, set_demand("north", 1), "d")), "gone") << "somebody else's draft";
  EXPECT_EQ(world.demand("north"), 900);
  EXPECT_EQ(std::get<double>(world.room().scene_of("d").nodes.at("north").types.at("smart_volume").at("demand")), 300);
  // Somebody changes the same place, and takes away what another step needs.
  (void)world.command(lead, set_demand("north", 500));
  (void)world.command(lead, command<RemoveLink>({"inner"}));
  EXPECT_EQ(sentence(world.event(anna, "propose", R"({"draft": "d", "title": "Lower", "why": "More light"})")), "");
  const DraftSummary summary = world.room().summary_of("d");
  std::set<std::string> met;
  for (const DraftConflict& conflict : summary.conflicts) met.insert(text_of(conflict.place) + " by " + conflict.author);
  EXPECT_EQ(met, (std::set<std::string>{"nodes/north/types/smart_volume/demand by seat 1"}));
  ASSERT_EQ(summary.misfits.size(), 1u);
  EXPECT_EQ(summary.misfits[0].step, 2);
  world.crash();
  EXPECT_EQ(why(world.event(anna, "decide_proposal", R"({"draft": "d", "is_accepted": true})")), "right");
  const Answer whole = world.event(lead, "decide_proposal", R"({"draft": "d", "is_accepted": true})");
  EXPECT_EQ(why(whole), "conflict");
  EXPECT_NE(std::get<Refusal>(whole).args.text().find("\"step\": 2"), std::string::npos);
  EXPECT_EQ(world.demand("north"), 500) << "nothing of it";
  EXPECT_EQ(
      sentence(world.event(lead, "decide_proposal", R"({"draft": "d", "is_accepted": true, "keep": [0, 1], "answer": "Yes"})")),
      "");
  EXPECT_EQ(world.demand("north"), 300);
  EXPECT_TRUE(world.scene().nodes.contains("kiosk"));
  const EntryRecord& accepted = world.disk.entries[world.disk.entries.size() - 2];
  EXPECT_EQ(accepted.entry.author.id, "seat 2");
  EXPECT_EQ(accepted.by, lead);
  EXPECT_EQ(accepted.draft, "d");
  EXPECT_EQ(world.room().state().proposals.at("d").kept, 2);
  EXPECT_EQ(sentence(world.say(lead, OperationKind::undo, R"({"of": 2})")), "") << "one undo takes all of it back";
  EXPECT_EQ(world.demand("north"), 500);
  EXPECT_FALSE(world.scene().nodes.contains("kiosk"));
}

TEST(RoomDrafts, ARejectedDraftComesBackWithAReason) {
  RoomWorld world;
  const auto lead = world.seat(Role::facilitator), anna = world.seat(Role::stakeholder);
  (void)world.say(anna, OperationKind::draft_begin, R"({"draft": "d"})");
  EXPECT_EQ(why(world.event(anna, "propose", R"({"draft": "d"})")), "conflict") << "it has no steps";
  (void)world.command(anna, set_demand("north", 300), "d");
  (void)world.command(anna, set_demand("south", 300), "d");
  EXPECT_EQ(sentence(world.say(anna, OperationKind::draft_undo, R"({"draft": "d"})")), "");
  EXPECT_EQ(sentence(world.event(anna, "propose", R"({"draft": "d"})")), "");
  EXPECT_EQ(why(world.command(anna, set_demand("north", 200), "d")), "gone") << "it is out of hand";
  EXPECT_EQ(sentence(world.event(lead, "decide_proposal", R"({"draft": "d", "answer": "Too low"})")), "");
  EXPECT_EQ(world.room().text(world.room().state().proposals.at("d").answer)->body, "Too low");
  EXPECT_EQ(sentence(world.command(anna, set_demand("north", 400), "d")), "") << "and can be worked on";
  EXPECT_EQ(sentence(world.event(anna, "propose", R"({"draft": "d"})")), "");
  world.crash();
  EXPECT_EQ(sentence(world.event(lead, "decide_proposal", R"({"draft": "d", "is_accepted": true})")), "");
  EXPECT_EQ(world.demand("north"), 400);
  EXPECT_EQ(world.demand("south"), 700);
}

}  // namespace
}  // namespace bl::room
