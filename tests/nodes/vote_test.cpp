// The vote: its count by hand, when it is shown, and what it says of a question that cannot be asked.
#include <gtest/gtest.h>

#include "tests/nodes/scene_text.h"
#include "tests/support/world.h"

namespace bl {
namespace {

World vote_world(const std::string& ports) {
  World world = World::from_text(one_node("vote", ports));
  world.tick();
  return world;
}

constexpr const char* kThreeVoted =
    R"("ballots": [{"voter": "a", "answer": "yes"}, {"voter": "b", "answer": "no"}, {"voter": "c", "answer": "yes"}])";

TEST(Vote, CountsAndKnowsItsTurnout) {
  const World world = vote_world(R"("electorate": 12, )" + std::string(kThreeVoted));
  EXPECT_EQ(world.number("it", "vote.ballot_count"), 3);
  EXPECT_EQ(world.number("it", "vote.turnout"), 0.25);
  EXPECT_EQ(world.text("it", "vote.leading"), "yes");
  const Table results = world.table("it", "vote.results");
  ASSERT_EQ(results.rows.size(), 2u);
  EXPECT_EQ(results.text(0, "label"), "Yes");
  EXPECT_EQ(results.number(0, "points"), 2);
  EXPECT_EQ(results.number(1, "points"), 1);
  EXPECT_EQ(vote_world(kThreeVoted).number("it", "vote.turnout"), 0) << "where nobody knows how many may vote";
}

TEST(Vote, IsShownAtOnceOrWhenClosed) {
  EXPECT_EQ(vote_world(R"("is_open": true)").number("it", "vote.is_shown"), 0);
  EXPECT_EQ(vote_world(R"("is_open": true, "shows": "at_once")").number("it", "vote.is_shown"), 1);
  EXPECT_EQ(vote_world("").number("it", "vote.is_shown"), 1);
}

// Options come and go: a ballot that names one of them counts while it is there.
TEST(Vote, BallotsThatDoNotFitAreTold) {
  const World world = vote_world(R"("kind": "rank", "options": [{"id": "a"}, {"id": "b"}], "ballots": [
      {"voter": "anna", "answer": "a b"}, {"voter": "ben", "answer": "b market"}])");
  EXPECT_EQ(world.number("it", "vote.ballot_count"), 1);
  EXPECT_EQ(world.number("it", "vote.unreadable"), 1);
  EXPECT_EQ(world.table("it", "vote.refusals").text(0, "voter"), "ben");
  EXPECT_EQ(world.table("it", "vote.refusals").text(0, "reason"), "there is no option `market`");
}

TEST(Vote, SaysWhatItLacks) {
  EXPECT_EQ(vote_world(R"("kind": "coins")").node_error("it", "vote"),
            "nodes/it/vote/options: there are 0 options: people need at least 2 to choose from");
  EXPECT_EQ(vote_world(R"("kind": "slider", "least": 9, "most": 3)").node_error("it", "vote"),
            "nodes/it/vote/most: the largest answer (3) has to lie above the smallest (9)");
  EXPECT_NE(vote_world(R"("kind": "slider", "unit": "ell")").node_error("it", "vote"), "");
}

TEST(Vote, SceneIsWhatItSays) {
  World world = World::from_file("scenes/nodes/vote.json");
  EXPECT_TRUE(world.settle(20));
  EXPECT_EQ(world.text("court", "vote.leading"), "garden");
  EXPECT_EQ(world.number("court", "vote.turnout"), 0.75);
  EXPECT_EQ(world.text("money", "vote.leading"), "") << "three coins each";
  EXPECT_EQ(world.number("money", "vote.unreadable"), 1);
  EXPECT_EQ(world.number("height", "vote.mean"), 18);
  EXPECT_EQ(world.number("height", "vote.is_shown"), 0);
}

}  // namespace
}  // namespace bl
