// Ballots name options by their ids, so that a ballot keeps its meaning while people add options or put them in another order.
#include "core/vote/ballot.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <utility>

#include "core/base/text.h"

namespace bl::vote {

namespace {

constexpr std::array<std::pair<std::string_view, Kind>, 5> kKinds = {
    {{"yes_no", Kind::yes_no}, {"dots", Kind::dots}, {"rank", Kind::rank}, {"coins", Kind::coins}, {"slider", Kind::slider}}};

std::vector<std::string> ids_of(const Question& question) {
  std::vector<std::string> ids;
  for (const Option& option : question.options) ids.push_back(option.id);
  return ids;
}

// Options that stand once each in a ballot: a ranking, or the options that coins lie on.
Result<void> check_once(const Ballot& ballot, const auto& place_of) {
  std::set<std::string_view> named;
  for (std::size_t i = 0; i < ballot.options.size(); ++i)
    if (!named.insert(ballot.options[i]).second)
      return Error{ErrorCode::duplicate, place_of(i), "`" + ballot.options[i] + "` stands in this ballot twice: name it once"};
  return {};
}

Result<void> check_ranking(const Question& question, const Ballot& ballot) {
  if (auto once = check_once(ballot, [](std::size_t i) { return std::to_string(i); }); !once) return once;
  if (ballot.options.empty()) return Error{ErrorCode::missing, "", "the ranking is empty: name the best option first"};
  if (!question.is_whole_ranking) return {};
  std::string missing;
  for (const Option& option : question.options)
    if (std::find(ballot.options.begin(), ballot.options.end(), option.id) == ballot.options.end())
      missing += (missing.empty() ? "`" : ", `") + option.id + "`";
  if (missing.empty()) return {};
  return Error{ErrorCode::missing, "", "the ranking is not complete: " + missing + " is missing"};
}

Result<void> check_coins(const Question& question, const Ballot& ballot) {
  if (auto once = check_once(ballot, [&](std::size_t i) { return ballot.options[i]; }); !once) return once;
  if (ballot.options.empty()) return Error{ErrorCode::missing, "", "the ballot gives no coin: put at least one on an option"};
  double given = 0;
  for (std::size_t i = 0; i < ballot.coins.size(); ++i) {
    const double coins = ballot.coins[i];
    if (!(coins >= 1) || std::floor(coins) != coins)
      return Error{ErrorCode::out_of_range, ballot.options[i],
                   "coins are whole and not split: write a whole number, 0 or more, found " + shortest(coins)};
    given += coins;
  }
  if (given <= static_cast<double>(question.points)) return {};
  return Error{ErrorCode::out_of_range, "",
               "the ballot gives " + shortest(given) + " coins, and a voter has " + std::to_string(question.points) +
                   ": take away " + shortest(given - static_cast<double>(question.points))};
}

Result<void> check_dots(const Question& question, const Ballot& ballot) {
  if (ballot.options.empty()) return Error{ErrorCode::missing, "", "the ballot sets no dot: set at least one"};
  const std::size_t most = static_cast<std::size_t>(std::max<std::int64_t>(question.points, 0));
  if (ballot.options.size() <= most) return {};
  return Error{ErrorCode::out_of_range, "",
               "the ballot sets " + std::to_string(ballot.options.size()) + " dots, and a voter has " + std::to_string(most) +
                   ": take away " + std::to_string(ballot.options.size() - most)};
}

Result<void> check_slider(const Question& question, const Ballot& ballot) {
  if (ballot.value >= question.least && ballot.value <= question.most) return {};
  return Error{ErrorCode::out_of_range, "",
               "the number must be between " + shortest(question.least) + " and " + shortest(question.most) + ", found " +
                   shortest(ballot.value)};
}

// What the kind does not use is empty, and what it uses has an entry for each option.
bool has_the_form_of(Kind kind, const Ballot& ballot) {
  const std::size_t coins = kind == Kind::coins ? ballot.options.size() : 0,
                    places = kind == Kind::dots ? ballot.options.size() : 0;
  if (ballot.coins.size() != coins || ballot.places.size() != places) return false;
  return kind == Kind::slider ? ballot.options.empty() : ballot.value == 0;
}

Error bad_option(std::size_t row, const std::string& column, ErrorCode code, std::string sentence) {
  return {code, "options/" + std::to_string(row) + "/" + column, std::move(sentence)};
}

}  // namespace

std::optional<Kind> kind_named(std::string_view name) {
  const auto found = std::find_if(kKinds.begin(), kKinds.end(), [&](const auto& kind) { return kind.first == name; });
  return found == kKinds.end() ? std::nullopt : std::optional(found->second);
}

Result<Question> question_of(Question settings, const Table& options) {
  Question question = std::move(settings);
  question.options.clear();
  if (question.kind == Kind::slider) {
    if (question.least < question.most) return question;
    return Error{
        ErrorCode::out_of_range, "most",
        "the largest answer (" + shortest(question.most) + ") has to lie above the smallest (" + shortest(question.least) + ")"};
  }
  if (question.kind == Kind::yes_no) {
    question.options = {{"yes", "Yes"}, {"no", "No"}};
    return question;
  }
  std::set<std::string> ids;
  for (std::size_t row = 0; row < options.rows.size(); ++row) {
    const Option option{options.text(row, "id"), options.text(row, "label")};
    if (!is_identifier(option.id))
      return bad_option(row, "id", ErrorCode::wrong_kind,
                        "`" + option.id.substr(0, 80) + "` is no id: use 1 to 64 of a-z 0-9 _ - . #");
    if (!ids.insert(option.id).second)
      return bad_option(row, "id", ErrorCode::duplicate,
                        "the option `" + option.id + "` stands in an earlier row too: give it another id");
    question.options.push_back(option);
  }
  if (question.kind == Kind::dots && question.options.empty()) question.options = {{"plus", "Plus"}, {"minus", "Minus"}};
  const std::size_t least = question.kind == Kind::dots ? 1 : 2;
  if (question.options.size() >= least) return question;
  return Error{ErrorCode::missing, "options",
               "there are " + std::to_string(question.options.size()) + " options: people need at least " +
                   std::to_string(least) + " to choose from"};
}

Result<void> check_ballot(const Question& question, const Ballot& ballot) {
  if (!has_the_form_of(question.kind, ballot))
    return Error{ErrorCode::wrong_kind, "", "the ballot was cast for a vote of another kind: cast it again"};
  const std::vector<std::string> known = ids_of(question);
  for (std::size_t i = 0; i < ballot.options.size(); ++i) {
    const std::string& option = ballot.options[i];
    if (std::find(known.begin(), known.end(), option) != known.end()) continue;
    const std::string place = question.kind == Kind::coins    ? option
                              : question.kind == Kind::dots   ? std::to_string(i) + "/option"
                              : question.kind == Kind::yes_no ? std::string()
                                                              : std::to_string(i);
    return Error{ErrorCode::not_found, place, "there is no option `" + option + "`" + did_you_mean(option, known)};
  }
  switch (question.kind) {
    case Kind::rank: return check_ranking(question, ballot);
    case Kind::coins: return check_coins(question, ballot);
    case Kind::dots: return check_dots(question, ballot);
    case Kind::slider: return check_slider(question, ballot);
    case Kind::yes_no: break;
  }
  if (ballot.options.size() == 1) return {};
  return Error{ErrorCode::missing, "", "the ballot holds no answer: write `yes` or `no`"};
}

std::vector<ColumnDefinition> ballot_columns() {
  const std::string kinds = "Empty for other kinds of votes.";
  return {
      {.id = "voter",
       .is_text = true,
       .is_required = true,
       .is_key = true,
       .default_value = std::string(),
       .doc = "Whose ballot it is: a pseudonym, or a key that does not tell who it is. Each voter has one ballot."},
      {.id = "answer",
       .is_text = true,
       .default_value = std::string(),
       .doc = "Ids of options with spaces between them: the answer; a ranking, the best first; the options that coins lie on; or "
              "what each dot says. Empty for a slider."},
      {.id = "coins",
       .list = ListOf::numbers,
       .unit = Unit::count,
       .default_value = Numbers(),
       .doc = "The coins on each of these options. " + kinds},
      {.id = "places",
       .list = ListOf::numbers,
       .unit = Unit::metre,
       .default_value = Numbers(),
       .doc = "The places of the dots: x, y and z of each, one after the other. " + kinds},
      {.id = "value", .doc = "The number that was chosen on a slider."}};
}

TableRow row_of(const std::string& voter, const Ballot& ballot) {
  std::string answer;
  for (const std::string& option : ballot.options) answer += (answer.empty() ? "" : " ") + option;
  std::vector<double> places;
  for (const Point3& place : ballot.places) places.insert(places.end(), {place.x, place.y, place.z});
  return {voter, answer, Numbers(ballot.coins), Numbers(std::move(places)), ballot.value};
}

Result<Ballot> ballot_in(const Table& ballots, std::size_t row) {
  Ballot ballot;
  const std::string& answer = ballots.text(row, "answer");
  for (std::size_t begin = 0; begin < answer.size();) {
    const std::size_t end = std::min(answer.find(' ', begin), answer.size());
    if (end > begin) ballot.options.push_back(answer.substr(begin, end - begin));
    begin = end + 1;
  }
  ballot.coins = *ballots.numbers(row, "coins");
  const std::vector<double>& places = *ballots.numbers(row, "places");
  if (places.size() % 3 != 0) return Error{ErrorCode::wrong_kind, "", "the places of its dots are not x, y and z each"};
  for (std::size_t i = 0; i < places.size(); i += 3) ballot.places.push_back({places[i], places[i + 1], places[i + 2]});
  ballot.value = ballots.number(row, "value");
  return ballot;
}

}  // namespace bl::vote
