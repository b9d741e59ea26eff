// Figures of one state after another: of the next state only the volumes that have changed are read.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "core/reading/report_model.h"

namespace bl::reading {

/// What read_figures() gives. The volumes are read where they have changed, and added up all of them in the same order: a sum
/// that was kept by differences would round otherwise.
class FiguresMemo {
 public:
  const ReportModel& of(const std::shared_ptr<const State>& state);
  /// Of the state that was asked for last.
  const ReportModel& last() const { return model_; }
  const std::shared_ptr<const State>& state() const { return state_; }
  /// The nodes of the volumes that were read for it, ascending; nothing where all of them were.
  const std::optional<std::vector<std::uint32_t>>& changed() const { return changed_; }

 private:
  bool follow(const State& state, const Brief& brief);
  void read_all(const State& state);

  std::shared_ptr<const State> state_;
  BriefTargets targets_;  ///< of its plan
  Brief brief_;
  ReportModel model_;
  std::optional<std::vector<std::uint32_t>> changed_;
};

}  // namespace bl::reading
