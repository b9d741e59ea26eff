// Reads a vote and its ballots from the scene.
#include "core/minutes/vote_count.h"

#include <nlohmann/json.hpp>

#include "core/define/json_text.h"
#include "core/session/vote_question.h"
#include "core/vote/ballot_json.h"

namespace bl::minutes {

namespace {

/// A node that carries a vote.
struct Poll {
  const Scene* scene;
  const NodeRecord* node;
  const TypificationDefinition* type;
  template <class T>
  T get(const char* port) const {
    return std::get<T>(set_value(*scene, *node, *type, *type->find_port(port)));
  }
};

std::optional<Poll> poll_named(const Scene& scene, const Registry& registry, const std::string& vote) {
  const auto node = scene.nodes.find(vote);
  const TypificationDefinition* type = registry.typification("vote");
  if (node == scene.nodes.end() || type == nullptr || !node->second.types.contains("vote")) return std::nullopt;
  return Poll{&scene, &node->second, type};
}

std::string answer_in(const vote::Question& question, const Table& ballots, std::size_t row) {
  const auto ballot = vote::ballot_in(ballots, row);
  if (!ballot) return {};
  const Json json = vote::ballot_to_json(question.kind, *ballot);
  return json.is_string() ? json.get<std::string>() : write_json_line(json);
}

}  // namespace

bool takes_ballots(const Scene& scene, const Registry& registry, const std::string& vote) {
  const auto poll = poll_named(scene, registry, vote);
  return poll && poll->get<bool>("is_open");
}

void count_votes(const Scene& scene, const Registry& registry, Round& round) {
  const auto poll = poll_named(scene, registry, round.vote);
  if (!poll) {
    round.problem = "the vote was taken out of the scene before it was counted";
    return;
  }
  round.question = poll->get<std::string>("question");
  round.kind = poll->get<std::string>("kind");
  round.electorate = poll->get<std::int64_t>("electorate");
  round.is_secret = round.is_secret || poll->get<bool>("is_secret");
  round.is_shown = round.closed || poll->get<std::string>("shows") == "at_once";
  const auto question = question_of_vote(scene, *poll->node, *poll->type);
  if (!question) {
    round.problem = question.error().text();
    return;
  }
  const auto ballots = poll->get<Shared<Table>>("ballots");
  round.outcome = vote::count(*question, *ballots);
  round.uncounted = round.outcome.refusals.size();
  round.outcome.refusals.clear();
  if (!round.is_shown) {
    round.outcome.tallies.clear();
    round.outcome.leading.clear();
    round.outcome.mean = round.outcome.median = 0;
    return;
  }
  for (std::size_t row = 0; row < ballots->rows.size(); ++row)
    round.ballots.push_back({ballots->text(row, "voter"), answer_in(*question, *ballots, row)});
}

}  // namespace bl::minutes
