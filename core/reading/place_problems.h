// Problems with the positions of volumes: bodies in the air, and volumes that lie on one point.
#pragma once

#include <string>
#include <vector>

#include "core/graph/state.h"

namespace bl::reading {

/// A problem of one or several volumes, in words. `subject` and `text` can stand beside each other, `sentence()` alone.
struct PlaceProblem {
  std::string subject;             ///< "Playground pavilion hangs 15.3 m above the ground"
  std::string text;                ///< the allowed standing, and what to do
  std::vector<std::string> nodes;  ///< ids, ascending
  std::vector<std::string> links;  ///< ids of the links that cause it, ascending

  std::string sentence() const { return text.empty() ? subject : subject + ": " + text; }
};

/// A lowest point no higher than this above what it should stand on is no problem [m].
inline constexpr double kLeastHang = 0.1;
/// Volumes whose positions are nearer than this share of the smaller one's radius lie on one point.
inline constexpr double kOnePoint = 0.1;

/// Volumes that stand on nothing that they may stand on, ascending id.
std::vector<PlaceProblem> hanging_volumes(const State& state);
/// Groups of volumes on one point, the largest first, with the links that pull them together.
std::vector<PlaceProblem> collapsed_volumes(const State& state);
/// Both: first the groups on one point.
std::vector<PlaceProblem> place_problems(const State& state);

}  // namespace bl::reading
