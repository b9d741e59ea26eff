// Indicators, votes and role cards.
#include "core/reading/views/people.h"

namespace bl::reading {

void IndicatorFigures::declare(ViewBuilder<IndicatorFigures>& v) {
  v.of("indicator");
  v.reads(&IndicatorFigures::value, "indicator.value");
  v.reads(&IndicatorFigures::target, "indicator.target");
  v.reads(&IndicatorFigures::unit, "indicator.unit");
  v.reads(&IndicatorFigures::score, "indicator.score", Unit::ratio);
  v.reads(&IndicatorFigures::status, "indicator.status");
  v.reads(&IndicatorFigures::direction, "indicator.direction");
}
BL_VIEW(IndicatorFigures)

void VoteFigures::declare(ViewBuilder<VoteFigures>& v) {
  v.of("vote");
  v.reads(&VoteFigures::question, "vote.question");
  v.reads(&VoteFigures::kind, "vote.kind");
  v.reads(&VoteFigures::unit, "vote.unit");
  v.reads(&VoteFigures::leading, "vote.leading");
  v.reads(&VoteFigures::options, "vote.options");
  v.reads(&VoteFigures::ballots, "vote.ballots");
  v.reads(&VoteFigures::results, "vote.results");
  v.reads(&VoteFigures::points, "vote.points");
  v.reads(&VoteFigures::electorate, "vote.electorate", Unit::count);
  v.reads(&VoteFigures::ballot_count, "vote.ballot_count", Unit::count);
  v.reads(&VoteFigures::least, "vote.least");
  v.reads(&VoteFigures::most, "vote.most");
  v.reads(&VoteFigures::turnout, "vote.turnout", Unit::ratio);
  v.reads(&VoteFigures::mean, "vote.mean");
  v.reads(&VoteFigures::median, "vote.median");
  v.reads(&VoteFigures::is_whole_ranking, "vote.is_whole_ranking");
  v.reads(&VoteFigures::is_open, "vote.is_open");
  v.reads(&VoteFigures::is_secret, "vote.is_secret");
  v.reads(&VoteFigures::is_shown, "vote.is_shown");
}
BL_VIEW(VoteFigures)

void GroupFigures::declare(ViewBuilder<GroupFigures>& v) {
  v.of("stakeholder_group");
  v.reads(&GroupFigures::interest, "stakeholder_group.interest");
  v.reads(&GroupFigures::goals, "stakeholder_group.goals");
  v.reads(&GroupFigures::budget, "stakeholder_group.budget", Unit::euro);
  v.reads(&GroupFigures::spent, "stakeholder_group.spent", Unit::euro);
  v.reads(&GroupFigures::budget_left, "stakeholder_group.budget_left", Unit::euro);
  v.reads(&GroupFigures::controls, "stakeholder_group.controls");
}
BL_VIEW(GroupFigures)

BL_VIEWS(people, IndicatorFigures, VoteFigures, GroupFigures)

}  // namespace bl::reading
