// The votes on the page: what was asked, how many answered, and the result.
#include "core/base/text.h"
#include "core/minutes/page.h"
#include "core/reading/figures.h"

namespace bl::minutes {

namespace {

std::string turnout_of(const Round& round) {
  std::string text = std::to_string(round.outcome.counted) + (round.outcome.counted == 1 ? " ballot" : " ballots");
  if (round.electorate > 0)
    text += " of " + std::to_string(round.electorate) + " who may vote (" +
            reading::percent(static_cast<double>(round.outcome.counted) / static_cast<double>(round.electorate)) + ")";
  text += "; " + std::to_string(round.seats) + (round.seats == 1 ? " person" : " people") + " had a seat";
  if (round.uncounted > 0) text += "; " + std::to_string(round.uncounted) + " not counted, because they do not fit the question";
  return text;
}

std::string state_of(const Account& account, const Round& round) {
  std::string text = "Opened at " + account.when(round.opened);
  text += round.closed ? "; closed at " + account.when(*round.closed) + "." : "; not closed.";
  if (round.waiting > 0) text += " Secret ballots that wait to be counted: " + std::to_string(round.waiting) + ".";
  if (!round.is_shown) text += " The result is shown when the vote is closed.";
  return text;
}

void write_round(drawing::Markup& page, const Account& account, const Round& round) {
  const std::string name = round.question.empty() ? round.vote : round.question;
  page.element("h3", round.number == 1 ? name : name + " (round " + std::to_string(round.number) + ")");
  page.element("p", std::string(round.is_secret ? "Secret" : "Not secret") + (round.kind.empty() ? "" : ", kind " + round.kind) +
                        ". Node " + round.vote + ". " + state_of(account, round));
  if (!round.problem.empty()) {
    page.element("p", "It could not be counted: " + round.problem);
    return;
  }
  page.element("p", "Turnout: " + turnout_of(round) + ".");
  if (!round.is_shown) return;
  std::vector<std::vector<std::string>> rows;
  for (const vote::Tally& tally : round.outcome.tallies)
    rows.push_back({tally.label.empty() ? tally.option : tally.label, shortest(tally.points), reading::percent(tally.share)});
  write_table(page, {"Option", "#Points", "#Share"}, rows, "There is nothing to count.");
  rows.clear();
  for (const NamedBallot& ballot : round.ballots) {
    const std::int64_t seat = room::RoomState::seat_of_author(ballot.voter);
    rows.push_back({seat == 0 ? ballot.voter : account.who(seat), ballot.answer});
  }
  if (!rows.empty()) write_table(page, {"Ballot of", "Answer"}, rows, "");
}

}  // namespace

void write_votes(drawing::Markup& page, const Account& account) {
  page.element("h2", "Votes");
  if (account.rounds.empty()) page.element("p", "No vote was opened.");
  for (const Round& round : account.rounds) write_round(page, account, round);
}

}  // namespace bl::minutes
