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
  bool has_before = true, has_after = true;
  bool is_noise = false;  ///< the difference is below what the solvers may miss
  /// The difference as a share of the larger of the two; 0 where they are the same.
  double share() const;
  /// "1 240 m²", "0.42 %" or "3.78": a value of this row as people read it.
  std::string figure(double value) const;
  /// Both values in the same way; a dash for the proposal that has none.
  std::string first() const;
  std::string second() const;
  /// The difference in percent, or as a figure where next to nothing was there before; a dash where one of both has none.
  std::string difference() const;
  /// Is the difference large enough to show? Rounding differences between runs are not.
  bool is_seen(double least_share) const;
};

struct Comparison {
  /// What a proposal is judged by, those that are the same too: floor area by use, densities, sun, rules that are not met.
  std::vector<IndicatorRow> first;
  std::vector<std::string> inputs;   ///< settings that differ, as sentences in the order of ids; roles of many nodes as one
  std::vector<IndicatorRow> totals;  ///< in the order of typifications and ports; those that are the same too
  std::vector<IndicatorRow> volumes, nodes;          ///< those that differ, with the largest relative changes first
  std::size_t same = 0;                              ///< numbers of nodes that agree
  std::size_t within_tolerance = 0;                  ///< numbers that differ by less than the solvers may miss; in no list
  double tolerance = 0;                              ///< of the solvers
  std::vector<std::string> only_before, only_after;  ///< nodes, by name; many imported ones as one
  /// What holds volumes back and what cannot be met, in one of the two only: sentences in the order of nodes, then of links.
  std::vector<std::string> reasons_before, reasons_after;
};

/// Those of Comparison::first.
std::vector<IndicatorRow> first_figures(const State& before, const State& after);

/// Numbers closer than `least_share` count as the same. Settings of people are compared as they stand in the scenes.
Comparison compare(const State& before, const State& after, double least_share);

/// How many numbers of nodes are the same, and how many nearly: a sentence.
std::string told_of_same(const Comparison& comparison);

/// A page with both drawings side by side, and a chart of what differs most; depends on its arguments alone.
std::string comparison_page(const State& before, const State& after, const Comparison& comparison, const std::string& name_before,
                            const std::string& name_after);

}  // namespace bl::report
