// Casts, changes or withdraws one voter's ballot while the vote is open.
#include <algorithm>

#include <nlohmann/json.hpp>

#include "core/session/table_rows.h"
#include "core/session/vote_question.h"
#include "core/vote/ballot_json.h"

namespace bl {

namespace {

constexpr std::size_t kLongestVoter = 64;  // bytes

Result<vote::Question> open_question(const Scene& scene, const PortSite& site) {
  if (!std::get<bool>(set_value(scene, *site.node, *site.type, *site.type->find_port("is_open"))))
    return Error{ErrorCode::conflict, "is_open", "the vote is closed: ballots are cast and changed while it is open"};
  return question_of_vote(scene, *site.node, *site.type);
}

Result<TableRow> row_for(const vote::Question& question, const CastVote::In& in) {
  const auto json = in.ballot.read();
  if (!json) return json.error();
  const auto ballot = vote::ballot_from_json(question.kind, **json);
  if (!ballot) return ballot.error();
  if (auto fits = vote::check_ballot(question, *ballot); !fits) return fits.error();
  return vote::row_of(in.voter, *ballot);
}

// The ballots after the command. Rows stand in the order of the voters' names, so that they do not tell who voted when.
Result<Table> with_ballot(const vote::Question& question, TableSite site, const CastVote::In& in) {
  auto& rows = site.table.rows;
  const auto old = find_row(site, in.voter);
  if (in.ballot.is_null()) {
    if (!old) return Error{ErrorCode::not_found, "", "`" + in.voter + "` has no ballot to withdraw"};
    rows.erase(rows.begin() + static_cast<std::ptrdiff_t>(*old));
    return std::move(site.table);
  }
  auto row = row_for(question, in);
  if (!row) return row.error();
  if (old) {
    rows[*old] = std::move(*row);
    return std::move(site.table);
  }
  if (old.error().code != ErrorCode::not_found) return old.error();
  const auto next =
      std::find_if(rows.begin(), rows.end(), [&](const TableRow& other) { return std::get<std::string>(other[0]) > in.voter; });
  rows.insert(next, std::move(*row));
  return std::move(site.table);
}

JsonValue ballot_of(const vote::Question& question, const Table& ballots, const std::string& voter) {
  const std::size_t row = ballots.row_of("voter", voter);
  if (row == ballots.rows.size()) return JsonValue::null();
  const auto ballot = vote::ballot_in(ballots, row);
  return ballot ? JsonValue::of(vote::ballot_to_json(question.kind, *ballot)) : JsonValue::null();
}

}  // namespace

void CastVote::declare(CommandBuilder<CastVote>& c) {
  c.id("cast_vote").label("Cast vote").doc("Casts a ballot in an open vote, in place of an earlier ballot of the same voter.");
  c.argument(&In::node, "node").required().doc("Id of the vote.");
  c.argument(&In::voter, "voter").required().doc("Whose ballot it is: the text in the key column of the ballots.");
  c.argument(&In::ballot, "ballot")
      .required()
      .doc(
          "The answer: `\"yes\"` or `\"no\"`; a ranking `[\"park\", \"school\"]`, the best first; coins `{\"park\": 3}`; dots "
          "`[{\"place\": [x, y, z], \"option\": \"plus\"}]`; or the number of a slider. null withdraws the ballot.");
}

Inverse CastVote::apply(SceneEdit& edit, const In& in) {
  const auto site = find_table(edit, in.node, {"vote.ballots"});
  if (!site) return site.error();
  const std::string vote = "nodes/" + in.node + "/vote", place = site->place + "/" + in.voter;
  const auto question = open_question(edit.scene(), site->port);
  if (!question) return question.error().within(vote);
  if (in.voter.empty() || in.voter.size() > kLongestVoter)
    return Error{ErrorCode::out_of_range, site->place,
                 "the voter needs a name of 1 to " + std::to_string(kLongestVoter) + " characters"};
  auto after = with_ballot(*question, *site, in);
  if (!after) return after.error().within(place);
  // As a ballot again, so that nothing is taken back once the vote is closed. Where that would not give the same rows, as with a
  // ballot that does not fit the question any more, the rows themselves.
  const In back{in.node, in.voter, ballot_of(*question, site->table, in.voter)};
  TableSite changed = *site;
  changed.table = *after;
  const auto before = with_ballot(*question, std::move(changed), back);
  const PortDefinition& port = *site->port.port;
  std::vector<Command> inverse{command<CastVote>(back)};
  if (!before || !(*before == site->table)) inverse = table_commands(in.node, site->path, port, *after, site->table);
  edit.set_value(in.node, site->port.type->id, port, Shared<Table>(std::move(*after)));
  return inverse;
}

}  // namespace bl

BL_COMMAND(cast_vote, CastVote)
