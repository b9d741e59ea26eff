// Counts the ballots of a vote: each is counted, or refused with its reason.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/vote/ballot.h"

namespace bl::vote {

/// The row of a slider in a result.
inline constexpr const char* kMean = "mean";

struct Tally {
  std::string option, label;
  double points = 0;  ///< votes, points of rankings, coins or dots; of a slider the mean
  double share = 0;   ///< of all points; of a slider, where the mean lies from `least` (0) to `most` (1)
};
struct Refusal {
  std::string voter, reason;
};
struct Outcome {
  std::vector<Tally> tallies;  ///< in the order of the options
  std::int64_t counted = 0;
  std::vector<Refusal> refusals;
  std::string leading;          ///< the option with the most points; empty on a tie, and where there are none
  double mean = 0, median = 0;  ///< of a slider
};

/// A ranking of n options gives its first n - 1 points, the next n - 2, and so on (Borda's count); options that it does not name
/// get none. Of several ballots of one voter the first counts.
Outcome count(const Question& question, const Table& ballots);

}  // namespace bl::vote
