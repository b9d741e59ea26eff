// Ballots: the forms of each kind, and the sentence of each refusal.
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/base/random.h"
#include "core/define/codec.h"
#include "core/vote/ballot_json.h"

namespace bl::vote {
namespace {

Table options_of(const std::vector<std::string>& ids) {
  Table table{{"id", "label"}, {}};
  for (const std::string& id : ids) table.rows.push_back({id, "The " + id});
  return table;
}

Question question(Kind kind, const std::vector<std::string>& ids = {"park", "school", "shop"}) {
  return question_of({.kind = kind, .points = 5, .least = 10, .most = 30}, options_of(ids)).value();
}

std::string refused(const Question& asked, const std::string& text) {
  const auto ballot = ballot_from_json(asked.kind, Json::parse(text));
  if (!ballot) return ballot.error().text();
  const auto fits = check_ballot(asked, *ballot);
  return fits ? "" : fits.error().text();
}

TEST(Ballot, YesOrNo) {
  const Question asked = question(Kind::yes_no);
  EXPECT_EQ(refused(asked, R"("yes")"), "");
  EXPECT_EQ(refused(asked, R"("no")"), "");
  EXPECT_EQ(refused(asked, R"("yess")"), "there is no option `yess`, did you mean `yes`?");
  EXPECT_EQ(refused(asked, "true"), "expects `yes` or `no` as a text");
  EXPECT_EQ(check_ballot(asked, {}).error().text(), "the ballot holds no answer: write `yes` or `no`");
}

TEST(Ballot, RankingsAreWholeWhereThatIsAsked) {
  Question asked = question(Kind::rank);
  EXPECT_EQ(refused(asked, R"(["shop", "park", "school"])"), "");
  EXPECT_EQ(refused(asked, R"(["shop"])"), "the ranking is not complete: `park`, `school` is missing");
  EXPECT_EQ(refused(asked, R"(["shop", "park", "shop"])"), "2: `shop` stands in this ballot twice: name it once");
  EXPECT_EQ(refused(asked, R"(["shop", "parc"])"), "1: there is no option `parc`, did you mean `park`?");
  EXPECT_EQ(refused(asked, R"(["shop", 3])"), "1: expects the id of an option as a text");
  asked.is_whole_ranking = false;
  EXPECT_EQ(refused(asked, R"(["shop"])"), "");
  EXPECT_EQ(refused(asked, "[]"), "the ranking is empty: name the best option first");
}

TEST(Ballot, CoinsAreWholeAndNoMoreThanThereAre) {
  const Question asked = question(Kind::coins);
  EXPECT_EQ(refused(asked, R"({"park": 3, "shop": 2})"), "");
  EXPECT_EQ(refused(asked, R"({"park": 3, "shop": 0})"), "");
  EXPECT_EQ(refused(asked, R"({"park": 3, "shop": 3})"), "the ballot gives 6 coins, and a voter has 5: take away 1");
  EXPECT_EQ(refused(asked, R"({"park": 1.5})"),
            "park: coins are whole and not split: write a whole number, 0 or more, found 1.5");
  EXPECT_EQ(refused(asked, R"({"park": -1})"), "park: coins are whole and not split: write a whole number, 0 or more, found -1");
  EXPECT_EQ(refused(asked, R"({"pool": 1})"), "pool: there is no option `pool`");
  EXPECT_EQ(refused(asked, R"({"park": 0})"), "the ballot gives no coin: put at least one on an option");
  EXPECT_EQ(refused(asked, R"({"park": "x"})"), "park: expects a number, found \"x\"");
}

TEST(Ballot, DotsHaveAPlaceAndAnOptionOrASign) {
  const Question signs = question(Kind::dots, {});
  EXPECT_EQ(refused(signs, R"([{"place": [1, 2, 3], "option": "plus"}, {"place": [4, 5, 6], "option": "minus"}])"), "");
  EXPECT_EQ(refused(signs, R"([{"place": [1, 2, 3], "option": "park"}])"), "0/option: there is no option `park`");
  EXPECT_EQ(refused(question(Kind::dots), R"([{"place": [1, 2, 3], "option": "park"}])"), "");
  EXPECT_EQ(refused(signs, R"([{"place": [1, 2], "option": "plus"}])"), "0/place: expects a point [x, y, z] in m, found [1, 2]");
  EXPECT_EQ(refused(signs, R"([{"option": "plus"}])"), R"(0: expects a dot {"place": [x, y, z], "option": "plus"})");
  EXPECT_EQ(refused(signs, "[]"), "the ballot sets no dot: set at least one");
  Json six = Json::array();
  for (int i = 0; i < 6; ++i) six.push_back({{"place", {i, 0, 0}}, {"option", "plus"}});
  EXPECT_EQ(refused(signs, six.dump()), "the ballot sets 6 dots, and a voter has 5: take away 1");
}

TEST(Ballot, SlidersStayInTheirRange) {
  const Question asked = question(Kind::slider);
  EXPECT_EQ(refused(asked, "10"), "");
  EXPECT_EQ(refused(asked, "30"), "");
  EXPECT_EQ(refused(asked, "31"), "the number must be between 10 and 30, found 31");
  EXPECT_EQ(refused(asked, R"("high")"), "expects a number, found \"high\"");
}

TEST(Ballot, QuestionsNeedOptionsThatCanBeToldApart) {
  const auto fault = [](Question asked, const std::vector<std::string>& ids) {
    const auto made = question_of(std::move(asked), options_of(ids));
    return made ? "" : made.error().text();
  };
  EXPECT_EQ(fault({.kind = Kind::rank}, {"a"}), "options: there are 1 options: people need at least 2 to choose from");
  EXPECT_EQ(fault({.kind = Kind::coins}, {"a", "a"}),
            "options/1/id: the option `a` stands in an earlier row too: give it another id");
  EXPECT_EQ(fault({.kind = Kind::coins}, {"a", "a b"}), "options/1/id: `a b` is no id: use 1 to 64 of a-z 0-9 _ - . #");
  EXPECT_EQ(fault({.kind = Kind::slider, .least = 5, .most = 5}, {}),
            "most: the largest answer (5) has to lie above the smallest (5)");
  EXPECT_EQ(fault({.kind = Kind::dots}, {}), "");
}

Ballot random_ballot(Kind kind, const Question& asked, Random& random) {
  Ballot ballot;
  if (kind == Kind::slider) return {.value = random.uniform(10, 30)};
  std::vector<std::string> left;
  for (const Option& option : asked.options) left.push_back(option.id);
  const bool is_many = kind != Kind::yes_no;
  while (!left.empty() && (ballot.options.empty() || is_many)) {
    const auto at = static_cast<std::ptrdiff_t>(random.below(left.size()));
    ballot.options.push_back(left[static_cast<std::size_t>(at)]);
    left.erase(left.begin() + at);
    if (kind == Kind::coins) ballot.coins.push_back(1);
    if (kind == Kind::dots) ballot.places.push_back({random.uniform(-9, 9), random.uniform(-9, 9), 0});
  }
  return ballot;
}

// Law: a ballot that fits survives its JSON and its row in a table.
TEST(Ballot, SurvivesJsonAndRow) {
  PortDefinition port;
  port.kind = ValueKind::table;
  port.columns = ballot_columns();
  Random random(3);
  for (const Kind kind : {Kind::yes_no, Kind::dots, Kind::rank, Kind::coins, Kind::slider})
    for (int round = 0; round < 50; ++round) {
      const Question asked = question(kind);
      const Ballot ballot = random_ballot(kind, asked, random);
      ASSERT_TRUE(check_ballot(asked, ballot).ok()) << check_ballot(asked, ballot).error().text();
      const auto back = ballot_from_json(kind, ballot_to_json(kind, ballot));
      ASSERT_TRUE(back.ok()) << back.error().text();
      EXPECT_TRUE(*back == ballot) << ballot_to_json(kind, ballot).dump();
      Table table;
      for (const ColumnDefinition& column : port.columns) table.columns.push_back(column.id);
      const auto row = row_from_json(port, row_to_json(port, row_of("anna", ballot)), "");
      ASSERT_TRUE(row.ok()) << row.error().text();
      table.rows.push_back(*row);
      const auto kept = ballot_in(table, 0);
      ASSERT_TRUE(kept.ok());
      EXPECT_TRUE(*kept == ballot);
      for (const Kind other : {Kind::yes_no, Kind::dots, Kind::coins, Kind::slider})
        if (other != kind) { EXPECT_FALSE(check_ballot(question(other), ballot).ok()); }
    }
}

}  // namespace
}  // namespace bl::vote
