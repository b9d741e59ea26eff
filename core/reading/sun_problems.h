// Receivers that have less sun than they ask for: by how much, and who holds it.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/graph/state.h"

namespace bl::reading {

/// A receiver that has its required sun on less than the required share of its area. Programs, reports and windows read these.
struct SunShortage {
  std::uint32_t receiver = 0;            ///< the node
  double share = 0, required_share = 1;  ///< of its area
  std::vector<std::string> links;        ///< ids of the links that hold its sun, ascending
  /// "has 8.00 h of sun on 90.1 % of its area, where 100 % is asked for: its points lack 0.13 h in the mean, ...; link `a` holds
  /// it, ...".
  std::string text;
};

/// Of all receivers that a study has measured, in ascending node.
std::vector<SunShortage> sun_shortages(const State& state);

/// A share that is missed by less is rounding.
inline constexpr double kSunRounding = 1e-9;

}  // namespace bl::reading
