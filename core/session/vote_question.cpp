// Reads the settings of a vote.
#include "core/session/vote_question.h"

namespace bl {

Result<vote::Question> question_of_vote(const Scene& scene, const NodeRecord& node, const TypificationDefinition& type) {
  const auto now = [&](const char* port) { return set_value(scene, node, type, *type.find_port(port)); };
  vote::Question asked;
  asked.kind = vote::kind_named(std::get<std::string>(now("kind"))).value_or(asked.kind);
  asked.points = std::get<std::int64_t>(now("points"));
  asked.is_whole_ranking = std::get<bool>(now("is_whole_ranking"));
  asked.least = as_number(now("least"));
  asked.most = as_number(now("most"));
  return vote::question_of(asked, *std::get<Shared<Table>>(now("options")));
}

}  // namespace bl
