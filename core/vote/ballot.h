// What a vote asks and what one ballot answers, and how a ballot is checked and kept as a row of a table.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"
#include "core/base/vector.h"
#include "core/define/definition.h"

namespace bl::vote {

enum class Kind { yes_no, dots, rank, coins, slider };
/// The kind that scenes call so; nothing where there is none.
std::optional<Kind> kind_named(std::string_view name);

struct Option {
  std::string id, label;
};

/// What a ballot has to fit.
struct Question {
  Kind kind = Kind::yes_no;
  std::vector<Option> options = {};  ///< what may be named: see question_of
  std::int64_t points = 10;          ///< coins or dots that a voter has
  bool is_whole_ranking = true;      ///< a ranking has to name all options
  double least = 0, most = 100;      ///< of a slider
};

/// The question with its options. Yes or no has options of its own, and so have dots where the table is empty: `plus` and
/// `minus`. An error has its place in the settings of the vote, such as `options/2/id`.
Result<Question> question_of(Question settings, const Table& options);

/// One answer; the members that its kind does not use are empty.
struct Ballot {
  std::vector<std::string> options = {};  ///< the answer; a ranking, the best first; where coins lie; what each dot says
  std::vector<double> coins = {};         ///< on each of them
  std::vector<Point3> places = {};        ///< of dots, one for each of them [m]
  double value = 0;                       ///< of a slider
  bool operator==(const Ballot&) const = default;
};

/// Does the ballot answer the question? The place of an error is a step inside the ballot as people write it (ballot_json.h), or
/// empty; its sentence says what is wrong or missing.
Result<void> check_ballot(const Question& question, const Ballot& ballot);

/// The columns of a table that holds a ballot of any kind in each row, named by its voter.
std::vector<ColumnDefinition> ballot_columns();
TableRow row_of(const std::string& voter, const Ballot& ballot);
/// The ballot of a row, or why the row holds none.
Result<Ballot> ballot_in(const Table& ballots, std::size_t row);

}  // namespace bl::vote
