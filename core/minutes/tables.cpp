// One row for each mark, comment, vote, option and ballot.
#include "core/minutes/tables.h"

#include "core/csv/csv_table.h"

namespace bl::minutes {

namespace {

using csv::CsvCell;
using Row = std::vector<CsvCell>;

// The cells that all rows of a round have.
Row round_row(const Round& round, const char* what) { return {round.vote, round.number, what}; }

Row vote_row(const Account& account, const Round& round) {
  Row row = round_row(round, "vote");
  row.insert(row.end(), {round.question, round.kind, round.is_secret ? "yes" : "no", round.closed ? "closed" : "open"});
  row.insert(row.end(), {round.opened.seq, account.time_of(round.opened)});
  if (round.closed) row.insert(row.end(), {round.closed->seq, account.time_of(*round.closed)});
  else row.resize(row.size() + 2);
  row.insert(row.end(), {round.outcome.counted, round.uncounted, round.seats});
  if (round.electorate == 0) row.resize(row.size() + 2);
  else
    row.insert(row.end(), {round.electorate, static_cast<double>(round.outcome.counted) / static_cast<double>(round.electorate)});
  row.emplace_back(round.problem);
  return row;
}

}  // namespace

std::string decisions_csv(const Account& account) {
  const std::vector<std::string> header = {"number", "entry", "tick", "time", "kind", "text", "seat", "pseudonym"};
  std::vector<Row> rows;
  for (std::size_t k = 0; k < account.state.marks.size(); ++k) {
    const room::Mark& mark = account.state.marks[k];
    rows.push_back({k + 1, mark.seq, mark.tick, account.time_of(account.marks[k]), mark.kind, account.words(mark.text), mark.seat,
                    account.pseudonym(mark.seat)});
  }
  return csv::write_csv(header, rows);
}

std::string comments_csv(const Account& account) {
  const std::vector<std::string> header = {"number",     "id",          "entry",       "tick",        "time",
                                           "seat",       "pseudonym",   "text",        "about_node",  "about_scenario",
                                           "about_tick", "about_x [m]", "about_y [m]", "about_z [m]", "answers_comment",
                                           "agree",      "disagree",    "state",       "answer",      "answered_by"};
  std::vector<Row> rows;
  for (std::size_t k = 0; k < account.comments.size(); ++k) {
    const Commented& one = account.comments[k];
    const room::Comment& comment = account.state.comments.at(one.id);
    Row row = {k + 1,
               one.id,
               one.moment.seq,
               one.moment.tick,
               account.time_of(one.moment),
               comment.seat,
               account.pseudonym(comment.seat),
               account.words(comment.text),
               comment.anchor.node,
               comment.anchor.scenario};
    row.push_back(comment.anchor.tick ? CsvCell(*comment.anchor.tick) : CsvCell());
    if (const auto& place = comment.anchor.place) row.insert(row.end(), {place->x, place->y, place->z});
    else row.resize(row.size() + 3);
    row.insert(row.end(), {comment.parent, ratings_of(comment, 1), ratings_of(comment, -1),
                           room::kCommentStateNames[static_cast<std::size_t>(comment.state)], account.words(comment.answer),
                           one.answered_by == 0 ? std::string() : account.who(one.answered_by)});
    rows.push_back(std::move(row));
  }
  return csv::write_csv(header, rows);
}

std::string votes_csv(const Account& account) {
  const std::vector<std::string> header = {"vote",        "round",        "row",        "question",     "kind",      "secret",
                                           "state",       "opened_entry", "opened",     "closed_entry", "closed",    "ballots",
                                           "not_counted", "seats",        "electorate", "turnout",      "problem",   "option",
                                           "label",       "points",       "share",      "seat",         "pseudonym", "answer"};
  constexpr std::size_t kOption = 17, kSeat = 21;  // columns
  std::vector<Row> rows;
  for (const Round& round : account.rounds) {
    rows.push_back(vote_row(account, round));
    for (const vote::Tally& tally : round.outcome.tallies) {
      Row row = round_row(round, "option");
      row.resize(kOption);
      row.insert(row.end(), {tally.option, tally.label, tally.points, tally.share});
      rows.push_back(std::move(row));
    }
    for (const NamedBallot& ballot : round.ballots) {
      Row row = round_row(round, "ballot");
      row.resize(kSeat);
      const std::int64_t seat = room::RoomState::seat_of_author(ballot.voter);
      if (seat == 0) row.insert(row.end(), {CsvCell(), ballot.voter, ballot.answer});
      else row.insert(row.end(), {seat, account.pseudonym(seat), ballot.answer});
      rows.push_back(std::move(row));
    }
  }
  return csv::write_csv(header, rows);
}

const std::vector<std::pair<std::string_view, std::string_view>>& table_beginnings() {
  static const std::vector<std::pair<std::string_view, std::string_view>> kBeginnings = {
      {"decisions.csv", "number,entry,tick,time,kind,text"},
      {"comments.csv", "number,id,entry,tick,time,seat"},
      {"votes.csv", "vote,round,row,question"}};
  return kBeginnings;
}

}  // namespace bl::minutes
