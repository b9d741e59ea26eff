// The question of a vote of the scene, which its ballots are checked and counted by.
#pragma once

#include "core/define/definition.h"
#include "core/graph/scene.h"
#include "core/vote/ballot.h"

namespace bl {

/// What the vote asks, as people have set it: none of these settings can be changed by a link. `type`: the typification `vote`,
/// which the node carries.
Result<vote::Question> question_of_vote(const Scene& scene, const NodeRecord& node, const TypificationDefinition& type);

}  // namespace bl
