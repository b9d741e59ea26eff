// Vote to number: shares by hand, when a result counts, and what the link says while it waits.
#include <nlohmann/json.hpp>

#include "tests/links/link_case.h"

namespace bl {
namespace {

Table results_of(const std::vector<std::pair<std::string, double>>& shares) {
  Table table{{"option", "label", "points", "share"}, {}};
  for (const auto& [option, share] : shares) table.rows.push_back({option, option, 10 * share, share});
  return table;
}

Table mapping_of(const std::vector<std::tuple<std::string, double, double>>& rows) {
  Table table{{"option", "least", "most"}, {}};
  for (const auto& [option, least, most] : rows) table.rows.push_back({option, least, most});
  return table;
}

// A closed vote of ten, in which eight have voted.
LinkCase voted(const Table& mapping) {
  LinkCase link("vote_to_weight");
  link.set("mapping", Shared<Table>(mapping));
  link.from("node.id", std::string("poll")).from("vote.results", Shared<Table>(results_of({{"a", 0.5}, {"b", 0.3}, {"c", 0.2}})));
  link.from("vote.ballot_count", std::int64_t{8}).from("vote.turnout", 0.8).from("vote.electorate", std::int64_t{10});
  Table decided{{"option", "share"}, {{std::string("a"), 0.5}, {std::string("b"), 0.3}, {std::string("c"), 0.2}}};
  link.from("vote.decided", Shared<Table>(decided))
      .from("vote.decided_ballots", std::int64_t{8})
      .from("vote.decided_turnout", 0.8);
  link.from("vote.is_open", false).from("vote.is_shown", true);
  return link;
}

std::string waiting(LinkCase& link) {
  EXPECT_EQ(link.run(), "");
  EXPECT_FALSE(link.proposed(End::to, "target").has_value());
  return link.remarked(LinkRemark::short_of);
}

TEST(VoteToWeight, AShareLiesBetweenTwoNumbersAndRowsAreAdded) {
  auto one = voted(mapping_of({{"a", 1000, 3000}}));
  ASSERT_EQ(one.run(), "");
  EXPECT_NEAR(one.number(End::to, "target"), 2000, 1e-9);
  EXPECT_EQ(one.remarked(LinkRemark::short_of), "");
  auto falling = voted(mapping_of({{"b", 10, 0}}));
  ASSERT_EQ(falling.run(), "");
  EXPECT_NEAR(falling.number(End::to, "target"), 7, 1e-9);
  // With nothing at share 0, the mean of what each option is worth, weighed by its share.
  auto mean = voted(mapping_of({{"a", 0, 100}, {"b", 0, 200}, {"c", 0, 300}}));
  ASSERT_EQ(mean.run(), "");
  EXPECT_NEAR(mean.number(End::to, "target"), 0.5 * 100 + 0.3 * 200 + 0.2 * 300, 1e-9);
}

TEST(VoteToWeight, WaitsUntilTheResultCounts) {
  const Table mapping = mapping_of({{"a", 1000, 3000}});
  auto open = voted(mapping);
  open.from("vote.is_open", true);
  ASSERT_EQ(open.run(), "");
  EXPECT_NEAR(open.number(End::to, "target"), 2000, 1e-9) << "the result of the last close stays in force";
  open.from("vote.decided_ballots", std::int64_t{0});
  EXPECT_EQ(waiting(open), "when: the vote `poll` is still open, so that it does not act yet");
  open.set("when", std::string("shown"));
  ASSERT_EQ(open.run(), "");
  EXPECT_NEAR(open.number(End::to, "target"), 2000, 1e-9);
  open.from("vote.is_shown", false);
  EXPECT_EQ(waiting(open), "when: the vote `poll` does not show its result before it is closed, so that it does not act yet");
  auto empty = voted(mapping);
  empty.from("vote.decided_ballots", std::int64_t{0});
  EXPECT_EQ(waiting(empty), "from: the vote `poll` has no ballot, so that it does not act yet");
}

TEST(VoteToWeight, NeedsItsTurnout) {
  auto link = voted(mapping_of({{"a", 1000, 3000}}));
  link.set("minimum_turnout", 0.8);
  ASSERT_EQ(link.run(), "");
  EXPECT_TRUE(link.proposed(End::to, "target").has_value()) << "reached exactly";
  link.set("minimum_turnout", 0.9);
  EXPECT_EQ(waiting(link), "minimum_turnout: the vote `poll` has a turnout of 80 % and needs 90 %, so that it does not act yet");
  link.from("vote.electorate", std::int64_t{0}).from("vote.decided_turnout", 0.0);
  EXPECT_NE(waiting(link).find("does not know how many may vote"), std::string::npos);
}

TEST(VoteToWeight, NamesOptionsThatAreNotThere) {
  auto link = voted(mapping_of({{"a", 0, 1}, {"park", 0, 1}}));
  EXPECT_EQ(link.run(), "mapping/1/option: the vote `poll` has no option `park`");
  link.from("vote.decided_ballots", std::int64_t{0});
  EXPECT_EQ(link.run(), "mapping/1/option: the vote `poll` has no option `park`") << "also before anybody has voted";
  EXPECT_EQ(voted(mapping_of({})).run(), "mapping: no option is worth anything: add a row for at least one");
}

TEST(VoteToWeight, SceneGivesWhatWasVoted) {
  World world = World::from_file("scenes/links/vote_to_weight.json");
  ASSERT_TRUE(world.settle());
  EXPECT_NEAR(world.number("market", "smart_volume.demand"), 1000 + 10000 * 12.0 / 30, 1e-9);
  EXPECT_NEAR(world.number("library", "smart_volume.demand"), 1000 + 10000 * 9.0 / 30, 1e-9);
  EXPECT_EQ(world.number("garage", "smart_volume.demand"), 2000);
  EXPECT_NE(world.link_error("l3_garage").find("has a turnout of 25 % and needs 50 %"), std::string::npos);
  // The second ballot reaches the turnout once the vote is closed again.
  const auto open = [&](bool is_open) {
    return world.submit(command<SetPort>({"garage_vote", {"vote.is_open"}, JsonValue::of(Json(is_open))}));
  };
  ASSERT_EQ(open(true), "");
  ASSERT_EQ(world.submit(command<CastVote>({"garage_vote", "otter", {"\"no\""}})), "");
  ASSERT_EQ(open(false), "");
  world.tick(3);
  EXPECT_NEAR(world.number("garage", "smart_volume.demand"), (2000.0 + 4000) / 2, 1e-9) << "blended with what people set";
  EXPECT_EQ(world.link_error("l3_garage"), "");
}

// Whatever people vote, the block holds as much as before; only who gets it changes.
TEST(VoteToWeight, StudySharesOutTheWholeBlock) {
  World world = World::from_file("scenes/studies/vote_on_demands.json");
  world.tick(3);
  const auto demands = [&](const std::string& use, int count) {
    double sum = 0;
    for (int i = 1; i <= count; ++i) sum += world.number(use + "-" + std::to_string(i), "smart_volume.demand");
    return sum;
  };
  const auto all = [&] { return demands("homes", 6) + demands("work", 4) + demands("culture", 2); };
  EXPECT_NEAR(all(), 84000, 1e-6);
  EXPECT_NEAR(world.number("homes-1", "smart_volume.storey_height"), world.number("storeys", "vote.mean"), 1e-9);
  const double culture = demands("culture", 2);
  const auto open = [&](bool is_open) {
    return world.submit(command<SetPort>({"people", {"vote.is_open"}, JsonValue::of(Json(is_open))}));
  };
  ASSERT_EQ(open(true), "");
  ASSERT_EQ(world.submit(command<CastVote>({"people", "newcomer", {R"({"culture": 10})"}}), "newcomer"), "");
  world.tick(3);
  EXPECT_NEAR(all(), 84000, 1e-6) << "what was decided stays in force while the vote is open again";
  EXPECT_NEAR(demands("culture", 2), culture, 1e-6);
  ASSERT_EQ(open(false), "");
  world.tick(3);
  EXPECT_NEAR(all(), 84000, 1e-6);
  EXPECT_GT(demands("culture", 2), culture + 1000);
}

}  // namespace
}  // namespace bl
