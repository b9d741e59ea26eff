// What the last ticks were like, and the figures of the current one: sampled once per tick, whoever looks at them.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "core/reading/figures_memo.h"
#include "core/report/report.h"
#include "ui/desktop/panels/workbench.h"

namespace bl::desktop {

enum class VolumeOrder { error, name, use, size };

/// How often lists and figures of a scene of so many nodes are made anew while it changes [s]. Thousands of rows that change in
/// every frame are read by nobody; what they are rows of is followed at once.
double figures_pause(std::size_t nodes);

class RunRecord {
 public:
  /// Takes a sample where a tick has passed since the last call; after a rewind the ticks that were undone are forgotten.
  void sample(const Workbench& editor);
  /// The ticks that are remembered, as the report wants them.
  std::vector<reading::ErrorSample> errors() const;
  /// Volumes, uses and totals of the current state; made when they are asked for. Of a large scene that changes in every frame
  /// they are those of a moment ago.
  const reading::ReportModel& figures(const Workbench& editor);
  /// Grows whenever those are those of another state.
  std::uint64_t figures_revision() const { return figures_revision_; }
  /// The nodes whose figures are others than in the revision before; nothing where all may be.
  const std::optional<std::vector<std::uint32_t>>& changed_figures() const { return figures_.changed(); }
  /// Indices of the volumes in the order that is wanted; it settles down between changes.
  const std::vector<std::size_t>& ordered(const Workbench& editor);

  // Columns of samples, the oldest first; all of one length.
  std::vector<double> tick, worst, mean, volume, move, tick_ms, bytes;
  double frame_rate = 0;  ///< smoothed [1/s]
  /// Why uses have less than they asked for, by use, of the figures at that revision.
  std::map<std::string, std::string> why;
  std::uint64_t why_revision = 0;
  VolumeOrder order = VolumeOrder::error;
  bool is_order_stale = true;

 private:
  void forget_from(double tick_number);
  void drop_oldest();

  std::shared_ptr<const State> sampled_, sorted_;
  reading::FiguresMemo figures_;
  std::uint64_t figures_revision_ = 0;
  std::vector<std::size_t> ordered_;
  std::uint64_t bytes_sent_ = 0;
  double sorted_at_ = -1, figured_at_ = -1, last_frame_ = 0;
};

}  // namespace bl::desktop
