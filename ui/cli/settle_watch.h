// Watches a run for signs that it will not settle, and ends it early.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <utility>

#include "core/graph/state.h"

namespace bl::cli {

/// The rule (README.md): once no link moves a node by more than the scene's move limit, the worst error has to get better.
/// It gives up after 40 calm ticks without progress where a solver says that the demands cannot be met or a node fails, and
/// after 400 such ticks elsewhere. Progress is a worst error below 0.99 of the best one so far.
class SettleWatch {
 public:
  /// Should the run end after this tick?
  bool is_hopeless(const State& state);
  /// Who answers whom without end, where the run was given up for that: links whose rules are not kept, and volumes whose storeys
  /// come and go; else empty.
  std::string to_and_fro(const State& state) const;

 private:
  void note(const State& state);

  double best_error_ = -1;
  long long idle_ = 0;
  // Of the ticks without progress.
  std::map<std::uint32_t, std::string> unkept_;                             // by link: what it said last
  std::map<std::uint32_t, std::pair<std::int64_t, std::int64_t>> heights_;  // by node: least and most storeys
};

/// Does the evaluation of a node fail? The cause is then its data, not the demands.
bool has_node_error(const State& state);

/// Why a state is not settled, as the end of the sentence "not settled: ...". `before`: the state of the tick before, or null.
std::string why_not_settled(const State& state, const State* before, const SettleWatch& watch);

}  // namespace bl::cli
