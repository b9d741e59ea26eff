// Ballots are counted in the order of their rows, so that sums have the same bits in every run.
#include "core/vote/count.h"

#include <algorithm>
#include <set>
#include <utility>

namespace bl::vote {

namespace {

void add(const Question& question, const Ballot& ballot, Outcome& outcome) {
  const double options = static_cast<double>(question.options.size());
  for (std::size_t i = 0; i < ballot.options.size(); ++i) {
    const auto tally = std::find_if(outcome.tallies.begin(), outcome.tallies.end(),
                                    [&](const Tally& one) { return one.option == ballot.options[i]; });
    tally->points += question.kind == Kind::rank    ? options - 1 - static_cast<double>(i)
                     : question.kind == Kind::coins ? ballot.coins[i]
                                                    : 1;
  }
}

void take_shares(Outcome& outcome) {
  double sum = 0, most = 0;
  for (const Tally& tally : outcome.tallies) {
    sum += tally.points;
    most = std::max(most, tally.points);
  }
  if (!(sum > 0)) return;
  std::size_t leaders = 0;
  for (Tally& tally : outcome.tallies) {
    tally.share = tally.points / sum;
    if (tally.points != most) continue;
    outcome.leading = ++leaders == 1 ? tally.option : "";
  }
}

void take_middle(const Question& question, std::vector<double> values, Outcome& outcome) {
  if (values.empty()) return;
  const double count = static_cast<double>(values.size());
  for (const double value : values) outcome.mean += value;
  // Rounding must not carry it out of its range.
  outcome.mean = std::clamp(outcome.mean / count, question.least, question.most);
  std::sort(values.begin(), values.end());
  const std::size_t half = values.size() / 2;
  outcome.median = values.size() % 2 == 1 ? values[half] : values[half - 1] / 2 + values[half] / 2;
  outcome.tallies.push_back(
      {kMean, "Mean", outcome.mean, std::clamp((outcome.mean - question.least) / (question.most - question.least), 0.0, 1.0)});
}

}  // namespace

Outcome count(const Question& question, const Table& ballots) {
  Outcome outcome;
  for (const Option& option : question.options) outcome.tallies.push_back({option.id, option.label, 0, 0});
  std::set<std::string> voters;
  std::vector<double> values;
  for (std::size_t row = 0; row < ballots.rows.size(); ++row) {
    const std::string& voter = ballots.text(row, "voter");
    const auto refuse = [&](std::string reason) { outcome.refusals.push_back({voter, std::move(reason)}); };
    if (voter.empty()) {
      refuse("the ballot has no voter");
      continue;
    }
    if (!voters.insert(voter).second) {
      refuse("the voter has an earlier ballot, and that one counts");
      continue;
    }
    const auto ballot = ballot_in(ballots, row);
    const auto fits = ballot ? check_ballot(question, *ballot) : Result<void>(ballot.error());
    if (!fits) {
      refuse(fits.error().message);
      continue;
    }
    ++outcome.counted;
    if (question.kind == Kind::slider) values.push_back(ballot->value);
    else add(question, *ballot, outcome);
  }
  if (question.kind == Kind::slider) take_middle(question, std::move(values), outcome);
  else take_shares(outcome);
  return outcome;
}

}  // namespace bl::vote
