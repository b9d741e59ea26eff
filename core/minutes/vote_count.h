// Counts a vote of the scene, by the count that the vote itself has (core/vote).
#pragma once

#include <string>

#include "core/define/registry.h"
#include "core/graph/scene.h"
#include "core/minutes/account.h"

namespace bl::minutes {

/// Off where there is no such vote.
bool takes_ballots(const Scene& scene, const Registry& registry, const std::string& vote);
/// Fills in what the round asked, its result, and the ballots of a vote that is not secret.
void count_votes(const Scene& scene, const Registry& registry, Round& round);

}  // namespace bl::minutes
