// The figures of what groups decide by: indicators, votes and role cards.
#pragma once

#include <cstdint>
#include <string>

#include "core/reading/view.h"

namespace bl::reading {

struct IndicatorFigures {
  double value = 0, target = 0;  ///< in the indicator's own unit
  std::string unit;              ///< its symbol
  double score = 0;
  std::string status;     ///< `met`, `close` or `far`
  std::string direction;  ///< `at_least`, `at_most` or `near`

  static void declare(ViewBuilder<IndicatorFigures>& v);
  static const ViewDefinition& view();
};

struct VoteFigures {
  std::string question, kind, unit, leading;
  Shared<Table> options, ballots, results;
  std::int64_t points = 0, electorate = 0, ballot_count = 0;
  double least = 0, most = 0, turnout = 0, mean = 0, median = 0;
  bool is_whole_ranking = false, is_open = false, is_secret = false, is_shown = false;

  static void declare(ViewBuilder<VoteFigures>& v);
  static const ViewDefinition& view();
};

struct GroupFigures {
  std::string interest;
  Selection goals;
  double budget = 0, spent = 0, budget_left = 0;  ///< [EUR]
  Shared<Table> controls;

  static void declare(ViewBuilder<GroupFigures>& v);
  static const ViewDefinition& view();
};

}  // namespace bl::reading
