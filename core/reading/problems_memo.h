// What is in the way in one state after another: of the next state only the nodes and links that have changed are read.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <vector>

#include "core/reading/place_problems.h"
#include "core/reading/report_model.h"

namespace bl::reading {

/// What tense_ports(), failures_of(), collapsed_volumes() and hanging_volumes() give.
class ProblemsMemo {
 public:
  void read(const std::shared_ptr<const State>& state);

  // Of the state that was read last.
  const std::vector<TensePort>& tense() const { return tense_; }
  std::vector<ProblemRow> failures() const { return failures_of(*state_, links_); }
  std::vector<PlaceProblem> collapsed() const { return places_.collapsed(*state_); }
  const std::map<std::uint32_t, PlaceProblem>& hanging() const { return places_.hanging(); }

 private:
  void follow_tensions(const State& state, const std::vector<std::uint32_t>& changed);
  void follow_links(const State& state);

  std::shared_ptr<const State> state_;
  std::vector<TensePort> tense_;
  std::vector<std::uint32_t> links_;  ///< with errors, ascending
  VolumePlaces places_;
};

}  // namespace bl::reading
