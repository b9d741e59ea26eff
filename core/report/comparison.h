// The differences between two proposals: settings, and all indicators.
#pragma once

#include <string>
#include <vector>

#include "core/graph/state.h"

namespace bl::report {

/// One number of one node, or of all nodes of a typification together, in both proposals.
struct IndicatorRow {
  std::string node, name;  ///< node id, empty for all nodes together; what people call the node
  std::string path;        ///< "typification.port"
  std::string label;       ///< "SmartVolume: floor area", with what was done to many: "sum", "mean"
  Unit unit = Unit::none;
  double before = 0, after = 0;
  bool is_share = false;  ///< of a whole, from 0 to 1: shown in percent, where other ratios are plain numbers
  /// The difference as a share of the larger of the two; 0 where they are the same.
  double share() const;
  /// "1 240 m²", "0.42 %" or "3.78": a value of this row as people read it.
  std::string figure(double value) const;
  /// The difference in percent, or as a figure where next to nothing was there before.
  std::string difference() const;
  /// Is the difference large enough to show? Rounding differences between runs are not.
  bool is_seen(double least_share) const;
};

struct Comparison {
  std::vector<std::string> inputs;                   ///< settings that differ, as sentences in the order of ids
  std::vector<IndicatorRow> totals;                  ///< in the order of typifications and ports; those that are the same too
  std::vector<IndicatorRow> nodes;                   ///< those that differ, with the largest relative changes first
  std::size_t same = 0;                              ///< numbers of nodes that agree
  std::vector<std::string> only_before, only_after;  ///< nodes, by name
  /// What holds volumes back and what cannot be met, in one of the two only: sentences in the order of nodes, then of links.
  std::vector<std::string> reasons_before, reasons_after;
};

/// Numbers closer than `least_share` count as the same. Settings of people are compared as they stand in the scenes.
Comparison compare(const State& before, const State& after, double least_share);

/// A page with both drawings side by side, and a chart of what differs most; depends on its arguments alone.
std::string comparison_page(const State& before, const State& after, const Comparison& comparison, const std::string& name_before,
                            const std::string& name_after);

}  // namespace bl::report
