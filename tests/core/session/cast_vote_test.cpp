// Casting a vote: ballots come, change and go while the vote is open, and two voters never meet.
#include <string>

#include <gtest/gtest.h>

#include "core/graph/touch.h"
#include "tests/support/world.h"

namespace bl {
namespace {

std::string poll(const std::string& settings) {
  return R"({"format": "behaviourlinks", "version": 1, "nodes": [{"id": "poll", "types": {"vote": {)" + settings +
         R"(}}}, {"id": "house", "types": {"smart_volume": {}}}]})";
}
constexpr const char* kCoins = R"("kind": "coins", "points": 5, "is_open": true, "options": [{"id": "park"}, {"id": "school"}])";

std::string cast(World& world, const std::string& voter, const std::string& ballot) {
  return world.submit(command<CastVote>({"poll", voter, {ballot}}), voter);
}
const Table& ballots_in(World& world) {
  return *std::get<Shared<Table>>(world.session().scene().nodes.at("poll").types.at("vote").at("ballots"));
}

TEST(CastVote, ABallotCountsIsReplacedAndWithdrawn) {
  World world = World::from_text(poll(kCoins));
  ASSERT_EQ(cast(world, "otter", R"({"park": 2})"), "");
  ASSERT_EQ(cast(world, "heron", R"({"school": 5})"), "");
  world.tick();
  EXPECT_EQ(world.text("poll", "vote.leading"), "school");
  EXPECT_EQ(ballots_in(world).text(0, "voter"), "heron") << "rows do not tell who voted first";
  ASSERT_EQ(cast(world, "heron", R"({"park": 1, "school": 2})"), "");
  world.tick();
  EXPECT_EQ(world.number("poll", "vote.ballot_count"), 2);
  EXPECT_EQ(world.text("poll", "vote.leading"), "park");
  ASSERT_EQ(cast(world, "otter", "null"), "");
  world.tick();
  EXPECT_EQ(world.text("poll", "vote.leading"), "school");
  EXPECT_EQ(cast(world, "otter", "null"), "nodes/poll/vote/ballots/otter: `otter` has no ballot to withdraw");
}

TEST(CastVote, RefusesWithItsPlaceAndASentence) {
  World world = World::from_text(poll(kCoins));
  EXPECT_EQ(cast(world, "otter", R"({"parc": 1})"),
            "nodes/poll/vote/ballots/otter/parc: there is no option `parc`, did you mean `park`?");
  EXPECT_EQ(cast(world, "otter", R"({"park": 4, "school": 2})"),
            "nodes/poll/vote/ballots/otter: the ballot gives 6 coins, and a voter has 5: take away 1");
  EXPECT_EQ(cast(world, "otter", R"("yes")"), R"(nodes/poll/vote/ballots/otter: expects {"option": coins, ...})");
  EXPECT_EQ(world.submit(command<CastVote>({"poll", "", {"{}"}})),
            "nodes/poll/vote/ballots: the voter needs a name of 1 to 64 characters");
  EXPECT_EQ(world.submit(command<CastVote>({"house", "otter", {"{}"}})),
            "nodes/house: the node is not a `vote`; typify it first");
  World rank =
      World::from_text(poll(R"("kind": "rank", "is_open": true, "options": [{"id": "park"}, {"id": "school"}, {"id": "shop"}])"));
  EXPECT_EQ(cast(rank, "otter", R"(["school"])"),
            "nodes/poll/vote/ballots/otter: the ranking is not complete: `park`, `shop` is missing");
  World unready = World::from_text(poll(R"("kind": "rank", "is_open": true)"));
  EXPECT_EQ(cast(unready, "otter", R"(["school"])"),
            "nodes/poll/vote/options: there are 0 options: people need at least 2 to choose from");
}

TEST(CastVote, AClosedVoteTakesNoBallotAndGivesNoneBack) {
  World world = World::from_text(poll(kCoins));
  ASSERT_EQ(cast(world, "otter", R"({"park": 2})"), "");
  ASSERT_EQ(world.submit(command<SetPort>({"poll", {"vote.is_open"}, {"false"}}), "host"), "");
  const std::string closed = "the vote is closed: ballots are cast and changed while it is open";
  EXPECT_EQ(cast(world, "heron", R"({"park": 2})"), "nodes/poll/vote/is_open: " + closed);
  EXPECT_EQ(cast(world, "otter", "null"), "nodes/poll/vote/is_open: " + closed);
  const auto undone = world.session().undo("otter");
  ASSERT_FALSE(undone.ok());
  EXPECT_EQ(undone.error().message, "cannot be undone because the scene has changed since: " + closed);
  EXPECT_EQ(ballots_in(world).rows.size(), 1u);
}

// Each undo takes back the voter's own ballot only, in whatever order they voted.
TEST(CastVote, TwoVotersNeverMeet) {
  World world = World::from_text(poll(kCoins));
  ASSERT_EQ(cast(world, "otter", R"({"park": 2})"), "");
  ASSERT_EQ(cast(world, "heron", R"({"school": 1})"), "");
  ASSERT_EQ(cast(world, "otter", R"({"school": 3})"), "");
  ASSERT_EQ(cast(world, "heron", "null"), "");
  auto undone = world.session().undo("otter");
  ASSERT_TRUE(undone.ok() && undone->left.empty());
  EXPECT_EQ(ballots_in(world).text(0, "answer"), "park");
  undone = world.session().undo("heron");
  ASSERT_TRUE(undone.ok() && undone->left.empty());
  ASSERT_EQ(ballots_in(world).rows.size(), 2u);
  undone = world.session().undo("otter");
  ASSERT_TRUE(undone.ok() && undone->left.empty());
  ASSERT_EQ(ballots_in(world).rows.size(), 1u);
  EXPECT_EQ(ballots_in(world).text(0, "voter"), "heron");
}

TEST(CastVote, TouchesTheRowOfItsVoterOnly) {
  World world = World::from_text(poll(kCoins));
  ASSERT_EQ(cast(world, "otter", R"({"park": 2})"), "");
  Scene scene = world.session().scene();
  for (const char* ballot : {R"({"park": 3})", R"({"school": 1})", "null"}) {
    SceneEdit edit(scene, full_registry());
    ASSERT_TRUE(apply(edit, command<CastVote>({"poll", "otter", {ballot}})).ok());
    ASSERT_FALSE(edit.touches().empty());
    for (const Touch& place : edit.touches())
      EXPECT_EQ(text_of(place).rfind("nodes/poll/types/vote/ballots/otter", 0), 0u) << text_of(place);
  }
}

// A ballot that does not fit any more cannot be cast again: the undo brings back its row as it was.
TEST(CastVote, TheInverseBringsBackABallotThatDoesNotFit) {
  World world = World::from_text(poll(
      std::string(kCoins) +
      R"(, "ballots": [{"voter": "otter", "answer": "pool", "coins": [2]}, {"voter": "ant", "answer": "park", "coins": [1]}])"));
  const Scene before = world.session().scene();
  for (const auto& [voter, ballot] : {std::pair{"otter", R"({"park": 2})"}, {"otter", "null"}, {"bee", R"({"park": 1})"}}) {
    ASSERT_EQ(cast(world, voter, ballot), "");
    ASSERT_TRUE(world.session().undo(voter).ok());
    EXPECT_TRUE(world.session().scene() == before) << voter << " " << ballot;
  }
}

}  // namespace
}  // namespace bl
