// The rules of plots that are broken: what was found, what is allowed, by whom, and which link holds the rule.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/graph/state.h"

namespace bl::reading {

/// A rule of a plot that what stands on it breaks. Programs, reports, windows and pages all read these.
struct BrokenRule {
  std::uint32_t plot = 0;            ///< the node
  std::string port;                  ///< of the rule: "fsi_max", "gsi_max", "height_max", "setback"
  double found = 0, allowed = 0;     ///< ratios, or metres
  std::vector<std::string> volumes;  ///< ids of those that break it, the largest part first
  std::vector<std::string> links;    ///< ids of the links that hold it, ascending
  /// "FSI 2.31 of 2.00 allowed, by `a` (1 200 m²) and `b` (800 m²); nothing holds it: lay a link of the kind `plot_rules` ...".
  std::string text;
};

/// Of all plots, in ascending node, and in the order of the ports above.
std::vector<BrokenRule> broken_rules(const State& state);

/// An excess below this share of what is allowed is rounding.
inline constexpr double kRuleRounding = 1e-6;

}  // namespace bl::reading
