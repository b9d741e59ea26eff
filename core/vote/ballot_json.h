// Ballots as people write them in a command: a form of its own for each kind of vote.
#pragma once

#include "core/define/json_text.h"
#include "core/vote/ballot.h"

namespace bl::vote {

/// `"yes"`; `["park", "school"]`, the best first; `{"park": 3}`; `[{"place": [x, y, z], "option": "plus"}]`; or a number. Coins
/// of 0 are left out. An error has its place inside the ballot; whether the ballot fits its question is not asked here.
Result<Ballot> ballot_from_json(Kind kind, const Json& json);
Json ballot_to_json(Kind kind, const Ballot& ballot);

}  // namespace bl::vote
