// The count: results by hand, ties, refusals, and that the order of rows does not matter.
#include <algorithm>
#include <numeric>

#include <gtest/gtest.h>

#include "core/base/random.h"
#include "core/vote/count.h"

namespace bl::vote {
namespace {

Question asked(Kind kind) {
  const Table options{{"id", "label"}, {{"a", "A"}, {"b", "B"}, {"c", "C"}}};
  return question_of({.kind = kind, .points = 10, .is_whole_ranking = false, .least = 0, .most = 10}, options).value();
}

Table ballots_of(const std::vector<Ballot>& ballots) {
  Table table;
  for (const ColumnDefinition& column : ballot_columns()) table.columns.push_back(column.id);
  for (std::size_t i = 0; i < ballots.size(); ++i) table.rows.push_back(row_of("voter" + std::to_string(i), ballots[i]));
  return table;
}

std::vector<double> points_of(const Outcome& outcome) {
  std::vector<double> points;
  for (const Tally& tally : outcome.tallies) points.push_back(tally.points);
  return points;
}

TEST(Count, YesAndNo) {
  const Outcome outcome =
      count(asked(Kind::yes_no), ballots_of({{.options = {"yes"}}, {.options = {"no"}}, {.options = {"yes"}}}));
  EXPECT_EQ(outcome.counted, 3);
  EXPECT_EQ(points_of(outcome), (std::vector<double>{2, 1}));
  EXPECT_EQ(outcome.leading, "yes");
  EXPECT_DOUBLE_EQ(outcome.tallies[0].share, 2.0 / 3);
}

TEST(Count, RankingsByBorda) {
  const Outcome outcome =
      count(asked(Kind::rank), ballots_of({{.options = {"a", "b", "c"}}, {.options = {"b", "c", "a"}}, {.options = {"b"}}}));
  EXPECT_EQ(points_of(outcome), (std::vector<double>{2, 5, 1}));
  EXPECT_EQ(outcome.leading, "b");
}

TEST(Count, CoinsAndATie) {
  const Outcome outcome = count(
      asked(Kind::coins),
      ballots_of({{.options = {"a", "c"}, .coins = {4, 2}}, {.options = {"c"}, .coins = {2}}, {.options = {"b"}, .coins = {1}}}));
  EXPECT_EQ(points_of(outcome), (std::vector<double>{4, 1, 4}));
  EXPECT_EQ(outcome.leading, "");
}

TEST(Count, SlidersHaveAMeanAndAMiddle) {
  const Outcome odd = count(asked(Kind::slider), ballots_of({{.value = 9}, {.value = 1}, {.value = 2}}));
  EXPECT_EQ(odd.mean, 4);
  EXPECT_EQ(odd.median, 2);
  ASSERT_EQ(odd.tallies.size(), 1u);
  EXPECT_EQ(odd.tallies[0].option, kMean);
  EXPECT_DOUBLE_EQ(odd.tallies[0].share, 0.4);
  const Outcome even = count(asked(Kind::slider), ballots_of({{.value = 9}, {.value = 1}, {.value = 2}, {.value = 4}}));
  EXPECT_EQ(even.median, 3);
  EXPECT_TRUE(count(asked(Kind::slider), ballots_of({})).tallies.empty());
}

TEST(Count, NobodyLeadsWithoutBallots) {
  const Outcome outcome = count(asked(Kind::rank), ballots_of({}));
  EXPECT_EQ(points_of(outcome), (std::vector<double>{0, 0, 0}));
  EXPECT_EQ(outcome.leading, "");
}

TEST(Count, EveryBallotIsCountedOrRefusedWithItsReason) {
  Table table =
      ballots_of({{.options = {"a"}, .coins = {4}}, {.options = {"gone"}, .coins = {4}}, {.options = {"b"}, .coins = {99}}});
  table.rows.push_back(row_of("voter0", {.options = {"c"}, .coins = {1}}));
  table.rows.push_back(row_of("", {.options = {"c"}, .coins = {1}}));
  table.rows.push_back({std::string("dotty"), std::string("a"), Numbers(), Numbers(std::vector<double>{1, 2}), 0.0});
  const Outcome outcome = count(asked(Kind::coins), table);
  EXPECT_EQ(outcome.counted, 1);
  EXPECT_EQ(points_of(outcome), (std::vector<double>{4, 0, 0}));
  ASSERT_EQ(outcome.refusals.size(), 5u);
  EXPECT_EQ(outcome.refusals[0].reason, "there is no option `gone`");
  EXPECT_EQ(outcome.refusals[1].reason, "the ballot gives 99 coins, and a voter has 10: take away 89");
  EXPECT_EQ(outcome.refusals[2].reason, "the voter has an earlier ballot, and that one counts");
  EXPECT_EQ(outcome.refusals[3].reason, "the ballot has no voter");
  EXPECT_EQ(outcome.refusals[4].reason, "the places of its dots are not x, y and z each");
}

// Law: shares add up to one, points to what was given, and the order in which people voted changes nothing.
TEST(Count, SharesAddUpInAnyOrder) {
  Random random(8);
  for (int round = 0; round < 200; ++round) {
    std::vector<Ballot> ballots(1 + random.below(30));
    double given = 0;
    for (Ballot& ballot : ballots)
      for (const char* option : {"a", "b", "c"}) {
        const double coins = static_cast<double>(random.below(4));
        if (coins == 0 && !(ballot.options.empty() && *option == 'c')) continue;
        ballot.options.push_back(option);
        ballot.coins.push_back(std::max(coins, 1.0));
        given += ballot.coins.back();
      }
    Table table = ballots_of(ballots);
    const Outcome outcome = count(asked(Kind::coins), table);
    ASSERT_EQ(outcome.counted + static_cast<std::int64_t>(outcome.refusals.size()), static_cast<std::int64_t>(ballots.size()));
    double points = 0, shares = 0;
    for (const Tally& tally : outcome.tallies) {
      points += tally.points;
      shares += tally.share;
    }
    EXPECT_EQ(points, given);
    EXPECT_NEAR(shares, 1, 1e-12);
    std::reverse(table.rows.begin(), table.rows.end());
    const Outcome turned = count(asked(Kind::coins), table);
    EXPECT_EQ(points_of(turned), points_of(outcome));
    EXPECT_EQ(turned.leading, outcome.leading);
  }
}

}  // namespace
}  // namespace bl::vote
